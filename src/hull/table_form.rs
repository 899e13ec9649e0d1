//! How a table of offsets was written: its layout, orders, units and header texts, so that it can be written back the
//! same way.

use super::cell::Written;
use crate::units::{CellRules, Notation};

/// In which shape offsets stand in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TableLayout {
    /// Stations over waterlines, the half-breadth where they cross.
    #[default]
    Matrix,
    /// One offset a row: `station,x,curve,z,y,flag`.
    Tidy,
    /// One column a station, cells are pairs `y,z`.
    Pairs,
    /// A text format of another program.
    Other,
}

/// A program whose text format is read and written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Program {
    /// GHS geometry.
    Ghs,
    /// BRITFAIR offsets.
    Britfair,
    /// PIAS hull text.
    Pias,
    /// PDSTRIP geometry.
    Pdstrip,
    /// FREE!ship, a round hull as points of sections.
    Freeship,
}

/// What the rows of a matrix are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Rows {
    /// One row a station.
    #[default]
    Stations,
    /// One row a waterline.
    Waterlines,
}

/// In which order lines stand in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Order {
    /// From aft forward, from the keel up.
    #[default]
    Rising,
    /// From forward aft, from the deck down.
    Falling,
}

/// From where the positions of stations are written.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum StationDatum {
    /// x is what is written, in the unit of positions.
    #[default]
    Lengths,
    /// x = offset + sign times what is written \[m\]: distances from midship or from FP.
    Shifted {
        /// x where 0 is written \[m\].
        offset: f64,
        /// 1 when what is written rises forward, -1 when it rises aft.
        sign: f64,
    },
    /// x = offset + spacing times the number of the station \[m\]; a negative spacing counts from FP.
    Numbers {
        /// x of station 0 \[m\].
        offset: f64,
        /// From one station number to the next \[m\].
        spacing: f64,
    },
}

/// A text of the file with the value that was read from it; it is written again while the value is the same.
#[derive(Debug, Clone, PartialEq)]
pub struct Kept {
    /// As written.
    pub text: String,
    /// What it was understood to be \[m\].
    pub value: f64,
}

impl Kept {
    /// The text, when `value` is still what it says (to 1e-12 of itself or 1e-12 m).
    #[must_use]
    pub fn text_of(&self, value: f64) -> Option<&str> {
        ((self.value - value).abs() <= 1e-12 * value.abs().max(1.0)).then_some(self.text.as_str())
    }
}

/// What stands beside the half-breadths of each station, or of each waterline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SideKind {
    /// Name of the station.
    Name,
    /// Height of the lowest point of the section.
    Keel,
    /// Half-breadth of the flat of bottom.
    FlatOfBottom,
    /// Height at which the flat of side begins.
    FlatOfSide,
    /// Height of the deck at side or of the upper edge of the section.
    DeckHeight,
    /// Half-breadth at the deck at side.
    DeckHalfBreadth,
    /// Height of the deck on the centreline.
    DeckCentreHeight,
    /// x of the stern profile at each waterline.
    Stern,
    /// x of the stem profile at each waterline.
    Stem,
}

/// A side column (of stations) or side row (of waterlines) as it was written.
#[derive(Debug, Clone, PartialEq)]
pub struct SideLine {
    /// What it holds.
    pub kind: SideKind,
    /// Its header.
    pub head: String,
    /// Whether it stands before the offsets.
    pub before: bool,
    /// Its texts, along the stations or the waterlines in the order of the table; empty ones where there is none.
    pub texts: Vec<Option<Kept>>,
}

/// A line of a boat, its half-breadths and heights as they were written: the rows `chine` of a table of lines.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenLine {
    /// Its name.
    pub name: String,
    /// Its points, one a station, from aft forward.
    pub points: Vec<WrittenPoint>,
}

/// A point of a line of a boat.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenPoint {
    /// Index of its station in the table.
    pub station: usize,
    /// Half-breadth and height \[m\].
    pub given: [f64; 2],
    /// Their cells; none where no cell gives the number.
    pub cells: [Option<Written>; 2],
}

