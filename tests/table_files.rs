//! Tables of offsets in files: workbooks, conventions beside a table, and the command that converts them.

use std::fs;

use loftsman::internals::exchange::{Severity, TableWriting, read_table, read_table_with, write_table};
use loftsman::internals::hull::{Cell, TableLayout};
use loftsman::internals::units::Notation;
use rust_xlsxwriter::{Format, Workbook};

use crate::support::{carried, convert, folder, program, read_text, stderr, stdout};

fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |c, _| if c & 1 == 1 { (c >> 1) ^ 0xedb8_8320 } else { c >> 1 })
    })
}

/// An archive of files that are not compressed; `lie` is added to the sizes that its directory states.
fn archive(files: &[(&str, String)], lie: u32) -> Vec<u8> {
    let (mut bytes, mut directory) = (Vec::new(), Vec::new());
    for (name, contents) in files {
        let offset = u32::try_from(bytes.len()).unwrap();
        let (size, length) = (u32::try_from(contents.len()).unwrap(), u16::try_from(name.len()).unwrap());
        let fields = |lie: u32| {
            let mut part = vec![20, 0, 0, 0, 0, 0, 0, 0, 0, 0];
            part.extend(crc32(contents.as_bytes()).to_le_bytes());
            part.extend(size.to_le_bytes());
            part.extend((size + lie).to_le_bytes());
            part.extend(length.to_le_bytes());
            part.extend([0, 0]);
            part
        };
        bytes.extend(b"PK\x03\x04");
        bytes.extend(fields(0));
        bytes.extend(name.as_bytes());
        bytes.extend(contents.as_bytes());
        directory.extend(b"PK\x01\x02\x14\x00");
        directory.extend(fields(lie));
        directory.extend([0; 10]);
        directory.extend(offset.to_le_bytes());
        directory.extend(name.as_bytes());
    }
    let (count, start) = (u16::try_from(files.len()).unwrap(), u32::try_from(bytes.len()).unwrap());
    let length = u32::try_from(directory.len()).unwrap();
    bytes.extend(directory);
    bytes.extend(b"PK\x05\x06\0\0\0\0");
    bytes.extend([count.to_le_bytes(), count.to_le_bytes()].concat());
    bytes.extend(length.to_le_bytes());
    bytes.extend(start.to_le_bytes());
    bytes.extend([0, 0]);
    bytes
}

/// A workbook of one sheet with the given cells as XML.
fn workbook(cells: &str, lie: u32) -> Vec<u8> {
    let head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>";
    let main = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
    let office = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
    let package = "http://schemas.openxmlformats.org/package/2006";
    let relation = |kind: &str, target: &str| {
        format!(
            "{head}<Relationships xmlns=\"{package}/relationships\"><Relationship Id=\"r1\" Type=\"{office}/{kind}\" \
             Target=\"{target}\"/></Relationships>"
        )
    };
    archive(
        &[
            (
                "[Content_Types].xml",
                format!(
                    "{head}<Types xmlns=\"{package}/content-types\"><Default Extension=\"xml\" ContentType=\"application/xml\"/></Types>"
                ),
            ),
            ("_rels/.rels", relation("officeDocument", "xl/workbook.xml")),
            (
                "xl/workbook.xml",
                format!(
                    "{head}<workbook xmlns=\"{main}\" xmlns:r=\"{office}\"><sheets><sheet name=\"Offsets\" sheetId=\"1\" \
                     r:id=\"r1\"/></sheets></workbook>"
                ),
            ),
            ("xl/_rels/workbook.xml.rels", relation("worksheet", "worksheets/sheet1.xml")),
            (
                "xl/worksheets/sheet1.xml",
                format!("{head}<worksheet xmlns=\"{main}\"><sheetData>{cells}</sheetData></worksheet>"),
            ),
        ],
        lie,
    )
}

