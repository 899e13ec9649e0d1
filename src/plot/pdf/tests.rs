//! The pages of a PDF as a viewer reads them: text by its character map, lines by their operators.

use super::write_pdf;
use crate::plot::pages::{Heading, Page};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font;
use crate::plot::paper::sheet::Sheet;
use crate::plot::paper::svg::Svg;
use std::collections::BTreeMap;
use std::io::Read;

const HEADING: Heading<'_> = Heading { ship: "Probe ∇", source: "probe.toml", date: None };

/// A drawing of 100 mm x 50 mm.
fn svg(body: &str) -> Svg {
    let family = font::FAMILY;
    Svg::new(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100mm\" height=\"50mm\" viewBox=\"0 0 100 50\" \
         font-family=\"'{family}'\">{body}</svg>"
    ))
}

fn pdf(body: &str) -> Result<Vec<u8>, PlotError> {
    let svg = svg(body);
    write_pdf(&HEADING, &[Page { title: "Probe", caption: "A probe.", svg: &svg }], Sheet::A3)
}

fn find(bytes: &[u8], key: &[u8]) -> Option<usize> {
    bytes.windows(key.len()).position(|window| window == key)
}

/// The streams of a document, unpacked.
fn streams(pdf: &[u8]) -> Vec<Vec<u8>> {
    let mut rest = pdf;
    let mut found = Vec::new();
    while let Some(start) = find(rest, b"\nstream\n") {
        rest = &rest[start + 8..];
        let mut stream = Vec::new();
        flate2::read::ZlibDecoder::new(rest).read_to_end(&mut stream).unwrap();
        rest = &rest[find(rest, b"endstream").unwrap()..];
        found.push(stream);
    }
    found
}

/// The only page, and what its codes stand for.
fn page_and_map(pdf: &[u8]) -> (String, BTreeMap<u16, String>) {
    let streams = streams(pdf);
    // Codes are bytes: one sign each.
    let page = streams[0].iter().map(|byte| char::from(*byte)).collect();
    let map = streams.iter().find(|stream| find(stream, b"begincmap").is_some()).unwrap();
    let map = std::str::from_utf8(map).unwrap();
    let pairs = map.lines().skip_while(|line| !line.contains("beginbfchar")).filter_map(|line| {
        let (code, text) = line.strip_prefix('<')?.strip_suffix('>')?.split_once("> <")?;
        let units: Vec<u16> =
            (0..text.len() / 4).map(|k| u16::from_str_radix(&text[4 * k..][..4], 16).unwrap()).collect();
        Some((u16::from_str_radix(code, 16).unwrap(), String::from_utf16(&units).unwrap()))
    });
    (page, pairs.collect())
}

/// The bytes of the strings of a content stream, in their order: one list for each operator that shows text.
fn shown(page: &str) -> Vec<Vec<u8>> {
    let (mut all, mut codes) = (Vec::new(), Vec::new());
    let mut signs = page.chars().peekable();
    while let Some(sign) = signs.next() {
        match sign {
            '(' => {
                let mut depth = 0;
                loop {
                    match signs.next().unwrap() {
                        ')' if depth == 0 => break,
                        '\\' => {
                            let escaped = signs.next().unwrap();
                            codes.push(match escaped {
                                'n' => b'\n',
                                'r' => b'\r',
                                't' => b'\t',
                                'b' => 8,
                                'f' => 12,
                                '0'..='7' => {
                                    let mut value = escaped.to_digit(8).unwrap();
                                    for _ in 0..2 {
                                        value = 8 * value + signs.next().unwrap().to_digit(8).unwrap();
                                    }
                                    u8::try_from(value).unwrap()
                                }
                                other => other as u8,
                            });
                        }
                        other => {
                            depth += i32::from(other == '(') - i32::from(other == ')');
                            codes.push(other as u8);
                        }
                    }
                }
            }
            '<' if signs.peek() != Some(&'<') => {
                let digits: Vec<u32> =
                    signs.by_ref().take_while(|c| *c != '>').filter_map(|c| c.to_digit(16)).collect();
                codes.extend(digits.chunks(2).map(|pair| (16 * pair[0] + pair[1]) as u8));
            }
            'T' if matches!(signs.peek(), Some('j' | 'J')) => all.push(std::mem::take(&mut codes)),
            _ => {}
        }
    }
    all
}

/// The text of a page, a string for each operator that shows some.
fn texts(pdf: &[u8]) -> Vec<String> {
    let (page, map) = page_and_map(pdf);
    let text =
        |codes: Vec<u8>| codes.chunks(2).map(|code| map[&u16::from_be_bytes([code[0], code[1]])].as_str()).collect();
    shown(&page).into_iter().map(text).collect()
}

