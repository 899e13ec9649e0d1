//! 3MF (3MF Consortium, core specification 1.3): a package of XML. Read are the triangles of the objects that the build
//! shows, each moved by its item and the components above it. Supports, objects of type `other` and items that are not printed
//! are left out, and objects of type `surface` where there are models.

use roxmltree::{Document, Node, ParsingOptions};
use std::collections::{BTreeMap, HashMap};
use std::fmt::Write as _;
use std::io::{Cursor, Read as _, Write as _};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

use super::super::fault::{Faults, LARGEST, RecordFault};
use super::MOST_TRIANGLES;
use super::polygons::Polygons;
use crate::hull::{HullMesh, TriangleMesh};
use crate::units::counted;

/// Units, with their length \[m\].
const UNITS: [(&str, f64); 6] =
    [("micron", 1e-6), ("millimeter", 1e-3), ("centimeter", 1e-2), ("inch", 0.0254), ("foot", 0.3048), ("meter", 1.0)];

/// The most bytes of the model, the deepest components, and the most objects that are shown.
const MOST_UNPACKED: u64 = 512 << 20;
const DEEPEST: usize = 32;
const MOST_SHOWN: usize = 100_000;

/// A row of the four of a transformation: a point p becomes p M + t.
type Rows = [[f64; 3]; 4];

const STILL: Rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3]];

/// A mesh with its unit \[m\], and what is left out.
pub(in super::super) struct PackagedMesh {
    pub mesh: TriangleMesh,
    pub unit: f64,
    pub notes: Vec<String>,
}

/// Whether these are the bytes of a 3MF package: an archive with a model.
pub(in super::super) fn is_threemf(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK") && ZipArchive::new(Cursor::new(bytes)).is_ok_and(|archive| model_name(&archive).is_some())
}

fn model_name(archive: &ZipArchive<Cursor<&[u8]>>) -> Option<String> {
    let is_model = |name: &String| {
        let name = name.to_ascii_lowercase();
        name.starts_with("3d/") && name.ends_with(".model")
    };
    let names = archive.file_names().filter_map(|name| name.ok().map(|name| name.into_owned()));
    names.filter(is_model).min_by_key(String::len)
}

/// Reads a 3MF package, in its own unit; z is up.
///
/// # Errors
/// Every fault of the file, up to a number of them.
pub(in super::super) fn read_threemf(bytes: &[u8]) -> Result<PackagedMesh, Vec<RecordFault>> {
    let (mut faults, mut mesh, mut unit, mut notes) = (Faults::default(), Polygons::default(), 1e-3, Vec::new());
    match read(bytes, &mut mesh, &mut faults) {
        Ok(found) => (unit, notes) = found,
        Err(message) => faults.add(None, "", message),
    }
    mesh.finish(faults).map(|mesh| PackagedMesh { mesh, unit, notes })
}