/// Rows of texts as cells; what is a number is one, and empty fields are left out.
fn sheet(text: &str) -> String {
    let mut xml = String::new();
    for (row, line) in text.lines().enumerate() {
        xml += &format!("<row r=\"{}\">", row + 1);
        for (column, field) in line.split(',').enumerate().filter(|(_, field)| !field.is_empty()) {
            let place = format!("{}{}", char::from(b'A' + u8::try_from(column).unwrap()), row + 1);
            xml += &match field.parse::<f64>() {
                Ok(number) => format!("<c r=\"{place}\"><v>{number}</v></c>"),
                Err(_) => format!("<c r=\"{place}\" t=\"inlineStr\"><is><t>{field}</t></is></c>"),
            };
        }
        xml += "</row>";
    }
    xml
}

#[test]
fn workbooks_hold_both_layouts() {
    let matrix = "Offsets of a boat,,,\nx [m],0.5,1,1.5\n0,,0.5,(1)\n10,1,2,2.5K\n20,,3-4-5,\n";
    let plain = read_table("t.csv", matrix.as_bytes()).unwrap().table;
    let read = read_table("t.xlsx", &workbook(&sheet(matrix), 0)).unwrap();
    assert_eq!(read.table.name, "Offsets of a boat");
    assert!(read.notes.iter().any(|n| n.message.contains("sheet 'Offsets'")));
    let tidy = write_table(&plain, TableWriting { layout: Some(TableLayout::Tidy), notation: None }).text;
    let tidy = read_table("tidy.xlsx", &workbook(&sheet(&tidy), 0)).unwrap();
    for table in [&read.table, &tidy.table] {
        assert_eq!(table.waterlines, plain.waterlines);
        for (a, b) in table.stations.iter().zip(&plain.stations) {
            let cells = |cells: &[Cell]| cells.iter().map(|c| (c.entry, c.marks)).collect::<Vec<_>>();
            assert_eq!(cells(&a.half_breadths), cells(&b.half_breadths));
        }
    }
    let place = read.table.stations[1].half_breadths[1].written.clone().unwrap();
    assert_eq!((place.row, place.column, place.text.as_str()), (4, 3, "2"));
}

#[test]
fn workbooks_that_cannot_be_read() {
    let message = |bytes: &[u8]| {
        let problems = read_table("t.xlsx", bytes).unwrap_err();
        problems
            .iter()
            .filter(|p| p.severity == Severity::Error)
            .map(ToString::to_string)
            .collect::<Vec<_>>()
            .join("\n")
    };
    let date = "<row r=\"1\"><c r=\"A1\" t=\"inlineStr\"><is><t>x</t></is></c><c r=\"B1\"><v>1</v></c></row>\
                <row r=\"2\"><c r=\"A2\"><v>0</v></c><c r=\"B2\" t=\"d\"><v>2005-03-04T00:00:00</v></c></row>";
    assert!(message(&workbook(date, 0)).contains("E317 t.xlsx row 2, column 2: the cell is a date"));
    // A refusal of input, and no list of cells.
    let folder = folder("dates");
    let path = folder.write("dates.xlsx", workbook(date, 0));
    let done = program(&["check", &path]);
    assert_eq!(done.status.code(), Some(3), "{}", stderr(&done));
    assert!(stderr(&done).contains("E317") && stderr(&done).contains("may be 3-4-5 or 4-3-5"), "{}", stderr(&done));
    let far = "<row r=\"1\"><c r=\"XFD1\"><v>1</v></c></row>";
    assert!(message(&workbook(far, 0)).contains("E312 t.xlsx row 1, column 16384"));
    let deep = "<row r=\"1048576\"><c r=\"A1048576\"><v>1</v></c></row>";
    assert!(message(&workbook(deep, 0)).contains("E312 t.xlsx row 1048576, column 1"));
    assert!(message(&workbook("", 0)).contains("E300 t.xlsx: no sheet of the workbook has cells"));
    assert!(message(&workbook(&sheet("x,1\n0,2\n"), 300 << 20)).contains("E312 t.xlsx: "));
    // The count of texts would be set aside in memory before one is read.
    let claim = "<sst xmlns=\"http://schemas.openxmlformats.org/spreadsheetml/2006/main\" uniqueCount = '99999999999999999999'/>";
    let lying = archive(&[("xl/SharedStrings.xml", claim.to_owned())], 0);
    assert!(message(&lying).contains("E312 t.xlsx: the workbook says that it has 18446744073709551615 shared texts"));
    let whole = workbook(&sheet("x,1,2\n0,2,3\n10,3,4\n"), 0);
    for cut in (0..whole.len()).step_by(7) {
        // Cut off anywhere it is refused, or whatever was read has no problem.
        let _ = read_table("t.xlsx", &whole[..cut]);
    }
}

