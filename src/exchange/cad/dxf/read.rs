//! Reading of DXF, R12 to 2018, text and binary: the faces of a drawing by their layers, or the curves of one without
//! faces, with those of the blocks that it inserts.
//!
//! Not read are ACIS data (solids, regions, surfaces), paper space, texts and dimensions, and what lies on layers that are
//! off or frozen. Cost: linear in the file and in what its inserts draw, of which there are at most [`MOST_INSERTS`].

use std::collections::{BTreeMap, HashMap};

use super::super::super::fault::{Faults, RecordFault};
use super::super::surfaces::{CadCurve, MOST_POINTS};
use super::curves::{arc, ellipse, light_polyline, line, spline, upright};
use super::expand::{Expanded, Insert, expand};
use super::faces::{Drawn, Polyline, face, mesh};
use super::groups::{Record, Records};
use super::unit;
use crate::hull::TriangleMesh;
use crate::units::counted;

/// Entities that draw no hull, and need no mention.
const SILENT: [&str; 25] = [
    "ACAD_TABLE",
    "ATTDEF",
    "ATTRIB",
    "DIMENSION",
    "HATCH",
    "IMAGE",
    "LEADER",
    "LIGHT",
    "MLEADER",
    "MTEXT",
    "MULTILEADER",
    "OLE2FRAME",
    "OLEFRAME",
    "POINT",
    "RAY",
    "SECTION",
    "SEQEND",
    "SHAPE",
    "SUN",
    "TEXT",
    "TOLERANCE",
    "VERTEX",
    "VIEWPORT",
    "WIPEOUT",
    "XLINE",
];

/// Entities whose form stands in data of ACIS.
const ACIS: [&str; 10] = [
    "3DSOLID",
    "BODY",
    "EXTRUDEDSURFACE",
    "LOFTEDSURFACE",
    "NURBSURFACE",
    "PLANESURFACE",
    "REGION",
    "REVOLVEDSURFACE",
    "SURFACE",
    "SWEPTSURFACE",
];

/// Flags of blocks that are references to other files, and overlays of them.
const EXTERNAL: i64 = 4 | 8;

/// Layers of a file at most.
const MOST_LAYERS: usize = 100_000;

/// What a drawing has of a hull.
#[derive(Debug, Default)]
pub(in super::super::super) struct Drawing {
    /// Faces by their layers, in the unit of the file.
    pub(in super::super::super) parts: Vec<(String, TriangleMesh)>,
    /// Curves, of a file without faces.
    pub(in super::super::super) curves: Vec<CadCurve>,
    /// Surfaces and solids that are not read, beside faces or curves: layer, kind and how many.
    pub(in super::super::super) surfaces: Vec<(String, String, usize)>,
    /// Metres in the unit of the file, where it is stated.
    pub(in super::super::super) unit: Option<f64>,
    /// What of the file is not used, in words.
    pub(in super::super::super) notes: Vec<String>,
}

/// A layer.
#[derive(Debug, Default)]
pub(super) struct Layer {
    pub(super) name: String,
    /// Off or frozen.
    pub(super) hidden: bool,
    /// Frozen, with the blocks inserted on it.
    pub(super) frozen: bool,
}

/// The layers of a file by the numbers of their names.
#[derive(Debug, Default)]
pub(super) struct Layers {
    pub(super) list: Vec<Layer>,
    numbers: HashMap<String, usize>,
}

impl Layers {
    fn number(&mut self, name: &str) -> usize {
        let key = name.to_ascii_uppercase();
        if let Some(&number) = self.numbers.get(&key) {
            return number;
        }
        if self.list.len() >= MOST_LAYERS {
            return 0;
        }
        self.list.push(Layer { name: name.to_owned(), ..Layer::default() });
        self.numbers.insert(key, self.list.len() - 1);
        self.list.len() - 1
    }
}

/// What a block, or the model, draws.
#[derive(Debug, Default)]
pub(super) struct Block {
    pub(super) base: [f64; 3],
    /// With the number of the layer and the line.
    pub(super) drawn: Vec<(usize, usize, Drawn)>,
    pub(super) inserts: Vec<Insert>,
    /// Entities that are not read, by their layers and kinds.
    pub(super) unread: BTreeMap<(usize, String), usize>,
    /// Meshes that are read without their subdivision.
    pub(super) subdivided: usize,
    /// A reference to another file.
    external: bool,
}

impl Block {
    /// Whether its entities are in another file.
    pub(super) fn is_elsewhere(&self) -> bool {
        self.external && self.drawn.is_empty() && self.inserts.is_empty() && self.unread.is_empty()
    }
}

/// The state of reading.
struct Reader {
    layers: Layers,
    blocks: HashMap<String, Block>,
    model: Block,
    /// The name of the block that is being read.
    block: Option<String>,
    section: String,
    /// A polyline whose vertices follow: its layer, its line.
    open: Option<(usize, usize, Polyline)>,
    unit: Option<f64>,
    /// Points and corners so far, and points of curves.
    points: usize,
    curve_points: usize,
    ended: bool,
}