/// The unit \[m\], and what is left out.
fn read(bytes: &[u8], mesh: &mut Polygons, faults: &mut Faults) -> Result<(f64, Vec<String>), String> {
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| format!("no archive: {error}"))?;
    let name = model_name(&archive).ok_or("the archive has no model")?;
    let mut text = String::new();
    let part = archive.by_name(&name).map_err(|error| format!("{name}: {error}"))?;
    part.take(MOST_UNPACKED + 1).read_to_string(&mut text).map_err(|error| format!("{name}: {error}"))?;
    if text.len() as u64 > MOST_UNPACKED {
        return Err(format!("{name}: more than {MOST_UNPACKED} bytes"));
    }
    let options = ParsingOptions { nodes_limit: 1 << 25, ..ParsingOptions::default() };
    let document = Document::parse_with_options(&text, options).map_err(|error| format!("{name}: no XML: {error}"))?;
    let root = document.root_element();
    let unit = root.attribute("unit").unwrap_or("millimeter");
    let unit =
        UNITS.iter().find(|(known, _)| *known == unit).map(|(_, unit)| *unit).ok_or(format!("no unit: {unit}"))?;
    let mut objects = HashMap::new();
    for object in root.descendants().filter(|node| node.tag_name().name() == "object") {
        objects.extend(object.attribute("id").map(|id| (id, object)));
    }
    let build = element(root, "build").ok_or("the model has no build")?;
    let is_model = |object: &Node<'_, '_>| object.attribute("type").is_none_or(|kind| kind == "model");
    let has_models = objects.values().any(|object| is_model(object) && element(*object, "mesh").is_some());
    let mut model = Model { objects, has_models, shown: 0, left_out: BTreeMap::new(), mesh, faults };
    for item in build.children().filter(|node| node.tag_name().name() == "item") {
        if matches!(item.attribute("printable"), Some("0" | "false")) {
            *model.left_out.entry("not printed".to_owned()).or_default() += 1;
        } else {
            model.add(item, STILL, 0)?;
        }
    }
    let left_out = &model.left_out;
    let notes = left_out.iter().map(|(why, count)| format!("left out: {}, {why}", counted(*count, "object"))).collect();
    Ok((unit, notes))
}

fn element<'a, 'b>(node: Node<'a, 'b>, name: &str) -> Option<Node<'a, 'b>> {
    node.children().find(|node| node.tag_name().name() == name)
}

/// The objects of a model, and what is shown of them so far.
struct Model<'a, 'b> {
    objects: HashMap<&'a str, Node<'a, 'b>>,
    /// Whether there are objects of type `model`.
    has_models: bool,
    shown: usize,
    /// Objects that are left out, by why.
    left_out: BTreeMap<String, usize>,
    mesh: &'a mut Polygons,
    faults: &'a mut Faults,
}

impl Model<'_, '_> {
    /// Adds what an item or a component shows.
    fn add(&mut self, shown: Node<'_, '_>, above: Rows, depth: usize) -> Result<(), String> {
        self.shown += 1;
        if depth > DEEPEST || self.shown > MOST_SHOWN {
            return Err(format!("components below more than {DEEPEST} others, or more than {MOST_SHOWN} of them"));
        }
        if shown.attributes().any(|attribute| attribute.name() == "path") {
            return Err("objects in other parts of the package are not read".to_owned());
        }
        let id = shown.attribute("objectid").unwrap_or_default();
        let object = *self.objects.get(id).ok_or_else(|| format!("no object {id}"))?;
        let kind = object.attribute("type").unwrap_or("model");
        if matches!(kind, "support" | "solidsupport" | "other") || kind == "surface" && self.has_models {
            *self.left_out.entry(format!("of type {kind}")).or_default() += 1;
            return Ok(());
        }
        let rows = match shown.attribute("transform") {
            Some(text) => {
                product(transform(text).ok_or_else(|| format!("transform {text}: expected 12 numbers"))?, above)
            }
            None => above,
        };
        if let Some(components) = element(object, "components") {
            for component in components.children().filter(|node| node.tag_name().name() == "component") {
                self.add(component, rows, depth + 1)?;
            }
        }
        element(object, "mesh")
            .map_or(Ok(()), |mesh| self.add_mesh(mesh, rows).map_err(|message| format!("object {id}: {message}")))
    }