#[test]
fn a_table_is_converted_and_the_rounding_reported() {
    let folder = folder("convert");
    let table = folder.join("boat.csv");
    let text = "x [m],0.500,1\n0,1.2344,2\n10,2,3\n";
    fs::write(&table, text).unwrap();
    let path = table.display().to_string();
    let own = convert(&[&path]);
    assert_eq!((own.status.code(), stdout(&own).as_str()), (Some(0), text));
    let said = stderr(&own);
    assert!(
        said.contains("rounding: 4 offsets, 4 as they were written; largest change 0.000 mm, RMS 0.000 mm"),
        "{said}"
    );
    let out = folder.join("mm.csv").display().to_string();
    let mm = convert(&[&path, &out, "--notation", "mm"]);
    assert_eq!(mm.status.code(), Some(0));
    assert_eq!(read_text(&out), "x\\z [mm],500,1000\n0,1234,2000\n10000,2000,3000\n");
    let said = stderr(&mm);
    assert!(said.contains("largest change 0.400 mm, RMS 0.200 mm"), "{said}");
    assert_eq!(convert(&[&path, &out]).status.code(), Some(6));
    let unknown = convert(&[&path, &folder.join("boat.foo").display().to_string()]);
    let said = stderr(&unknown);
    assert_eq!(unknown.status.code(), Some(2), "{said}");
    assert!(said.contains("known are .csv, .xlsx, .step") && !folder.join("boat.foo").exists(), "{said}");
    // Conventions beside the table.
    fs::write(folder.join("boat.toml"), "[table]\nbreadths = \"full\"\n").unwrap();
    let half = convert(&[&path, "--notation", "m", "--layout", "tidy", "-q"]);
    let expected = "station,x [m],curve,z,y,flag\n0,0,WL,0.5,0.61720,\n0,0,WL,1,1.00000,\n10,10,WL,0.5,1.00000,\n10,10,WL,1,1.50000,\n";
    assert_eq!(stdout(&half), expected);
    assert!(half.stderr.is_empty());
    fs::write(folder.join("boat.toml"), "[table]\nbreadth = \"full\"\n").unwrap();
    let wrong = convert(&[&path]);
    let said = stderr(&wrong);
    assert_eq!(wrong.status.code(), Some(3));
    assert!(said.contains("E311") && said.contains("boat.toml:2") && said.contains("Did you mean breadths?"), "{said}");
    fs::write(folder.join("bad.csv"), "x [m],0.5,1\n0,3-11-9,1\n10,1,2\n").unwrap();
    let bad = convert(&[&folder.join("bad.csv").display().to_string(), "--notation", Notation::Feet.as_str()]);
    let said = stderr(&bad);
    assert_eq!(bad.status.code(), Some(3));
    assert!(said.contains("bad.csv:2 column 2, '3-11-9': eighths are 0 to 7. Did you mean 3-11-0 or 4-0-1?"), "{said}");
    assert_eq!(convert(&[&path, "--layout", "round"]).status.code(), Some(2));
}

