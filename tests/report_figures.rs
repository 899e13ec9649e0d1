//! The figures of a report: sizes, letters, and how they look.

use std::collections::BTreeMap;
use std::fs;

use loftsman::internals::plot::Sheet;
use loftsman::internals::report::{ReportSettings, generate_outputs, read_design, read_result, report_outputs};
use resvg::tiny_skia::Pixmap;

use crate::report::{FAIRED, HULL, SETTINGS, faired, generated, text};
use crate::support::{carried, read_text};

#[test]
fn the_pdf_has_the_figures_at_true_size() {
    let (_, files) = faired();
    let pdf = &files.iter().find(|file| file.name == "report.pdf").unwrap().contents;
    assert!(pdf.starts_with(b"%PDF-"));
    let plain = String::from_utf8_lossy(pdf);
    let boxes: Vec<&str> = plain.split("/MediaBox").skip(1).map(|rest| rest[..40.min(rest.len())].trim()).collect();
    // What the fairing came to and what is held stand on one sheet.
    assert_eq!(boxes.len(), HULL.len() + FAIRED.len() - 1);
    // 420 mm x 297 mm in points.
    for found in boxes {
        assert!(found.contains("1190.55") && found.contains("841.88"), "{found}");
    }
}

#[test]
fn on_a1_drawings_are_larger_and_charts_stand_four_to_a_sheet() {
    let path = generated("sheets");
    let result = read_result(&path).unwrap();
    let files = report_outputs(&result, &ReportSettings { sheet: Sheet::A1, ..SETTINGS }).unwrap();
    let pdf = &files.iter().find(|file| file.name == "report.pdf").unwrap().contents;
    let plain = String::from_utf8_lossy(pdf);
    let boxes: Vec<&str> = plain.split("/MediaBox").skip(1).map(|rest| rest[..40.min(rest.len())].trim()).collect();
    // Lines plan and body plan alone, the other eleven on three sheets; 841 mm x 594 mm in points.
    assert_eq!(boxes.len(), 5);
    assert!(boxes.iter().all(|found| found.contains("2383.9") && found.contains("1683.7")), "{boxes:?}");
    // The pictures beside the document stay as they are.
    let small = report_outputs(&result, &SETTINGS).unwrap();
    assert_eq!(text(&files, "sections.svg"), text(&small, "sections.svg"));
}

/// Sizes of the letters of a figure \[mm\], their attribute times the scale of the groups around them, and its width.
fn letters(svg: &str) -> (Vec<f64>, f64) {
    let number = |text: &str, key: &str| -> Option<f64> {
        let rest = &text[text.find(key)? + key.len()..];
        rest[..rest.find(['"', ')', ' '])?].trim_end_matches("mm").parse().ok()
    };
    let width = number(svg, " width=\"").unwrap();
    let (mut scales, mut sizes) = (vec![1.0], Vec::new());
    for element in svg.split('<').skip(1) {
        let scale = *scales.last().unwrap();
        if element.starts_with("g ") || element.starts_with("g>") {
            scales.push(scale * number(element, "scale(").unwrap_or(1.0));
        } else if element.starts_with("/g>") {
            scales.pop();
        } else if element.starts_with("text ") || element.starts_with("tspan ") {
            sizes.extend(number(element, "font-size=\"").map(|size| size * scale));
        }
    }
    (sizes, width)
}

#[test]
fn letters_are_nine_pixels_high_where_a_figure_is_1200_wide() {
    for file in faired().1.iter().filter(|file| file.name.ends_with(".svg")) {
        let (sizes, width) = letters(std::str::from_utf8(&file.contents).unwrap());
        let least = sizes.iter().map(|size| size * 1200.0 / width).fold(f64::INFINITY, f64::min);
        assert!(!sizes.is_empty() && least >= 8.95, "{}: {least:.2} pixels", file.name);
    }
}