    fn add_mesh(&mut self, mesh: Node<'_, '_>, rows: Rows) -> Result<(), &'static str> {
        let first = self.mesh.vertices.len();
        for vertex in element(mesh, "vertices").iter().flat_map(Node::children).filter(Node::is_element) {
            let number = |axis| vertex.attribute(axis).and_then(|word| word.parse::<f64>().ok());
            let [Some(x), Some(y), Some(z)] = ["x", "y", "z"].map(number) else {
                return Err("a vertex without numbers x, y and z");
            };
            let point = moved([x, y, z], rows);
            if !point.iter().all(|value| value.abs() <= LARGEST) {
                return Err("a vertex further than 1e8 from the origin");
            }
            if self.mesh.vertices.len() >= 3 * MOST_TRIANGLES {
                return Err("more vertices than the triangles that are read can have");
            }
            self.mesh.vertices.push(point);
        }
        // A mirror turns the triangles.
        let turns = determinant(rows) < 0.0;
        for triangle in element(mesh, "triangles").iter().flat_map(Node::children).filter(Node::is_element) {
            let place = |name| triangle.attribute(name).and_then(|word| word.parse::<usize>().ok());
            let [Some(a), Some(b), Some(c)] = ["v1", "v2", "v3"].map(place) else {
                return Err("a triangle without numbers v1, v2 and v3");
            };
            let places = if turns { [a, c, b] } else { [a, b, c] };
            if !self.mesh.face(None, &places.map(|place| first.saturating_add(place)), self.faults) {
                return Err("its triangles");
            }
        }
        Ok(())
    }
}

fn transform(text: &str) -> Option<Rows> {
    let numbers: Vec<f64> = text.split_whitespace().map(|word| word.parse().ok()).collect::<Option<_>>()?;
    let (rows, rest) = numbers.as_chunks::<3>();
    let rows: Rows = rows.try_into().ok()?;
    (rest.is_empty() && rows.as_flattened().iter().all(|value| value.is_finite())).then_some(rows)
}

fn moved(point: [f64; 3], rows: Rows) -> [f64; 3] {
    [0, 1, 2].map(|k| (0..3).map(|axis| point[axis] * rows[axis][k]).sum::<f64>() + rows[3][k])
}

/// First `a`, then `b`.
fn product(a: Rows, b: Rows) -> Rows {
    let turned = |row: [f64; 3]| [0, 1, 2].map(|k| (0..3).map(|axis| row[axis] * b[axis][k]).sum::<f64>());
    [turned(a[0]), turned(a[1]), turned(a[2]), moved(a[3], b)]
}

fn determinant([a, b, c, _]: Rows) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// The parts of a package besides its model.
const TYPES: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
    <Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\
    <Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\
    <Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n";
const RELATIONSHIPS: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
    <Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\
    <Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" \
    Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>\n";

/// A 3MF package of a mesh whose unit is `unit` \[m\]; x forward, y to port, z up.
///
/// # Errors
/// No name in the format for the unit, or a package that cannot be packed.
pub fn write_threemf(mesh: &HullMesh, unit: f64) -> Result<Vec<u8>, String> {
    let name = UNITS.iter().find(|(_, known)| (known - unit).abs() < 1e-12).map(|(name, _)| *name);
    let name = name.ok_or_else(|| format!("3MF has no unit of {unit} m"))?;
    let mut model = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"{name}\" \
         xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n<resources>\n\
         <object id=\"1\" type=\"model\"><mesh>\n<vertices>\n"
    );
    for [x, y, z] in &mesh.vertices {
        let _ = writeln!(model, "<vertex x=\"{x}\" y=\"{y}\" z=\"{z}\"/>");
    }
    model.push_str("</vertices>\n<triangles>\n");
    for (_, [a, b, c]) in &mesh.triangles {
        let _ = writeln!(model, "<triangle v1=\"{a}\" v2=\"{b}\" v3=\"{c}\"/>");
    }
    model.push_str("</triangles>\n</mesh></object>\n</resources>\n<build><item objectid=\"1\"/></build>\n</model>\n");
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    let packed = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
    for (part, text) in [("[Content_Types].xml", TYPES), ("_rels/.rels", RELATIONSHIPS), ("3D/3dmodel.model", &model)] {
        writer.start_file(part, packed).map_err(|error| error.to_string())?;
        writer.write_all(text.as_bytes()).map_err(|error| error.to_string())?;
    }
    writer.finish().map(Cursor::into_inner).map_err(|error| error.to_string())
}