/// What a workbook says comes back from the workbook that is written of it: offsets, marks, texts, headers, comments.
#[test]
fn workbooks_are_written_back() {
    let matrix = "Offsets of a boat,,,\n# T = 0.8 m\nx [m],0.5,1,1.5\n0,,0.5,(1)\n10,1,2,2.5K\n20,,3-4-5,?\n";
    let first = read_table("t.xlsx", &workbook(&sheet(matrix), 0)).unwrap().table;
    assert_eq!(first.stated.draught, Some(0.8));
    assert_eq!(first.form.sheet.as_deref(), Some("Offsets"));
    let written = write_table(&first, TableWriting::default());
    let bytes = loftsman::internals::exchange::workbook(&written.text, &first.form).unwrap();
    let again = read_table("u.xlsx", &bytes).unwrap().table;
    assert_eq!(again, first);
    assert_eq!(loftsman::internals::exchange::workbook(&written.text, &again.form).unwrap(), bytes);
    // Every real table of the repository, and a sheet that stands for none.
    for name in ["wigley", "series60_cb060", "s175"] {
        let path = carried("tests/data").join(name).join("offsets.csv");
        let Ok(text) = std::fs::read(&path) else { panic!("no {}", path.display()) };
        let csv = read_table("offsets.csv", &text).unwrap().table;
        let written = write_table(&csv, TableWriting::default());
        let bytes = loftsman::internals::exchange::workbook(&written.text, &csv.form).unwrap();
        let back = read_table("offsets.xlsx", &bytes).unwrap().table;
        assert_eq!((&back.waterlines, &back.buttocks), (&csv.waterlines, &csv.buttocks), "{name}");
        for (a, b) in back.stations.iter().zip(&csv.stations) {
            let cells = |cells: &[Cell]| cells.iter().map(|c| (c.entry, c.marks)).collect::<Vec<_>>();
            assert_eq!((a.station.x, cells(&a.half_breadths)), (b.station.x, cells(&b.half_breadths)), "{name}");
        }
    }
    let mut form = first.form.clone();
    form.sheet = Some("a/b".to_owned());
    assert!(loftsman::internals::exchange::workbook(&written.text, &form).unwrap_err().contains("a/b"));
}

/// A workbook of a text of numbers and words, with a format for the cells from a row and a column on.
fn formatted(text: &str, formats: &[(u32, u16, &str)], hidden: Option<(u32, u16)>) -> Vec<u8> {
    let mut book = Workbook::new();
    let sheet = book.add_worksheet();
    for (row, line) in (0..).zip(text.lines()) {
        for (column, field) in (0..).zip(line.split(',')) {
            let code = formats.iter().find(|(r, c, _)| row >= *r && column >= *c).map_or("General", |(.., code)| *code);
            match field.parse::<f64>() {
                Ok(number) => sheet.write_number_with_format(row, column, number, &Format::new().set_num_format(code)),
                Err(_) => sheet.write_string(row, column, field),
            }
            .unwrap();
        }
    }
    if let Some((row, column)) = hidden {
        sheet.set_row_hidden(row).unwrap().set_column_hidden(column).unwrap();
    }
    book.save_to_buffer().unwrap()
}

#[test]
fn number_formats_state_the_units_of_cells() {
    let feet = "x [m],1,2,3\n0,0,0,0\n10,10,20,30\n20,0,0,0\n";
    let read =
        |formats: &[(u32, u16, &str)], text: &str| read_table("t.xlsx", &formatted(text, formats, None)).unwrap();
    for (code, unit) in [("0.00\" ft\"", 0.3048), ("0\\ \\m\\m", 1e-3), ("0.000\" m\"", 1.0), ("0.0\"'\"", 0.3048)] {
        let table = read(&[(1, 1, code)], feet).table;
        assert!((table.stations[1].half_breadth(2).unwrap() - 30.0 * unit).abs() < 1e-9, "{code}");
        assert!(
            (table.stations[2].station.x - 20.0).abs() < 1e-9 && (table.waterlines[2] - 3.0).abs() < 1e-9,
            "{code}"
        );
    }
    // A format of all cells leaves nothing to assume; words for lines are read as well.
    let all =
        read(&[(1, 1, "0.00\" m\""), (1, 0, "0.00\" ft\""), (0, 1, "\"WL \"0.00\" m\"")], &feet.replace("x [m]", "x"));
    assert!(!all.notes.iter().any(|note| note.message.contains("no unit is declared")), "{:?}", all.notes);
    assert!((all.table.stations[2].station.x - 6.096).abs() < 1e-9 && (all.table.waterlines[0] - 1.0).abs() < 1e-9);
    let frames = "Frame spacing 0.5 m,,,\n,1,2,3\n0,0,0,0\n10,1,2,3\n20,0,0,0\n";
    let frames = read(&[(2, 1, "General"), (2, 0, "\"Fr \"0")], frames).table;
    assert!((frames.stations[2].station.x - 10.0).abs() < 1e-9, "{}", frames.stations[2].station.x);
}