const PROBE: &str = "<g transform=\"translate(10 20) scale(0.5)\"><g transform=\"rotate(90)\">\
    <path d=\"M0 0L10 0\" stroke=\"#ff0000\" stroke-width=\"0.4\" stroke-dasharray=\"3 1\" fill=\"none\"/></g></g>\
    <text x=\"50\" y=\"25\" font-size=\"3.5\" text-anchor=\"middle\">Δ 8 530 t (∇)</text>\
    <text x=\"20\" y=\"40\" font-size=\"3.5\" transform=\"rotate(-90 20 40)\">upward AVAT</text>\
    <text x=\"60\" y=\"40\" font-size=\"3.5\" fill=\"none\" stroke=\"#ffffff\" stroke-width=\"1\">halo</text>";

#[test]
fn every_letter_maps_back_to_its_text() {
    let texts = texts(&pdf(PROBE).unwrap());
    for text in ["Δ 8 530 t (∇)", "upward AVAT", "halo", "Probe ∇ – Probe", "A probe.", "100 mm on paper"] {
        assert!(texts.iter().any(|found| found == text), "{text}: {texts:?}");
    }
}

#[test]
fn a_glyph_that_stands_for_several_texts_says_which() {
    // The font has neither sign: one box stands for both.
    let pdf =
        pdf("<text x=\"5\" y=\"9\" font-size=\"3\">船</text><text x=\"5\" y=\"19\" font-size=\"3\">体</text>").unwrap();
    let (page, map) = page_and_map(&pdf);
    assert_eq!(map[&0], "船");
    assert_eq!(page.matches("/ActualText").count(), 1);
}

/// The operators of a page, a space between words.
fn operators(body: &str) -> String {
    page_and_map(&pdf(body).unwrap()).0.split_ascii_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn text_stands_where_the_pictures_have_it() {
    let page = operators(PROBE);
    // A quarter turn about the place of the text, which is upright in it.
    assert!(page.contains("q 0 -1 1 0 -20 60 cm BT 1 0 0 -1 20 40 Tm"), "{page}");
    assert!(page.contains("1 Tr 1 0 0 -1 60 40 Tm"), "{page}");
    let (before, _) = page.split_once(" 25 Tm").unwrap();
    let left: f64 = before.rsplit(' ').next().unwrap().parse().unwrap();
    let width = font::width("Δ 8 530 t (∇)") * 3.5;
    // Kerning takes a few hundredths of the size.
    assert!((left - (50.0 - 0.5 * width)).abs() < 0.2, "{left}");
}

#[test]
fn lines_keep_colour_width_dashes_and_nesting() {
    let page = operators(PROBE);
    let line = "q 0.5 0 0 0.5 10 20 cm q 0 1 -1 0 0 0 cm 1 0 0 RG 0.4 w 4 M[3 1]0 d 0 0 m 10 0 l S Q Q";
    assert!(page.contains(line), "{page}");
    let count = |word: &str| page.split(' ').filter(|found| *found == word).count();
    assert_eq!(count("q"), count("Q"));
}

#[test]
fn curves_of_the_second_degree_are_the_same_of_the_third() {
    let page = operators("<path d=\"M0 0Q3 6 6 0z\" fill=\"#000000\"/>");
    assert!(page.contains("0 0 m 2 4 4 4 6 0 c h f"), "{page}");
}

#[test]
fn the_same_figures_give_the_same_bytes_without_dates() {
    let bytes = pdf(PROBE).unwrap();
    assert_eq!(bytes, pdf(PROBE).unwrap());
    let plain = String::from_utf8_lossy(&bytes);
    assert!(!plain.contains("Date") && !plain.contains("/ID"));
    assert!(plain.contains("/Lang(en)") && plain.contains("/Creator(loftsman "));
    // The font is there once.
    assert_eq!(plain.matches("/FontFile2").count(), 1);
}

#[test]
fn what_is_never_drawn_is_an_error() {
    let square = "<rect width=\"9\" height=\"9\" fill=\"#ff0000\"";
    let gradient =
        "<linearGradient id=\"g\"><stop offset=\"0\" stop-color=\"red\"/><stop offset=\"1\"/></linearGradient>";
    let clip = "<clipPath id=\"c\"><path d=\"M0 0h5v5z\"/></clipPath>";
    for (body, word) in [
        (format!("{square} fill-opacity=\"0.5\"/>"), "seen through"),
        (format!("<g opacity=\"0.5\">{square}/></g>"), "seen through"),
        (format!("{gradient}<rect width=\"9\" height=\"9\" fill=\"url(#g)\"/>"), "gradient"),
        (format!("{clip}<g clip-path=\"url(#c)\">{square}/></g>"), "clip path"),
        (format!("{square} stroke=\"#000000\" paint-order=\"stroke\"/>"), "edge"),
        (
            "<image width=\"9\" height=\"9\" href=\"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNgAAAAAgABc3UBGAAAAABJRU5ErkJggg==\"/>".to_owned(),
            "picture",
        ),
    ] {
        match pdf(&body) {
            Err(PlotError::Pdf(message)) => assert!(message.contains(word), "{message}"),
            other => panic!("{word}: {:?}", other.map(|bytes| bytes.len())),
        }
    }
}
