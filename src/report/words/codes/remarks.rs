//! Codes of notes and warnings.

use super::Explanation;

pub(super) const REMARKS: [Explanation; 44] = [
    Explanation {
        code: "N321",
        title: "How a table is read",
        cause: "The program reports what it detected in a table or a body: layout, separator, order, unit.",
        example: "`rows are stations, columns are waterlines (by the words of the headers)`.",
        remedy: "Compare with the table. Declare what is wrong in a comment or in the TOML beside the file.",
    },
    Explanation {
        code: "W164",
        title: "Suspect in a table that makes no hull",
        cause: "A fit is refused, and the table has suspects. The worst may be the reason.",
        example: "`the worst is station 0, waterline 3.125 m`.",
        remedy: "Run `loftsman check` on the table, and correct the offset.",
    },
    Explanation {
        code: "W202",
        title: "Ratio outside the band of the preset",
        cause: "L/B, B/T or another ratio is outside the usual band of the ship type. The hull is built all the same.",
        example: "`Lpp = 80` and `B = 15.5` for a general cargo ship: L/B 5.161 for 5.3 to 8.",
        remedy: "Check the dimensions, or choose another preset.",
    },
    Explanation {
        code: "W203",
        title: "Midship coefficient at the largest section",
        cause: "The parallel body does not reach Lpp/2. C_M is then held at the largest section, not at midship.",
        example: "`parallel_body = [0.52, 0.6]`.",
        remedy: "Let the parallel body contain 0.5, or accept C_M at the stated position.",
    },
    Explanation {
        code: "W204",
        title: "Design that hardly any ship has",
        cause: "LCB is more than 6 % of Lpp from midship, or a half angle of entrance is outside 3 to 70 degrees.",
        example: "`LCB = \"8 %\"` in a design file.",
        remedy: "Check the sign of LCB, where AP is, and the lengths of entrance and run.",
    },
    Explanation {
        code: "W306",
        title: "No profiles of stem and stern",
        cause: "The table does not state where its waterlines end. The program extrapolates their ends.",
        example: "A matrix without rows `stern` and `stem`.",
        remedy: "Give rows `stern` and `stem` below the half-breadths, or points below `[endings]`.",
    },
    Explanation {
        code: "W307",
        title: "Few waterlines below the draught",
        cause: "Fewer than six waterlines lie at or below T. Volumes from such a table are coarse.",
        example: "`T = 1 m` for the waterlines 0, 0.5, 1 and 2 m.",
        remedy: "Add waterlines below the draught, above all near the bilge.",
    },
    Explanation {
        code: "W308",
        title: "Draught above the table",
        cause: "The stated T is above the highest waterline or point of the table.",
        example: "`T = 5 m` for a table that ends 2 m above the base line.",
        remedy: "Correct T, or give the waterlines up to it.",
    },
    Explanation {
        code: "W309",
        title: "Breadth that is not that of the table",
        cause: "The stated B differs by more than 5 % from twice the greatest half-breadth up to the draught.",
        example: "`B = 8 m` for half-breadths up to 2 m.",
        remedy: "Correct B, or the unit of the half-breadths.",
    },
    Explanation {
        code: "W310",
        title: "Length that is not that of the table",
        cause: "The stated L_PP differs by more than a factor of 1.5 from the extent of the stations.",
        example: "`Lpp = 80 m` for stations from 0 to 20 m.",
        remedy: "Correct L_PP, or the unit, the spacing or the number of the stations.",
    },
    Explanation {
        code: "W311",
        title: "Stations on both sides of AP",
        cause: "Positions count from AP, and x = 0 lies in the middle half of the stations. LCB, C_M and L_PP are \
         those of a hull with AP there.",
        example: "Stations at -10, 0 and 10 m in a column `x [m]`.",
        remedy: "Name the column `x_from_midship` if the distances count from there.",
    },
    Explanation {
        code: "W312",
        title: "More remarks than are shown",
        cause: "A file has more than 100 warnings and notes. The rest is counted and not shown.",
        example: "`50 more problems not shown`.",
        remedy: "Correct the cause of the first remarks, and run the command again.",
    },
    Explanation {
        code: "W314",
        title: "Blank cells among half-breadths",
        cause: "A cell between half-breadths is blank. It is read as not known, and not as no hull.",
        example: "The row `10,0,1,,2`.",
        remedy: "Write the offset, `?` for not known, or `-` where there is no hull.",
    },
    Explanation {
        code: "W315",
        title: "Bottom that the table does not show",
        cause: "The table leaves a part of the bottom open: below its lowest waterline, or below the first points of its \
         sections. This part may be more than 1 % of the volume.",
        example: "A lowest waterline at 0.5 m: up to 19 % of the volume is below it.",
        remedy: "Give a row or a column `keel` and one `flat of bottom` [m], the lowest waterlines, or sections that begin \
         on the centreplane.",
    },
    Explanation {
        code: "W317",
        title: "End that the table does not show",
        cause: "The outermost station still has a section, and no profile or transom ends the hull there. It is cut off upright, without more than 1 % of the volume.",
        example: "Stations from 10 to 90 m of 100 m.",
        remedy: "Give the stations to the ends, or the profiles of stern and stem.",
    },
    Explanation {
        code: "W320",
        title: "Assumption that changes numbers",
        cause: "The file leaves something open that changes the hull, such as its unit, origin, axes, order or side. \
         The message states what the program assumes.",
        example: "`distances count from midship and L_PP is not known`.",
        remedy: "Declare it as the message shows. Then the warning disappears.",
    },
    Explanation {
        code: "W330",
        title: "Origin of sections",
        cause: "Sections of a text format count x from an origin of their own. The message states where the program \
         puts AP.",
        example: "`taken as a point that is not named; the aftmost section is taken as AP`.",
        remedy: "Check LCB. State Lpp beside the table if AP is elsewhere.",
    },
    Explanation {
        code: "W331",
        title: "Both sides given",
        cause: "Sections give both sides of the hull. The starboard side is taken, and the message states how far \
         port is from it in metres.",
        example: "`29 sections give both sides; starboard is taken`.",
        remedy: "Check the sections if the sides differ by more than the accuracy of the table.",
    },
    Explanation {
        code: "W332",
        title: "Part that is left out",
        cause: "The program does not read a part of the file: a column, a hull, a component, a curve or a section.",
        example: "`the column 'area' is not used`.",
        remedy: "Check that the part is no part of the hull. Otherwise give it in another form.",
    },
    Explanation {
        code: "W334",
        title: "Convention of a text format",
        cause: "A text format has a setting that the program does not apply, or leaves one open. The message states \
         what is taken.",
        example: "`trim 0.5 m is not applied: heights are those of the file`.",
        remedy: "Check the stated convention, and change the file where it is another.",
    },
    Explanation {
        code: "W335",
        title: "Unusual value",
        cause: "A value is read although it is unusual: a fraction above 1, a half-breadth slightly below 0, or an offset alone among zeros.",
        example: "`9` for `0.9` in a table of fractions.",
        remedy: "Look at the value. A decimal point may be missing.",
    },
    Explanation {
        code: "W336",
        title: "Lines that cross",
        cause: "Two lines of a table of lines stand in another order at a station than at most others. \
                Or a waterline or buttock is outside the section of the other lines at most stations.",
        example: "A chine of 6-7-1 for 0-7-1 is above the sheer.",
        remedy: "Correct the height at that station, or the position of the waterline or buttock.",
    },
    Explanation {
        code: "W338",
        title: "Chine that no mark tells",
        cause: "Sections as points turn at one point between straight panels, at neighbouring stations. The program takes these points for knuckles.",
        example: "Sections of keel, chine and sheer alone.",
        remedy: "Mark knuckles with `K` where the chines are others. Give more points of round sections.",
    },
    Explanation {
        code: "W340",
        title: "Sections that the hull does not follow",
        cause: "The volume inside the sections as they are drawn differs from that of the hull by more than 1 %. Points were left out, or curves through them are others.",
        example: "The well of a floating dock: +25 %.",
        remedy: "Give the points in order from keel to deck, and mark the chines.",
    },
    Explanation {
        code: "W341",
        title: "Suspect offsets that change the volume",
        cause: "Offsets stand apart from their neighbours, and the volume with the expected ones differs by more than 1 %.",
        example: "`57.40` for `7.440` makes a volume 17 % larger.",
        remedy: "Run `check`, and correct the offsets.",
    },
    Explanation {
        code: "W342",
        title: "Stations or waterlines far apart",
        cause: "The hull between them encloses 3 % more or less than straight lines do. The surface there follows from lines farther away.",
        example: "A box with wedges for ends by four stations.",
        remedy: "Give stations and waterlines where the hull bends, beside knuckles and above the keel.",
    },
    Explanation {
        code: "W351",
        title: "Body that is not closed",
        cause: "A mesh has open edges, or shells that reach into others, or surfaces share no side.",
        example: "A mesh without deck: `4 edges open`.",
        remedy: "Only deck, transom and flat bow may be missing. Unite shells to one skin.",
    },
    Explanation {
        code: "W352",
        title: "Surfaces that are not read",
        cause: "A STEP, IGES or DXF file has entities beside its faces or curves that are not read, or a 3DM file hides objects. \
         Or a 3MF package has objects that are no model or are not printed.",
        example: "`1 CYLINDRICAL_SURFACE of no face are not read`.",
        remedy: "Nothing, if these are no part of the hull. `--parts` names layers of a 3DM file that count, also hidden ones. \
         Objects that are hidden one by one are shown in the file alone.",
    },
    Explanation {
        code: "W353",
        title: "Coefficients above 1",
        cause: "C_B, C_M, C_P or C_WP is above 1. The length, breadth and draught are less than those of the body, \
         or are measured elsewhere. Or the surface swells between the lines of a table.",
        example: "`Lpp = 30` for a body of 60 m: CB 2.000.",
        remedy: "State Lpp, B and T of the body in metres.",
    },
    Explanation {
        code: "W354",
        title: "Hull that hardly any ship is",
        cause: "LCB at the design draught is more than 6 % of Lpp from midship. Or a half angle of entrance is outside 3 to 70 degrees.",
        example: "`hydro` of a mesh whose bow points aft.",
        remedy: "Check where AP is, and the forward axis (`--axes`).",
    },
    Explanation {
        code: "W355",
        title: "Skin whose integrals disagree",
        cause: "The waterplane by the waterline and by the skin below differ by more than 0.1 %, or volumes by x, y and z do. \
         The skin has slits or sheets, or the draught is above the rim of an open deck.",
        example: "Sides that begin 8 mm above the bilge: 0.3 % of the volume.",
        remedy: "Close the skin below the draught, and give it alone. Deck, transom and flat bow may be missing.",
    },
    Explanation {
        code: "W401",
        title: "Targets met by adding inflections",
        cause: "The hull of `fair` meets its targets, or has less wave resistance, and all lines together have more inflections than before.",
        example: "`the targets are met by adding inflections: 16 > 20`.",
        remedy: "Give nearer targets, the wider tolerances that the message names, or a lesser `--wave-weight`.",
    },
    Explanation {
        code: "W402",
        title: "Lines that bend more often",
        cause: "Single lines of the fair hull have more inflections than on the surface through the table.",
        example: "`1 line bends more often than before: waterline 0.965 m 4 > 7`.",
        remedy: "Limit their number below `shape.inflections`, or take less smoothing with `--weight`.",
    },
    Explanation {
        code: "W420",
        title: "Daughter with more inflections",
        cause: "The hull that `derive` or `blend` made has more inflections of stations and waterlines than the hulls that it \
         is made from.",
        example: "`loftsman derive configs/wigley.toml --cb 0.56`.",
        remedy: "Give targets nearer to the parent, free one that is kept, or fair the table of the daughter.",
    },
    Explanation {
        code: "W421",
        title: "Hull moved to the chart of a blend",
        cause: "A hull of `blend` is not within a ten thousandth of L_PP of its surface on the common chart. Knuckles or \
         profiles that lie elsewhere are rounded there.",
        example: "`W421 barge/hull.json: Barge moves by 31.2 mm at most on its way to the chart of Coaster`.",
        remedy: "Blend hulls whose profiles and knuckles are alike, and look at the figures.",
    },
    Explanation {
        code: "W422",
        title: "Daughter of another breadth",
        cause: "The waterline of the hull that `derive` made is more than a thousandth of B broader or narrower than that of its \
         scaled parent. Coefficients refer to the B that is printed.",
        example: "`loftsman derive configs/tug.toml --parallel-body 12,16`.",
        remedy: "Give a shorter parallel body, more displacement or a larger midship coefficient, or state the B that is wanted.",
    },
    Explanation {
        code: "W423",
        title: "Parallel middle body that is lost",
        cause: "The scaled parent of `derive` has sections that are alike amidships. With the targets no such body of half its length \
         is left.",
        example: "`loftsman derive configs/bulk-carrier.toml --entrance 20`.",
        remedy: "Give targets nearer to the parent, or state the body that is wanted with `--parallel-body`.",
    },
    Explanation {
        code: "W510",
        title: "Speeds outside the range of the data",
        cause: "Figures of a statistical method are extrapolated: a Froude number or a coefficient is outside the range of its data.",
        example: "`resistance configs/yacht.toml --speeds 30:40:1`.",
        remedy: "Take lower speeds or another method, or treat these figures as an extrapolation.",
    },
    Explanation {
        code: "W511",
        title: "Half angle of entrance assumed",
        cause: "The stem is rounded, so that the angle of the waterline there is no half angle of entrance. One is assumed.",
        example: "`resistance configs/bulk-carrier.toml --speeds 12:16:1`.",
        remedy: "State `--half-angle`.",
    },
    Explanation {
        code: "W512",
        title: "Hull that is not thin",
        cause: "Thin-ship theory assumes a slender hull. At this hull its figures rank hulls at best.",
        example: "`resistance configs/bulk-carrier.toml --speeds 12:16:1 --method michell`.",
        remedy: "Compare with `--method holtrop-1984`.",
    },
    Explanation {
        code: "W513",
        title: "Form factor or bulb assumed",
        cause: "Nobody stated the form factor or the bulb, and the result depends on it.",
        example: "`resistance configs/wigley.toml --speeds 10:20:2 --method michell`.",
        remedy: "State `--form-factor`, or `--bulb-area` and `--bulb-height`.",
    },
    Explanation {
        code: "W514",
        title: "Sections that leave volume out",
        cause: "The volume between the written sections is more than 0.3 % off that of the hull. Or so much lies below the lowest and \
         above the highest offsets.",
        example: "`volume 4.73 m3, -3.8e-01 of the hull's`.",
        remedy: "Take a smaller `--deviation`, or a format of surfaces.",
    },
    Explanation {
        code: "W515",
        title: "Frames that are not reached",
        cause: "Frames of `loft` lie beyond the ends of the surface, or of the face inside or outside its skin.",
        example: "`loftsman loft hull.json --frames -5,10,20` where the hull begins at 0 m.",
        remedy: "Give frames between the ends of the hull.",
    },
    Explanation {
        code: "W520",
        title: "Conventions that differ",
        cause: "The two hulls of `compare` have different conventions, of density say. Those of the first serve for \
         both.",
        example: "`loftsman compare a/hull.json b/hull.json` where b is in fresh water.",
        remedy: "Generate or fit the second hull with the conventions of the first.",
    },
];
