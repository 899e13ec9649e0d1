//! Codes of what commands end with.

use super::Explanation;

pub(super) const RESULTS: [Explanation; 24] = [
    Explanation {
        code: "E401",
        title: "Infeasible targets",
        cause: "No hull within the tolerances meets all targets and rules of `fair`. The files hold a compromise.",
        example: "`loftsman fair table.csv --cb 0.7 --tolerance \"1 mm\"` for a hull of another C_B.",
        remedy: "Follow the message: widen the tolerances, take the nearest target, unlock offsets, or drop a rule.",
    },
    Explanation {
        code: "E402",
        title: "Solver stopped early",
        cause: "The solver stopped before the optimum of `fair` was proved. The files hold its best point.",
        example: "The message itself: `the solver stopped before the optimum was proved`.",
        remedy: "Widen the tolerances or relax the targets. The residuals are in `fairing.json`.",
    },
    Explanation {
        code: "E403",
        title: "Metacentre or wetted surface off its target",
        cause: "Metacentre and wetted surface are not linear, and the steps towards their targets did not converge. \
         The files hold the nearest hull.",
        example: "The message itself: `what is held of metacentre or wetted surface did not come to its target`.",
        remedy: "Look at `constraints` in `fairing.json`, widen the tolerance, or move the target.",
    },
    Explanation {
        code: "E410",
        title: "Infeasible targets of a curve",
        cause: "No curve within the tolerances has the area, centroid, slope or number of inflections. What is \
         written is a compromise.",
        example: "`loftsman fair-curve curve.csv --area 200 --tolerance \"1 mm\"` for a curve of 36 m2.",
        remedy: "Give the tolerance of the message, or a target within the stated interval.",
    },
    Explanation {
        code: "E420",
        title: "Daughter out of reach",
        cause: "No daughter of this parent meets the targets of `derive` together. Sections would pass each other, or \
         half-breadths the centreplane or the breadth.",
        example: "`loftsman derive configs/tug.toml --cb 0.9`.",
        remedy: "Take the nearest value of the message, free a target that is kept, or take another parent.",
    },
    Explanation {
        code: "E421",
        title: "Value that no ship has",
        cause: "A target of `derive` is outside of what any hull of these dimensions has: C_B above 1, or a centre beyond \
         the ends.",
        example: "`loftsman derive configs/tug.toml --displacement \"9000 t\"` for a tug of 28 m.",
        remedy: "Correct the value, or its unit. The message states the limits.",
    },
    Explanation {
        code: "E422",
        title: "Target that the method does not take",
        cause: "The method of `derive` changes other quantities than this one, or two targets that it takes exclude each \
         other.",
        example: "`loftsman derive configs/tug.toml --cwp 0.8 --method lackenby`.",
        remedy: "Take `--method nearest`, or leave the target out.",
    },
    Explanation {
        code: "E423",
        title: "Weights or targets of a blend",
        cause: "The weights of `blend` are not one a hull, not negative and 1 in sum. Or k hulls are given more than k - 1 \
         targets, and one for each free dimension.",
        example: "`loftsman blend configs/tug.toml configs/yacht.toml --weights 0.5,0.6`.",
        remedy: "Correct the weights, leave a target out, name another hull, or free a dimension with `--free`.",
    },
    Explanation {
        code: "E424",
        title: "Hulls without a common chart",
        cause: "The profiles of the hulls are so different that the lines of one cannot be laid into the other without \
         crossing.",
        example: "`E424 Yacht and Barge have no common chart: near x = 2.10 m, z = 0.40 m no point of it corresponds`.",
        remedy: "Blend hulls with profiles that are alike: stem, stern and keel.",
    },
    Explanation {
        code: "E425",
        title: "Wave resistance that is no quadratic form",
        cause: "Option `--wave-resistance` of `derive` and `fair` needs a hull whose waterlines are lines of its net. A surface with \
         rocker has others. A net of more than 5000 half-breadths that may change is too large.",
        example: "`loftsman derive yacht-with-rocker/hull.json --wave-resistance 0.35`.",
        remedy: "Take a hull with a level keel and level waterlines, as `generate` makes them.",
    },
    Explanation {
        code: "E501",
        title: "Failed self-test",
        cause: "The command `self-test` computes an analytic body, and a number differs from its closed form.",
        example: "`loftsman self-test` on a damaged build.",
        remedy: "Look at the lines marked FAILED, and report them with the version of the program.",
    },
    Explanation {
        code: "E502",
        title: "Failed check",
        cause: "The command `check` found suspects or problems, or `validate` found a figure beyond its tolerance.",
        example: "`E502 3 suspects, 1 problem`.",
        remedy: "Look at the list of the command. `check --accept S1` writes the table with the proposal for S1.",
    },
    Explanation {
        code: "E503",
        title: "Hull no fairer than its table",
        cause: "The targets are met, and the hull has more changes of sign or monotone pieces than the surface \
         through the table. Or it has no fewer changes of sign, and far fewer are possible. The files are written.",
        example: "`E503 table.csv: the hull is no fairer than the surface through the table: 16 > 18 changes of sign`.",
        remedy: "Give nearer targets, wider tolerances or more smoothing with `--weight`, or look for errors with \
         `loftsman check`.",
    },
    Explanation {
        code: "E504",
        title: "Format that is not written",
        cause: "Of several formats of `export` some cannot be written for this hull. The files of the others are there.",
        example: "`E504 not written: gdf: the format needs a draught, and none is stated`.",
        remedy: "Give what the message asks for, and write these formats again.",
    },
    Explanation {
        code: "E505",
        title: "Daughter that is not fair",
        cause: "The targets of `derive` are met, and the daughter has more than one and a half times the inflections of its \
         parent, and two. The files are written.",
        example: "`E505 the targets are met, and the daughter is not fair: 15 > 59 inflections`.",
        remedy: "Give targets nearer to the parent, free one that is kept, or fair the table of the daughter.",
    },
    Explanation {
        code: "E510",
        title: "Particulars that no formula serves",
        cause: "A particular of the hull that the method needs is missing or is none that a ship has.",
        example: "`resistance` of a hull whose waterline is all parallel body.",
        remedy: "State the particular by the option that the message names, or take `--method michell`.",
    },
    Explanation {
        code: "E601",
        title: "Files that exist",
        cause: "The command would overwrite files, and does not do so without `--force`.",
        example: "`loftsman generate configs/box.toml` for the second time.",
        remedy: "Give `--force`, or another folder with `-o`.",
    },
    Explanation {
        code: "E602",
        title: "File system",
        cause: "The operating system refuses to read, write or remove a file or a folder.",
        example: "`loftsman hydro nothing.csv`: no such file.",
        remedy: "Check the path, the permissions and the space. The message ends with what may help.",
    },
    Explanation {
        code: "E701",
        title: "Unknown option, argument or command",
        cause: "The command line has a word that the program does not know.",
        example: "`loftsman fair offsets.csv --tolerances 5`.",
        remedy: "Correct the word. `loftsman help COMMAND` lists all options.",
    },
    Explanation {
        code: "E702",
        title: "Missing option, argument or value",
        cause: "The command needs an argument, or an option needs a value, and there is none.",
        example: "`loftsman hydro`.",
        remedy: "Give it. The usage line shows where it stands.",
    },
    Explanation {
        code: "E703",
        title: "Value that an option does not take",
        cause: "The value of an option is of another kind, or outside its range.",
        example: "`loftsman report out/frigate --dpi 5000`: expected 20 to 600 dots per inch.",
        remedy: "Give a value of the kind and the range that the message states, or one of its list. `--help` behind the \
         command describes the option.",
    },
    Explanation {
        code: "E704",
        title: "Options that exclude each other",
        cause: "Two options contradict each other, or one is given twice.",
        example: "`--km 9 --gm 1`.",
        remedy: "Leave one of them out.",
    },
    Explanation {
        code: "E705",
        title: "Request that the command cannot meet",
        cause: "Options together request what the command cannot give for this hull or this file.",
        example: "`export hull.json -f gdf` of a hull without a draught.",
        remedy: "Follow the message: it names the option that is missing or too many.",
    },
    Explanation {
        code: "E901",
        title: "Fault of the program",
        cause: "A step that must not fail has failed. The input is not the cause.",
        example: "`E901 no plane. This is a fault of the program; please report it`.",
        remedy: "Report the message, the command and the input.",
    },
];