#[test]
fn hidden_rows_and_columns_are_left_out_with_a_warning() {
    let text = "x [m],1,1.5,2\n0,0,99,0\n5,99,99,99\n10,1,99,2\n20,0,99,0\n";
    let read = read_table("t.xlsx", &formatted(text, &[], Some((2, 2)))).unwrap();
    assert_eq!((read.table.stations.len(), read.table.waterlines.as_slice()), (3, [1.0, 2.0].as_slice()));
    assert_eq!(read.table.stations[1].half_breadth(1), Some(2.0));
    let said: Vec<String> = read.notes.iter().filter(|note| note.code == "W332").map(ToString::to_string).collect();
    for part in [
        "1 row with cells that the sheet hides, 3. Show them",
        "1 column with cells that the sheet hides, 3. Show them",
    ] {
        assert!(said.iter().any(|note| note.contains(part)), "{said:?}");
    }
}

/// The conventions beside a table go with its copy: all where it is written alike, the dimensions where it is not.
#[test]
fn conventions_go_with_a_converted_table() {
    let folder = folder("convert_conventions");
    let path = |name: &str| folder.join(name).display().to_string();
    fs::write(path("t.csv"), "station,1,2,3\n0,0,0,0\n5,1,2,3\n10,0,0,0\n").unwrap();
    let conventions = "[table]\nname = \"Anna\"\nLpp = 50\nunits = \"m\"\nstations = \"numbers from FP\"\n";
    fs::write(path("t.toml"), conventions).unwrap();
    let read = |name: &str| {
        let (text, beside) = (read_text(path(name)), read_text(path(&name.replace(".csv", ".toml"))));
        let table = read_table_with("t.csv", text.as_bytes(), [("t.toml", beside.as_str())]).unwrap().table;
        (table.stations.iter().map(|s| s.station.x).collect::<Vec<_>>(), table.stated, beside)
    };
    let plain = read("t.csv");
    assert_eq!(plain.0, [0.0, 25.0, 50.0]);
    for (name, options) in
        [("same.csv", [].as_slice()), ("mm.csv", &["--notation", "mm"]), ("tidy.csv", &["--layout", "tidy"])]
    {
        let (from, to) = (path("t.csv"), path(name));
        let arguments: Vec<&str> = [from.as_str(), to.as_str()].into_iter().chain(options.iter().copied()).collect();
        assert_eq!(convert(&arguments).status.code(), Some(0), "{name}");
        let copy = read(name);
        assert_eq!((&copy.0, copy.1), (&plain.0, plain.1), "{name}");
        assert_eq!(copy.2.contains("numbers from FP"), name == "same.csv", "{name}");
    }
    let said = stderr(&convert(&[&path("t.csv")]));
    assert!(said.contains("not written: the conventions of the table"), "{said}");
    // A title that states an origin does not go over lengths from AP.
    fs::write(path("u.csv"), "Stations from FP\nx [m],1,2\n0,0,0\n10,1,2\n50,2,2\n").unwrap();
    assert_eq!(convert(&[&path("u.csv"), &path("v.csv"), "--notation", "mm", "-q"]).status.code(), Some(0));
    assert!(!read_text(path("v.csv")).contains("from FP"), "{}", read_text(path("v.csv")));
}