/// Reads a DXF file.
///
/// # Errors
/// Every fault of the file, up to a number of them.
pub(in super::super::super) fn read_dxf(bytes: &[u8]) -> Result<Drawing, Vec<RecordFault>> {
    let mut faults = Faults::default();
    if bytes.starts_with(b"AC10") {
        faults.add(None, "", "this is a DWG file: save it as DXF".to_owned());
        return Err(faults.list);
    }
    let mut records = Records::of(bytes);
    let comments = records.comments(&mut faults);
    let mut reader = Reader {
        layers: Layers::default(),
        blocks: HashMap::new(),
        model: Block::default(),
        block: None,
        section: String::new(),
        open: None,
        unit: comments.iter().find_map(|comment| unit::of_comment(comment)),
        points: 0,
        curve_points: 0,
        ended: false,
    };
    reader.layers.number("0");
    let mut record = Record::default();
    while !reader.ended && !faults.is_full() && records.read(&mut record, &mut faults) {
        reader.take(&record, &mut faults);
    }
    if faults.list.is_empty() && !reader.ended && !reader.section.is_empty() {
        let message = format!("the file ends within the section {}, expected ENDSEC and EOF", reader.section);
        faults.add(None, "", message);
    }
    if !faults.list.is_empty() {
        return Err(faults.list);
    }
    let Reader { layers, blocks, model, unit, .. } = reader;
    let found = expand(&model, &blocks, &layers, &mut faults);
    drawing(found, &layers, unit, faults)
}

/// The faces, or the curves, of what the model draws.
fn drawing(
    found: Expanded,
    layers: &Layers,
    unit: Option<f64>,
    mut faults: Faults,
) -> Result<Drawing, Vec<RecordFault>> {
    let Expanded { faces, curves, unread, hidden, subdivided, missing, .. } = found;
    let is_acis = |kind: &str| ACIS.contains(&kind);
    let list = |of: &dyn Fn(&str) -> bool| {
        let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
        let counted = unread.iter().filter(|((_, kind), _)| of(kind));
        counted.for_each(|((_, kind), count)| *kinds.entry(kind).or_default() += count);
        let kinds: Vec<String> = kinds.into_iter().map(|(kind, count)| format!("{count} of {kind}")).collect();
        kinds.join(", ")
    };
    let acis = list(&is_acis);
    if faults.list.is_empty() && faces.is_empty() && curves.is_empty() {
        let message = if acis.is_empty() {
            let kinds = list(&|_| true);
            let there = if kinds.is_empty() { String::new() } else { format!("; there are {kinds}") };
            let off =
                if hidden > 0 { format!("; {hidden} lie on layers that are off or frozen") } else { String::new() };
            format!("no faces and no curves{there}{off}")
        } else {
            format!("its surfaces are data of ACIS, which are not read ({acis}): export STEP, IGES or a mesh")
        };
        faults.add(None, "", message);
    }
    let mut notes = Vec::new();
    if !(faces.is_empty() || curves.is_empty()) {
        notes.push(format!("{} beside the faces: not read", counted(curves.len(), "curve")));
    }
    for (count, rest) in [
        (hidden, "entities on layers that are off or frozen: not read"),
        (subdivided, "of MESH with smooth subdivision: their base faces are read, which lie off the smooth ones"),
        (missing, "of INSERT name blocks that the file does not hold, or references to other files: not read"),
    ] {
        if count > 0 {
            notes.push(format!("{count} {rest}"));
        }
    }
    let kinds = list(&|kind| !is_acis(kind));
    if !kinds.is_empty() {
        notes.push(format!("entities that are not read: {kinds}"));
    }
    let mut parts: BTreeMap<usize, Vec<_>> = BTreeMap::new();
    let is_mesh = !faces.is_empty();
    faces.into_iter().for_each(|(layer, corners)| parts.entry(layer).or_default().push(corners));
    let name = |layer: usize| layers.list[layer].name.clone();
    let surfaces = unread.iter().filter(|((_, kind), _)| is_acis(kind));
    let surfaces = surfaces.map(|((layer, kind), &count)| (name(*layer), kind.clone(), count)).collect();
    let curve = |(layer, line, points): (usize, usize, Vec<[f64; 3]>)| CadCurve { line, points, layer: name(layer) };
    faults.or(|| Drawing {
        parts: parts
            .into_iter()
            .map(|(layer, list)| (name(layer), TriangleMesh::from_corners(list.into_iter())))
            .collect(),
        curves: if is_mesh { Vec::new() } else { curves.into_iter().map(curve).collect() },
        surfaces,
        unit,
        notes,
    })
}

