//! Codes of tables of offsets, curves and bodies.

use super::Explanation;

pub(super) const TABLES: [Explanation; 33] = [
    Explanation {
        code: "E300",
        title: "No table of offsets",
        cause: "The file is empty, is not text, is of a format that is not read, or has no table that the program \
         recognises.",
        example: "Half-breadths without stations and waterlines: `1,2,3` above `4,5,6`.",
        remedy: "Give a matrix with headers, or one offset a line, as CSV, TSV, XLSX or a text format of offsets.",
    },
    Explanation {
        code: "E301",
        title: "Cell that cannot be read",
        cause: "A cell is neither a number, a length, nor one of the marks `-`, `*` and `?`. Cells with dates or \
         formulas without values count too.",
        example: "`3-11-9` in feet-inches-eighths: eighths are 0 to 7.",
        remedy: "Correct the cell in the row and column that the message names.",
    },
    Explanation {
        code: "E303",
        title: "Positions that do not rise",
        cause: "Positions of stations or waterlines rise and then fall, or a profile of stem or stern lies beyond \
         the middle of the stations.",
        example: "The station `5` below the station `10` of a table whose stations rise.",
        remedy: "Correct the position, or put the lines in order.",
    },
    Explanation {
        code: "E304",
        title: "Full breadths for half-breadths",
        cause: "The breadths are about twice B/2, or about half of it where the table declares full breadths.",
        example: "Half-breadths up to 3.9 m in a table with `B = 4 m`.",
        remedy: "Declare `breadths = \"full\"` or `breadths = \"half\"` in a comment or in the TOML beside the table.",
    },
    Explanation {
        code: "E305",
        title: "Unit that contradicts the numbers",
        cause: "Lengths look like millimetres where the unit is metres, or the reverse. The code also marks two \
         units in one table, and profiles or edges far beyond the rest of the hull.",
        example: "`x [m]` above half-breadths of 1000 to 3900.",
        remedy: "Declare `units = \"mm\"`, or the unit that the numbers have.",
    },
    Explanation {
        code: "E306",
        title: "Line or offset given twice",
        cause: "A station, a waterline, a buttock, a block or an offset occurs a second time. Blocks of one table \
         must have the same stations.",
        example: "The header `x [m],0.5,0.5`.",
        remedy: "Remove one of them, or correct its position.",
    },
    Explanation {
        code: "E307",
        title: "Row with too many or too few fields",
        cause: "A row has more or fewer fields than the header. An open quotation mark has the same code.",
        example: "The row `0,1` below the header `x [m],0.5,1`.",
        remedy: "Fill up with empty fields where there is no hull, or remove what is too much.",
    },
    Explanation {
        code: "E308",
        title: "Decimal commas among separators",
        cause: "Commas separate the fields and the decimals too, so that rows have about twice the fields of the \
         header.",
        example: "The row `0,1,2,3,4` below a header of three fields.",
        remedy: "Separate the fields with semicolons or tabs, or write decimal points.",
    },
    Explanation {
        code: "E309",
        title: "Half-breadths of both signs",
        cause: "Some half-breadths are negative and others are positive. Half-breadths are distances from the \
         centreplane.",
        example: "The row `0,1,-1` in a table of positive half-breadths.",
        remedy: "Give all half-breadths the same sign.",
    },
    Explanation {
        code: "E310",
        title: "Header that is no position",
        cause: "A header of a station, waterline or column names no position, and the program does not know the word.",
        example: "`top` as the header of a waterline.",
        remedy: "Write a number or words with a number, as `WL 3 (1.50 m)`.",
    },
    Explanation {
        code: "E311",
        title: "Unknown or impossible convention",
        cause: "A convention in a comment or in the TOML beside the table is not known, or has an impossible value.",
        example: "`# units = cubits` above a table.",
        remedy: "Take a key or a value that the message proposes.",
    },
    Explanation {
        code: "E312",
        title: "Table too large",
        cause: "The file exceeds a limit: 16 MiB, 200000 rows, 4000 columns, 1000000 cells or 1000 bytes in a cell. \
         It also counts errors that are not shown.",
        example: "A table with 4001 fields in a row.",
        remedy: "Give the table of one hull alone. Correct the errors that are shown, and run the command again.",
    },
    Explanation {
        code: "E313",
        title: "Table without offsets",
        cause: "The headers are read, and no cell has an offset.",
        example: "The row `0,,` below the header `x [m],0.5,1`, as all other rows.",
        remedy: "Fill in the half-breadths [m].",
    },
    Explanation {
        code: "E314",
        title: "Table or body that makes no hull",
        cause: "A command reads a table or a body as a hull, and the fit finds too few lines, or a draught outside \
         the hull.",
        example: "`loftsman hydro` on a table with one waterline: a surface needs 2.",
        remedy: "Add the missing lines, or state a draught within the hull.",
    },
    Explanation {
        code: "E315",
        title: "Length that is no ship's",
        cause: "A position or an offset exceeds 100000 m.",
        example: "`1e7` as a half-breadth in metres.",
        remedy: "Correct the number, or its unit.",
    },
    Explanation {
        code: "E316",
        title: "Name that no drawing can show",
        cause: "A name or a label of the table has control characters or is too long.",
        example: "A station whose name has 40,000 characters.",
        remedy: "Shorten the name, and take out control characters.",
    },
    Explanation {
        code: "E317",
        title: "Cells that hold no number as it was typed",
        cause: "A spreadsheet made dates of feet-inches-eighths, or the workbook has formulas without stored values.",
        example: "`2005-03-04` in a cell where 3-4-5 was typed.",
        remedy: "Format the cells as text and type them again, or open the workbook in a spreadsheet and save it.",
    },
    Explanation {
        code: "E321",
        title: "Not a number in a text format",
        cause: "A field of a text format of other programs must be a number, and is none, or exceeds the limits of a \
         ship.",
        example: "`3,5` in a file of BRITFAIR: this format has decimal points.",
        remedy: "Write one decimal number with a point.",
    },
    Explanation {
        code: "E322",
        title: "Wrong count",
        cause: "A text format announces a number of sections, points or lines, and the file has another number of \
         them.",
        example: "`5` points announced before a section of 4 points.",
        remedy: "Correct the count, or the lines. Check whether the file was cut off.",
    },
    Explanation {
        code: "E323",
        title: "Wrong order",
        cause: "Sections, stations, waterlines or points of a text format do not rise, occur twice, or leave their \
         plane.",
        example: "A section at x = 41 m after one at x = 50.5 m.",
        remedy: "Correct the position, or put the lines in order.",
    },
    Explanation {
        code: "E324",
        title: "Missing end",
        cause: "A text format lacks the line that ends a block or the file.",
        example: "A file of BRITFAIR without the last line `0 0 0`.",
        remedy: "Add the line that the message names. Check whether the file was cut off.",
    },
    Explanation {
        code: "E325",
        title: "Negative half-breadth",
        cause: "A half-breadth of a text format is negative. These formats have the port side alone, with positive y.",
        example: "`-3.5` as y of a point in a file of PIAS.",
        remedy: "Give the side with positive y, and no other.",
    },
    Explanation {
        code: "E326",
        title: "Header or keyword that is not understood",
        cause: "A line of a text format has another form than its format requires, or names what the file does not \
         define.",
        example: "`metric` where GHS expects `KEY:value`.",
        remedy: "Write the line as the message shows. A wrong count before it may be the cause.",
    },
    Explanation {
        code: "E327",
        title: "Missing main dimension",
        cause: "A table of fractions needs L_PP, B and T in metres, or a dimension of a format is not above 0.",
        example: "A table of fractions of the half-breadth without T.",
        remedy: "Write `# Lpp = 40 m, B = 8 m, T = 3 m` above the table, or put it into the TOML beside it.",
    },
    Explanation {
        code: "E328",
        title: "Text format without a hull",
        cause: "A file of a known format has no shape, section or curve of a hull, or fewer than two sections. A drawing \
         whose lines lie in one plane has no place in space for them.",
        example: "A file of GHS with no shapes.",
        remedy: "Give a file with the hull over its centreplane, or lines in space. At least two sections are needed.",
    },
    Explanation {
        code: "E340",
        title: "Curve that cannot be read",
        cause: "A table of one curve has no columns x and y, no points, an unknown unit, or two points at one x.",
        example: "`0,1` above `0,2`: a second point at x = 0.",
        remedy: "Name the columns `x,y[,tolerance][,flag]`, and write one point a line.",
    },
    Explanation {
        code: "E341",
        title: "Curve that is not UTF-8",
        cause: "The file of `fair-curve` is not text in UTF-8.",
        example: "A workbook in place of a CSV file.",
        remedy: "Save the curve as CSV in UTF-8.",
    },
    Explanation {
        code: "E342",
        title: "Curve that cannot be faired",
        cause: "The curve has too few points for its energy, or a setting is outside its limits.",
        example: "Two points: the energy of order 4 needs 5.",
        remedy: "Give more points, take a lower `--order`, or correct the setting.",
    },
    Explanation {
        code: "E350",
        title: "Record of a body that cannot be read",
        cause: "A mesh, a panel file or a CAD file has a damaged record, an unknown unit, or nothing that is read.",
        example: "`vertex 0 0 x` in a file of STL.",
        remedy: "Write the file again in the program that it comes from. A mesh in another format may do.",
    },
    Explanation {
        code: "E351",
        title: "Body of unknown size, axes or side",
        cause: "A body is too small or too long, its axes are ambiguous, or it may be half a hull or a whole one.",
        example: "A mesh on one side of y = 0 with a wall there.",
        remedy: "State `--input-unit`, `--axes` or `--body half`, or the same below `[table]` of the TOML beside the \
         file.",
    },
    Explanation {
        code: "E352",
        title: "Faces that cannot be read",
        cause: "A STEP, IGES, 3DM or DXF file has faces of kinds or with edges that the program does not read. A hull without \
         them would be wrong.",
        example: "A face whose edge meets a pole of its surface and has no curve of parameters.",
        remedy: "Convert these faces to B-splines in the program that they come from, or give a mesh.",
    },
    Explanation {
        code: "E353",
        title: "Hydrostatics that no body can have",
        cause: "A volume, a waterplane or a section exceeds that of the box around the body, or KB lies outside of \
         the immersed part. Or integrals over the skin differ by more than 1 %: plates are missing, or stand inside.",
        example: "A mesh with the same skin twice.",
        remedy: "Give the outer skin alone, with its triangles turned outward.",
    },
    Explanation {
        code: "E354",
        title: "Skin of a body that is none",
        cause: "The skin of a body has a long opening below its deck: a side or the bottom is missing. Or its shells cross, and are \
         too many for their union. Or untrimmed surfaces stand twice where bodies have a wall in common.",
        example: "A box without its port side: 900 for 1800 m3.",
        remedy: "Close the body: deck, transom and flat bow alone may be missing. Unite its shells to one skin.",
    },
];
