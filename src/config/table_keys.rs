//! The keys of the TOML file beside a table of offsets or a body.

use super::keys::{Key, Kind, key};

const UNITS: &[&str] = &["m", "mm", "cm", "ft", "in", "feet-inches-eighths"];

const fn table(name: &'static str, kind: Kind, description: &'static str) -> Key {
    key("table", name, kind, &[], description)
}

/// Keys of `[table]` and `[dimensions]`: what a table of offsets, or a body, does not say of itself.
pub const TABLE_KEYS: &[Key] = &[
    table("name", Kind::Text, "Name of the hull. Default: the title of the table, else the name of the file."),
    table(
        "units",
        Kind::Word(UNITS),
        "Unit of plain numbers. Default: what headers say, else by the size of the numbers.",
    ),
    table("x_units", Kind::Word(UNITS), "Unit of the positions of stations, where it is another."),
    table("z_units", Kind::Word(UNITS), "Unit of heights, where it is another."),
    table("breadths", Kind::Word(&["half", "full"]), "Whether breadths are half or full ones. Default: half."),
    table(
        "rows",
        Kind::Word(&["stations", "waterlines"]),
        "What the rows of a matrix are. Default: by the words of its headers, else by its numbers.",
    ),
    table(
        "layout",
        Kind::Word(&["matrix", "tidy", "pairs"]),
        "Layout: a matrix, one offset a row, or pairs of half-breadth and height. Default: by the headers.",
    ),
    table(
        "stations",
        Kind::Word(&["from AP", "from midship", "from FP", "numbers from AP", "numbers from FP"]),
        "Where positions of stations count from, and whether they are numbers. Distances from FP count aft.",
    ),
    table("station_spacing", Kind::Length, "Distance from one number of stations to the next."),
    table("waterline_spacing", Kind::Length, "Distance from one number of waterlines to the next."),
    table("buttock_spacing", Kind::Length, "Distance from one number of buttocks to the next."),
    table("spaces", Kind::Number, "Numbers of stations in L_PP. Default: 20 or 10, where the numbers end there."),
    table("Lpp", Kind::Length, "Length between perpendiculars."),
    table("B", Kind::Length, "Moulded breadth."),
    table("T", Kind::Length, "Design draught above the base line."),
    table("D", Kind::Length, "Depth to the deck at side."),
    table(
        "separator",
        Kind::Word(&[",", ";", "|", "tab", "blank"]),
        "What stands between fields. Default: by the text.",
    ),
    table("decimal", Kind::Word(&[".", ","]), "Decimal sign. Default: by the numbers."),
    table("sheet", Kind::Text, "Sheet of a workbook. Default: the visible one that holds a table."),
    table("comment", Kind::Text, "A remark, which is not read."),
    table("axes", Kind::Text, "Axes of the file of a body that point forward, to port and up, as `x -z y`."),
    table("up", Kind::Word(&["x", "y", "z", "-x", "-y", "-z"]), "Axis of the file of a body that points up."),
    table("body", Kind::Word(&["half", "whole"]), "Whether the file of a body has one side or both."),
    table(
        "parts",
        Kind::Text,
        "Parts of a body that count, as `hull,deck` or `1,3`: groups or layers by name, shells by number.",
    ),
    table("scale", Kind::Number, "Factor of the lengths of a body."),
    table("x_origin", Kind::Length, "Distance of the origin of a body from AP, + forward."),
    table("z_origin", Kind::Length, "Height of the origin of a body above the base line."),
    table("sections", Kind::Integer(4, 400), "Spaces between the sections that a body is cut into. Default: 40."),
    key("dimensions", "Lpp", Kind::Length, &[], "Length between perpendiculars."),
    key("dimensions", "B", Kind::Length, &[], "Moulded breadth."),
    key("dimensions", "T", Kind::Length, &[], "Design draught above the base line."),
    key("dimensions", "D", Kind::Length, &[], "Depth to the deck at side."),
];