#[test]
fn capitals_are_at_least_1_8_mm_high_on_paper() {
    /// Height of capitals in sizes of DejaVu Sans.
    const CAPITALS: f64 = 0.729;
    let check = |name: &str, svg: &str| {
        let least = letters(svg).0.into_iter().fold(f64::INFINITY, f64::min);
        assert!(CAPITALS * least >= 1.8, "{name}: {:.2} mm", CAPITALS * least);
    };
    for file in faired().1.iter().filter(|file| file.name.ends_with(".svg")) {
        check(&file.name, std::str::from_utf8(&file.contents).unwrap());
    }
    // Hulls of all proportions: their body plans are sheets of all sizes.
    for entry in fs::read_dir(carried("configs")).unwrap().map(|entry| entry.unwrap().path()) {
        let Some(name) = entry.file_name().filter(|name| name.to_string_lossy().ends_with(".toml")) else { continue };
        let (design, bytes) = read_design(&entry).unwrap();
        let outputs = generate_outputs(&design, (&entry, &bytes), &[]).unwrap();
        for file in outputs.files.iter().filter(|file| file.name.ends_with(".svg")) {
            check(&format!("{} of {}", file.name, name.display()), std::str::from_utf8(&file.contents).unwrap());
        }
    }
}

/// Elements by kind and the words of a figure; numbers only where `numbers`.
fn structure(svg: &str, numbers: bool) -> String {
    let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
    let mut words = Vec::new();
    for element in svg.split('<').skip(1).filter(|element| !element.starts_with(['/', '?'])) {
        let kind = element.split([' ', '>', '/']).next().unwrap_or_default();
        let content = element.split_once('>').map_or("", |(_, content)| content.trim());
        if matches!(kind, "text" | "tspan" | "title") && !content.is_empty() && !element.contains("aria-hidden") {
            let digit = content.chars().any(|c| c.is_ascii_digit());
            if numbers || !digit {
                words.push(content);
            }
        }
        // Polygons of maps and clipped cells are as many as rounding gives.
        if !matches!(kind, "path" | "polyline") {
            *kinds.entry(kind).or_default() += usize::from(numbers);
        }
    }
    words.sort_unstable();
    words.dedup();
    let kinds: Vec<String> = kinds.iter().map(|(kind, count)| format!("{kind} {count}")).collect();
    format!("{}\n{}\n", kinds.join(", "), words.join(" | "))
}

/// Mean brightness of blocks of 6 x 6 pixels, and how many of them there are in a row.
fn blocks(png: &[u8]) -> (usize, Vec<f64>) {
    let map = Pixmap::decode_png(png).unwrap();
    let (columns, rows) = (map.width() as usize / 6, map.height() as usize / 6);
    let at = |x: usize, y: usize| {
        let pixel = map.pixels()[y * map.width() as usize + x];
        f64::from(pixel.red()) + f64::from(pixel.green()) + f64::from(pixel.blue())
    };
    let mean = |column: usize, row: usize| {
        (0..36).map(|k| at(6 * column + k % 6, 6 * row + k / 6)).sum::<f64>() / (3.0 * 36.0)
    };
    (
        columns,
        (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row))).map(|(c, r)| mean(c, r)).collect(),
    )
}

/// Kept figures are written anew with LOFTSMAN_GOLDEN=1.
#[test]
fn figures_look_as_the_kept_ones() {
    let golden = carried("tests/golden/report");
    let write = std::env::var_os("LOFTSMAN_GOLDEN").is_some();
    let path = generated("golden");
    let files = report_outputs(&read_result(&path).unwrap(), &SETTINGS).unwrap();
    let mut told = String::new();
    for key in HULL {
        told += &format!("[{key}]\n{}", structure(&text(&files, &format!("{key}.svg")), true));
    }
    for key in FAIRED {
        told += &format!("[{key}]\n{}", structure(&text(&faired().1, &format!("{key}.svg")), false));
    }
    if write {
        fs::create_dir_all(&golden).unwrap();
        fs::write(golden.join("structure.txt"), &told).unwrap();
    }
    let kept = read_text(golden.join("structure.txt"));
    for (a, b) in told.lines().zip(kept.lines()) {
        assert_eq!(a, b);
    }
    assert_eq!(told.lines().count(), kept.lines().count());
    let of_hull = ["bonjean", "gaussian-map", "lines", "zebra-map"].map(|key| (key, &files));
    for (key, files) in of_hull.into_iter().chain([("fairing-body-plan", &faired().1)]) {
        let name = format!("{key}.png");
        let picture = &files.iter().find(|file| file.name == name).unwrap().contents;
        if write {
            fs::write(golden.join(&name), picture).unwrap();
        }
        let ((columns, now), (others, kept)) = (blocks(picture), blocks(&fs::read(golden.join(&name)).unwrap()));
        assert_eq!((columns, now.len()), (others, kept.len()), "{key}");
        let largest = now.iter().zip(&kept).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(largest < 12.0, "{key}: a block differs by {largest} of 255");
    }
}
