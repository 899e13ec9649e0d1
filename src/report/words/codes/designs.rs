//! Codes of designs, hulls, methods, jobs and options.

use super::Explanation;

pub(super) const DESIGNS: [Explanation; 54] = [
    Explanation {
        code: "E101",
        title: "Value out of its range",
        cause: "A value of the design is outside the range that the hull family can build. Filled-in values count \
         too: a draught that follows from B/T, say. Dimensions that differ by more than a factor of 2000 have this \
         code as well.",
        example: "`Cb = 1.2` below `[form]`: the block coefficient must be between 0.15 and 0.98.",
        remedy: "Give a value within the range that the message states, or correct its unit. Lengths are metres \
         unless they carry a unit.",
    },
    Explanation {
        code: "E102",
        title: "Prismatic coefficient of 1 or more",
        cause: "Cb divided by Cm is the prismatic coefficient Cp of the hull. A Cp of 1 is a prism over the whole \
         length, and no ship reaches it.",
        example: "`Cb = 0.8` and `Cm = 0.75`: Cp would be 1.067.",
        remedy: "Raise Cm above Cb, lower Cb, or leave Cm out. The message names the Cm of a regression for this Cb.",
    },
    Explanation {
        code: "E103",
        title: "Waterplane coefficient below the block coefficient",
        cause: "Cwp is given and is not above Cb. A hull whose sections narrow downwards has a waterplane fuller \
         than its volume.",
        example: "`Cb = 0.75` and `Cwp = 0.7`.",
        remedy: "Raise Cwp above Cb, or leave it out. The message names a typical Cwp for this Cb.",
    },
    Explanation {
        code: "E104",
        title: "LCB out of reach",
        cause: "No hull of these coefficients has its centre of buoyancy so far forward or aft. The program computes \
         the reach from Cp, and later from the parallel body and the ends.",
        example: "`Cb = 0.8` and `LCB = \"+9 %\"`: the reach is -1.64 to +7.69 % of Lpp from midship.",
        remedy: "Give an LCB within the reach of the message, move the parallel body, or leave LCB out.",
    },
    Explanation {
        code: "E105",
        title: "Draught not below the depth",
        cause: "The design draught T reaches or exceeds the depth D. Analytic bodies accept T = D, and the ellipsoid \
         has an upper limit of D as well.",
        example: "`T = 9` and `D = 6` below `[dimensions]`.",
        remedy: "Raise D or lower T; both are metres above the base line.",
    },
    Explanation {
        code: "E106",
        title: "Midship section out of reach",
        cause: "No midship section has this Cm together with the given bilge radius and rise of floor.",
        example: "`Cm = 0.99` with `bilge_radius = 4` on B = 16 m and T = 6 m: Cm lies between 0.6965 and 0.9285.",
        remedy: "Give a Cm within the stated limits, change the bilge radius, or leave one of the three out.",
    },
    Explanation {
        code: "E107",
        title: "Waterplane coefficient out of reach",
        cause: "Cwp is given, and no waterline reaches it with this parallel body and these ends.",
        example: "`Cwp = 0.80` with `parallel_body = [0.125, 0.875]` on Lpp = 80 m: 0.8905 to 1.0000 are possible.",
        remedy: "Give a Cwp within the limits of the message, or move the ends of the parallel body.",
    },
    Explanation {
        code: "E108",
        title: "Block coefficient out of reach",
        cause: "No waterlines over these ends enclose the volume that Cb requires. The same code stands where Cb and \
         LCB together are infeasible.",
        example: "`Cb = 0.95` on 100 x 16 x 6 m: 0.8937 to 0.9263 with the ends of the preset.",
        remedy: "Follow the hint of the message: change Cwp, the parallel body or the ends. Or give a Cb within its \
         limits.",
    },
    Explanation {
        code: "E109",
        title: "Ends that leave no room",
        cause: "Lengths along the ship contradict each other: parallel body, entrance, run, cut-up, forefoot or \
         raked stem. Each end needs at least 5 % of Lpp.",
        example: "`parallel_body = [0.01, 0.5]`: 1 m is left aft of it on Lpp = 100 m, and 5 m are needed.",
        remedy: "Move one of the positions that the message names, or leave one out.",
    },
    Explanation {
        code: "E110",
        title: "Displacement against block coefficient",
        cause: "The displacement and Cb are both given, and Lpp B T Cb is another volume by more than 0.1 %.",
        example: "`Cb = 0.7` and `displacement = \"9000 m3\"` on 100 x 16 x 6 m.",
        remedy: "Give one of the two, or the draught that the message computes.",
    },
    Explanation {
        code: "E111",
        title: "Lengths that do not add up to Lpp",
        cause: "Run, parallel body and entrance together must be Lpp. Two of them must leave room for the third.",
        example: "`entrance_length = 60` and `run_length = 60` with `Lpp = 100`.",
        remedy: "Leave one of the three out; the program computes it.",
    },
    Explanation {
        code: "E112",
        title: "Transom breadth out of reach",
        cause: "No stern with this height of the transom and this cut-up has the breadth of transom at the deck.",
        example: "`transom_beam = 0.97` below `[form.stern]`: 0.318 to 0.782 B are possible.",
        remedy: "Give a breadth within the limits, lower the transom, or lengthen the cut-up.",
    },
    Explanation {
        code: "E113",
        title: "Flare out of reach",
        cause: "No bow with this stem and this waterline has the mean flare at 0.9 Lpp.",
        example: "`flare = \"69 deg\"` below `[form.bow]`: 9.1 to 50.5 deg are possible.",
        remedy: "Give an angle within the limits of the message, or change the rake of the stem.",
    },
    Explanation {
        code: "E114",
        title: "Entrance angle that cannot hold the volume",
        cause: "The half angle of entrance is limited, and no waterline below that angle reaches Cb and LCB.",
        example: "`Cb = 0.8` with `entrance_half_angle_max = \"6 deg\"`.",
        remedy: "Allow a larger angle, lengthen the entrance, or lower Cb.",
    },
    Explanation {
        code: "E115",
        title: "Ends too full for a smooth surface",
        cause: "Waterlines of the ends become nearly steps, and the surface through the form bulges. Coefficients \
         alone do not make a ship.",
        example: "The preset `yacht` with `Lpp = 10` and `Cb = 0.555`: the surface bulges by 0.234 m.",
        remedy: "Lower Cb, shorten the cut-up, or lengthen the parallel body.",
    },
    Explanation {
        code: "E120",
        title: "Not TOML",
        cause: "The file is not written in TOML, or has more than 1 MiB. The rest of the file is not judged before \
         this is corrected.",
        example: "`[dimensions` without its closing bracket.",
        remedy: "Correct the line and column that the message names.",
    },
    Explanation {
        code: "E121",
        title: "Unknown key",
        cause: "A key is not one of this kind of file, stands in another table, or was removed.",
        example: "`form.Cpw`: the message asks whether Cwp is meant.",
        remedy: "Take the proposed key. `loftsman schema` lists the keys of designs, methods and jobs.",
    },
    Explanation {
        code: "E122",
        title: "Value of the wrong kind",
        cause: "A key has a value of another kind than it takes: a text for a number, a number for a table, say.",
        example: "`Cm = true`: a number or the name of a regression is expected.",
        remedy: "Write the kind of value that the message expects.",
    },
    Explanation {
        code: "E123",
        title: "Value that cannot be read",
        cause: "A value has no unit where one is needed, has an unknown unit, or is not in the expected notation.",
        example: "`LCB = 1`: per cent of Lpp, or metres from AP?",
        remedy: "Write the value as the message shows, for example `\"+0.8 %\"` or `\"41.0 m AP\"`.",
    },
    Explanation {
        code: "E124",
        title: "Value outside its limits",
        cause: "A number is read, and is outside of what the key accepts.",
        example: "`water.density = 1025`: the unit is t/m3, and 0.9 to 1.3 are accepted.",
        remedy: "Give a number within the limits, or write its unit: `\"1025 kg/m3\"`.",
    },
    Explanation {
        code: "E125",
        title: "Missing key",
        cause: "A key is required and absent: Lpp of a design, the kind of a method, or the dimension by which \
         another key is measured.",
        example: "A design without `Lpp` below `[dimensions]`.",
        remedy: "Add the keys that the message names.",
    },
    Explanation {
        code: "E126",
        title: "Key that contradicts another",
        cause: "A key occurs twice, belongs to another hull family or method, or has the same meaning as a second key.",
        example: "`Cb = 0.7` and `cb = 0.7`: upper and lower case are the same key.",
        remedy: "Keep one of them.",
    },
    Explanation {
        code: "E127",
        title: "Unknown word",
        cause: "A key takes one word of a list, and the value is none of them.",
        example: "`family = \"bulk\"`: known are cosh, ucl-cosh, wigley, box and ellipsoid.",
        remedy: "Take the proposed word, or one of the list in the message.",
    },
    Explanation {
        code: "E128",
        title: "Unknown schema version",
        cause: "The key `schema` has a number that this version of the program does not read.",
        example: "`schema = 9`.",
        remedy: "Write `schema = 1`, or use a newer version of loftsman.",
    },
    Explanation {
        code: "E129",
        title: "File too long or not UTF-8",
        cause: "An input has more bytes than the program reads, or it is not text in UTF-8. Tables of offsets accept \
         other encodings, designs and jobs do not.",
        example: "A design with a letter in Latin-1: `byte 5 is not UTF-8 text`.",
        remedy: "Save the file as UTF-8. Of a long file give the part that describes the hull.",
    },
    Explanation {
        code: "E130",
        title: "Parameter file that cannot be read",
        cause: "A file `.hgf` or `.huf` does not have its header line and one record with all parameters.",
        example: "A file `.hgf` of one line: it has a header and no record.",
        remedy: "Write the header and the record, or give the parameters as a design file.",
    },
    Explanation {
        code: "E131",
        title: "More problems than are shown",
        cause: "A file has more problems than the 50 that are printed. The message counts the others.",
        example: "A CSV file given to `generate` as a design.",
        remedy: "Correct those that are shown, or check that the file is of the kind that the command reads.",
    },
    Explanation {
        code: "E132",
        title: "Name of a file that no drawing can show",
        cause: "The name of the file has control characters or is too long.",
        example: "A file whose name has a line break.",
        remedy: "Rename the file.",
    },
    Explanation {
        code: "E133",
        title: "Hull that is not in the catalogue",
        cause: "A path begins with `catalogue:`, and the name behind it is none of the catalogue; or that beginning is missing.",
        example: "`loftsman hydro catalogue:s157`.",
        remedy: "Give `catalogue:NAME` with a name that `loftsman catalogue` lists.",
    },
    Explanation {
        code: "E140",
        title: "Hull file that is not JSON",
        cause: "A hull file `hull.json` is not JSON, is cut off, or lacks a member.",
        example: "A file that ends after `{`.",
        remedy: "Run the command that wrote it again.",
    },
    Explanation {
        code: "E141",
        title: "Hull file with impossible contents",
        cause: "A hull file is JSON, and its format, version, knots, sizes or dimensions are none of a hull.",
        example: "`\"format\": \"x\"` in place of `\"format\": \"loftsman-hull\"`.",
        remedy: "Correct the member that the message names, or run the command that wrote the file again.",
    },
    Explanation {
        code: "E150",
        title: "Published table that cannot be read",
        cause: "The table of published figures below `[reference]` has an unknown column, no column T, or a line \
         that is not numbers.",
        example: "A table of the column `DISPVOL` alone: the column T is missing.",
        remedy: "Write a header of codes with T, and one line of numbers for each draught.",
    },
    Explanation {
        code: "E160",
        title: "Method setting out of its range",
        cause: "A setting of a fitting method does not agree with the table or with another setting.",
        example: "`control_points_up = 99` for 11 waterlines: 3 to 11 are possible.",
        remedy: "Give a value within the limits that the message states.",
    },
    Explanation {
        code: "E161",
        title: "Method file without a table",
        cause: "The command `fit` has a method file as its only argument, and the file names no table.",
        example: "`loftsman fit method.toml` where the file has no line `table = ...`.",
        remedy: "Write `table = \"FILE\"` in it, or run `loftsman fit TABLE --method FILE`.",
    },
    Explanation {
        code: "E162",
        title: "Table that makes no surface",
        cause: "The table has too few stations, waterlines or sections for a surface.",
        example: "A table of one station: a surface needs at least 2 stations and 2 waterlines.",
        remedy: "Add the missing lines, or correct their positions.",
    },
    Explanation {
        code: "E163",
        title: "Surface that is no hull",
        cause: "The method fits a surface, and that surface folds, exceeds the stated breadth, or contradicts the \
         stated draught.",
        example: "`B = 0.1` for half-breadths of 1 m.",
        remedy: "Correct the stated dimensions, look for errors with `loftsman check`, or take another method.",
    },
    Explanation {
        code: "E170",
        title: "Two keys with the same meaning",
        cause: "Two keys of a job, or options of `fair`, state the same thing: KM and GM, fairness and weight, a \
         coefficient and its volume.",
        example: "`KM = \"table\"` and `GM = \"table\"` below `[hold]`.",
        remedy: "Give one of them.",
    },
    Explanation {
        code: "E171",
        title: "No such station",
        cause: "A job or an option of `fair` names a station that the table does not have. Section areas outside of \
         the stations or of their limits count too.",
        example: "`stations = [\"99\"]` below `[lock]`.",
        remedy: "Take a name or a position [m] of the list in the message.",
    },
    Explanation {
        code: "E172",
        title: "No such waterline",
        cause: "A job or an option of `fair` names a waterline that the table does not have.",
        example: "`waterlines = [\"99\"]` below `[lock]`.",
        remedy: "Take a height [m] of the list in the message.",
    },
    Explanation {
        code: "E173",
        title: "No offset there",
        cause: "A job or an option of `fair` names a station and a waterline where the table has no offset.",
        example: "`cells = [\"0@5\"]` below `[lock]`, where station 0 is blank at 5 m.",
        remedy: "Name another offset, or add it to the table.",
    },
    Explanation {
        code: "E174",
        title: "Job file without a table",
        cause: "The command `fair` has a job file as its only argument, and the file names no table.",
        example: "`loftsman fair job.toml` where the file has no `[table] file`.",
        remedy: "Write `[table] file = \"FILE\"` in it, or give the table to the command.",
    },
    Explanation {
        code: "E175",
        title: "Table that cannot be faired",
        cause: "The table makes no surface, its offsets do not determine one, or a stated dimension does not suit \
         the table.",
        example: "`T = 50` below `[dimensions]` for a hull of 6.25 m depth.",
        remedy: "Correct the dimension that the message names. Otherwise run `loftsman check` and `loftsman fit` on \
         the table.",
    },
    Explanation {
        code: "E176",
        title: "Rule that the hull does not have",
        cause: "A job declares a flat, a fixed line or another rule for a part of the hull that the surface does not \
         have.",
        example: "`bottom = [\"stations 0 to 1\"]` below `[flat]` for ends without a flat of bottom.",
        remedy: "Look at the hull with `loftsman fit` and `loftsman inspect`, and correct the place or drop the rule.",
    },
    Explanation {
        code: "E177",
        title: "Empty part of a line",
        cause: "A job limits a line to a part that is empty, or that crosses fewer than two lines of the table.",
        example: "`convex = [\"waterline 2 from 10 to 0\"]` below `[shape]`.",
        remedy: "Write the lesser position first, and a part with two lines of the table at least.",
    },
    Explanation {
        code: "E178",
        title: "No such line",
        cause: "A job names a knuckle, a tangent line or another line that the table does not declare.",
        example: "`lines = [\"line chine\"]` below `[lock]` for a table without a chine.",
        remedy: "Take a name of the list in the message, or declare the line beside the table.",
    },
    Explanation {
        code: "E179",
        title: "Centre of gravity without GM, or GM without it",
        cause: "GM needs KG, the height of the centre of gravity above the base line. Without GM, KG has no use.",
        example: "`KG = 3` below `[hold]` and no `GM`.",
        remedy: "Give both, or hold KM instead of GM.",
    },
    Explanation {
        code: "E180",
        title: "Line that cannot be a knuckle",
        cause: "A job accepts a proposed line that does not exist, or declares a knuckle or tangent line where the \
         net has no line.",
        example: "`--accept-lines L9` where no line is proposed.",
        remedy: "Run with `--verbose` for the proposed lines. Or declare the line beside the table.",
    },
    Explanation {
        code: "E181",
        title: "Folder that is no result",
        cause: "The command `report` misses a file that `generate`, `fit` or `fair` writes.",
        example: "`loftsman report empty` for an empty folder.",
        remedy: "Give the folder that one of these commands wrote, or the file of `hydro --json`.",
    },
    Explanation {
        code: "E182",
        title: "File of a result that cannot be read",
        cause: "A file of a result is damaged, is of another program, or does not agree with the others.",
        example: "`{\"a\": 1}` as the file of `loftsman report`.",
        remedy: "Run the command that wrote it again.",
    },
    Explanation {
        code: "E183",
        title: "Two tolerances for one line",
        cause: "A job gives one station, waterline or offset two tolerances under two names.",
        example: "`\"9 1/2\" = \"1 mm\"` and `\"95 m\" = \"2 mm\"` where station 9 1/2 is at 95 m.",
        remedy: "Name it once.",
    },
    Explanation {
        code: "E184",
        title: "Target without a draught",
        cause: "A target such as C_B, C_M, LCB or GM refers to a draught, and neither table nor job states one.",
        example: "`loftsman fair table.csv --cb 0.7` for a table without T.",
        remedy: "Give `--draught`, or T in metres below `[table]` or `[dimensions]`. Or leave the target out.",
    },
    Explanation {
        code: "E185",
        title: "Folder with files of another run",
        cause: "A file of the folder differs from what the manifest lists. It is of another run, or was changed since.",
        example: "`report out/frigate` after `offsets.csv` in it was edited.",
        remedy: "Run the command again with `--force`, and report then.",
    },
    Explanation {
        code: "E199",
        title: "Surface that cannot be built",
        cause: "The interpolation of a valid form fails. No design is known to cause it.",
        example: "The message itself: `the surface could not be built`.",
        remedy: "Change one of the coefficients slightly, and report the design file.",
    },
    Explanation {
        code: "E203",
        title: "No such suspect",
        cause: "The option `--accept` of `check` names a suspect that the table does not have, or the table cannot \
         be read.",
        example: "`loftsman check table.csv --accept S9` where no suspect is called S9.",
        remedy: "Run `loftsman check` without `--accept` for the names.",
    },
];