/// How a table was written, so that it can be written back the same way.
#[derive(Debug, Clone, PartialEq)]
pub struct TableForm {
    /// Notation of the offsets.
    pub notation: Notation,
    /// Digits after the decimal sign at most; none for notations without, and for computed tables.
    pub decimals: Option<usize>,
    /// Shape of the file.
    pub layout: TableLayout,
    /// The program of the layout [`TableLayout::Other`], where its format can be written.
    pub program: Option<Program>,
    /// Name of the sheet when the file is a workbook.
    pub sheet: Option<String>,
    /// What the rows of a matrix are.
    pub rows: Rows,
    /// Order of the stations in the file.
    pub station_order: Order,
    /// Order of the waterlines in the file.
    pub waterline_order: Order,
    /// Between fields.
    pub separator: char,
    /// `6,41` is 6.41.
    pub decimal_comma: bool,
    /// Lines end with carriage return and line feed.
    pub carriage_returns: bool,
    /// The last line has no end.
    pub open_end: bool,
    /// An empty field at the end of every row.
    pub trailing_separator: bool,
    /// Full breadths stand where half-breadths are meant.
    pub full_breadths: bool,
    /// Half-breadths are written as negative numbers.
    pub negative: bool,
    /// Unit of the positions of stations.
    pub x_notation: Notation,
    /// Unit of heights.
    pub z_notation: Notation,
    /// From where the positions of stations are written.
    pub origin: StationDatum,
    /// Lines before the table: titles and comments, as they stand.
    pub preamble: Vec<String>,
    /// The field where the headers cross; none when it is to be made.
    pub corner: Option<String>,
    /// Headers of the stations in the order of the table; empty when they are to be made.
    pub station_heads: Vec<Kept>,
    /// Headers of the waterlines in the order of the table.
    pub waterline_heads: Vec<Kept>,
    /// Columns beside the half-breadths of the stations.
    pub side_columns: Vec<SideLine>,
    /// Rows across the stations: endings.
    pub side_rows: Vec<SideLine>,
    /// The field where the headers of the heights at buttocks cross.
    pub buttock_corner: Option<String>,
    /// Headers of the buttocks in the order of the table.
    pub buttock_heads: Vec<Kept>,
    /// Side columns of the heights at buttocks.
    pub buttock_columns: Vec<SideLine>,
    /// Lines of a boat, whose points are in the sections.
    pub boat_lines: Vec<WrittenLine>,
}

impl Default for TableForm {
    /// Metres in full, a matrix of stations in rows.
    fn default() -> Self {
        Self {
            notation: Notation::Metres,
            decimals: None,
            layout: TableLayout::Matrix,
            program: None,
            sheet: None,
            rows: Rows::Stations,
            station_order: Order::Rising,
            waterline_order: Order::Rising,
            separator: ',',
            decimal_comma: false,
            carriage_returns: false,
            open_end: false,
            trailing_separator: false,
            full_breadths: false,
            negative: false,
            x_notation: Notation::Metres,
            z_notation: Notation::Metres,
            origin: StationDatum::Lengths,
            preamble: Vec::new(),
            corner: None,
            station_heads: Vec::new(),
            waterline_heads: Vec::new(),
            side_columns: Vec::new(),
            side_rows: Vec::new(),
            buttock_corner: None,
            buttock_heads: Vec::new(),
            buttock_columns: Vec::new(),
            boat_lines: Vec::new(),
        }
    }
}

impl TableForm {
    /// The step between two offsets that can be told apart in this writing \[m\]; none when there is none (computed
    /// tables).
    #[must_use]
    pub fn quantum(&self) -> Option<f64> {
        let step = self.notation.quantum(self.decimals)?;
        Some(if self.full_breadths { 0.5 * step } else { step })
    }

    /// How cells of this table are to be understood.
    #[must_use]
    pub fn cell_rules(&self) -> CellRules {
        CellRules { unit: self.notation, decimal_comma: self.decimal_comma }
    }
}