impl Reader {
    /// Takes a record into what is read.
    fn take(&mut self, record: &Record<'_>, faults: &mut Faults) {
        let kind = record.kind();
        if let Some((layer, line, mut polyline)) = self.open.take() {
            if kind == "VERTEX" {
                polyline.add(record, faults);
                self.count(1, record, faults);
                if polyline.is_too_long() {
                    self.too_many(record, MOST_POINTS, faults);
                }
                self.open = Some((layer, line, polyline));
                return;
            }
            let drawn = polyline.finish(faults);
            self.put(layer, line, drawn, record, faults);
        }
        match (kind.as_ref(), self.section.as_str()) {
            ("EOF", _) => self.ended = true,
            ("SECTION", "") => {
                record.text(2).as_ref().clone_into(&mut self.section);
                if self.section == "HEADER" {
                    self.header(record, faults);
                }
            }
            ("ENDSEC", _) => {
                self.section.clear();
                self.block = None;
            }
            ("LAYER", "TABLES") => {
                let number = self.layers.number(&record.text(2));
                let frozen = record.whole(70, faults) & 1 == 1;
                let layer = &mut self.layers.list[number];
                layer.frozen |= frozen;
                layer.hidden |= frozen || record.whole(62, faults) < 0;
            }
            ("BLOCK", "BLOCKS") => {
                let name = record.text(2).to_ascii_uppercase();
                let base = record.point(10, faults).unwrap_or_default();
                let external = record.whole(70, faults) & EXTERNAL != 0;
                self.blocks.insert(name.clone(), Block { base, external, ..Block::default() });
                self.block = Some(name);
            }
            ("ENDBLK", _) => self.block = None,
            (_, "ENTITIES") => self.entity(&kind, record, faults),
            (_, "BLOCKS") if self.block.is_some() => self.entity(&kind, record, faults),
            (_, "") => {
                let message = "expected SECTION or EOF".to_owned();
                faults.add(record.line(), &kind, message);
                self.ended = true;
            }
            _ => {}
        }
    }

    fn header(&mut self, record: &Record<'_>, faults: &mut Faults) {
        for pair in record.groups.windows(2).filter(|pair| pair[0].code == 9 && pair[0].text() == "$INSUNITS") {
            self.unit = unit::of_code(pair[1].whole(faults)).or(self.unit);
        }
    }

    /// What is being read: a block or the model.
    fn target(&mut self) -> &mut Block {
        match self.block.as_ref().and_then(|name| self.blocks.get_mut(name)) {
            Some(block) => block,
            None => &mut self.model,
        }
    }

    /// Counts points; a file of too many is at fault.
    fn count(&mut self, points: usize, record: &Record<'_>, faults: &mut Faults) {
        self.points += points;
        if self.points > 20 * MOST_POINTS {
            self.too_many(record, 20 * MOST_POINTS, faults);
        }
    }

    fn too_many(&mut self, record: &Record<'_>, most: usize, faults: &mut Faults) {
        faults.add(record.line(), &record.kind(), format!("more than {most} points"));
        self.ended = true;
    }

    fn put(&mut self, layer: usize, line: usize, drawn: Drawn, record: &Record<'_>, faults: &mut Faults) {
        let (points, any) = match &drawn {
            Drawn::Curve(points) => (points.len(), points.len() > 1),
            Drawn::Faces(list) => (3 * list.len(), !list.is_empty()),
        };
        self.count(points, record, faults);
        if matches!(drawn, Drawn::Curve(_)) {
            self.curve_points += points;
            if self.curve_points > MOST_POINTS {
                self.too_many(record, MOST_POINTS, faults);
            }
        }
        if any {
            self.target().drawn.push((layer, line, drawn));
        }
    }

    fn entity(&mut self, kind: &str, record: &Record<'_>, faults: &mut Faults) {
        let is_unseen = record.whole(60, faults) == 1;
        let is_paper = record.whole(67, faults) == 1;
        if is_unseen || is_paper {
            return;
        }
        let layer = self.layers.number(&record.text(8));
        let line_number = record.line().unwrap_or(0);
        let drawn = match kind {
            "LINE" => Drawn::Curve(line(record, faults)),
            "LWPOLYLINE" => Drawn::Curve(light_polyline(record, faults)),
            "ARC" | "CIRCLE" => Drawn::Curve(arc(record, kind == "CIRCLE", faults)),
            "ELLIPSE" => Drawn::Curve(ellipse(record, faults)),
            "SPLINE" => Drawn::Curve(spline(record, faults)),
            "3DFACE" => Drawn::Faces(face(record, faults)),
            "MESH" => {
                let (faces, level) = mesh(record, faults);
                self.target().subdivided += usize::from(level > 0);
                Drawn::Faces(faces)
            }
            "POLYLINE" => {
                self.open = Some((layer, line_number, Polyline::begin(record, faults)));
                return;
            }
            "INSERT" => {
                let insert = Insert::of(record, layer, &upright(record, faults), faults);
                self.target().inserts.push(insert);
                return;
            }
            kind if SILENT.contains(&kind) => return,
            kind => {
                *self.target().unread.entry((layer, kind.chars().take(40).collect())).or_default() += 1;
                return;
            }
        };
        self.put(layer, line_number, drawn, record, faults);
    }
}
