//! The tables of an archive: its unit, its layers and its objects.

use std::collections::HashMap;

use super::chunks::{class, code};
use super::cursor::{Chunk, Cursor, Object};

/// What all archives begin with; a version of 8 characters follows.
pub(super) const MAGIC: &[u8] = b"3D Geometry File Format ";

/// Most layers, and layers of layers.
const MOST_LAYERS: usize = 100_000;
const DEEPEST: usize = 64;

/// Most characters of the name of a layer, and of its name with those that it is part of, but for the last one.
const LONGEST_NAME: usize = 200;
const LONGEST_PATH: usize = 1000;

/// Most objects.
const MOST_OBJECTS: usize = 1_000_000;

/// Metres in the units by their numbers; 0 for those that say nothing.
const UNITS: [f64; 26] = [
    0.0,
    1e-6,
    1e-3,
    1e-2,
    1.0,
    1e3,
    2.54e-8,
    2.54e-5,
    0.0254,
    0.3048,
    1609.344,
    0.0,
    1e-10,
    1e-9,
    0.1,
    10.0,
    100.0,
    1e6,
    1e9,
    0.9144,
    0.0254 / 72.0,
    0.0254 / 6.0,
    1852.0,
    1.495_978_707e11,
    9.460_730_472_580_8e15,
    3.085_677_6e16,
];

/// The unit that states its own length.
const CUSTOM: usize = 11;

/// Versions that a reader of records asks for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Versions {
    /// Of the archive: 2, 3, 4, 5, 50, 60, ...
    pub(super) archive: u32,
    /// Of the toolkit that wrote it: a day with a digit, or from version 6 on a larger number.
    pub(super) toolkit: u32,
}

/// A layer.
#[derive(Debug, Clone, Default)]
pub(super) struct Layer {
    /// Its names from the outermost layer in.
    pub(super) name: String,
    /// Whether it, and those that it is part of, are shown.
    pub(super) visible: bool,
    index: i32,
    id: [u8; 16],
    parent: [u8; 16],
}

/// What an object is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mode {
    Shown,
    Hidden,
    /// Part of a definition, which is seen where an instance stands.
    Defined,
}

/// An identifier of an object or a definition.
pub(super) type Id = [u8; 16];

/// A record of the table of objects.
#[derive(Debug, Clone)]
pub(super) struct Record<'a> {
    pub(super) id: Id,
    /// The kind by its number.
    pub(super) kind: u32,
    pub(super) object: Option<Object<'a>>,
    /// Index into the layers; none where the file has no such layer.
    pub(super) layer: Option<usize>,
    pub(super) mode: Mode,
}

/// What is read of the tables.
#[derive(Debug)]
pub(super) struct Tables<'a> {
    pub(super) versions: Versions,
    /// Metres in the unit; none where the file states none.
    pub(super) unit: Option<f64>,
    pub(super) layers: Vec<Layer>,
    pub(super) records: Vec<Record<'a>>,
    /// The objects of blocks by the identifiers of these.
    pub(super) blocks: HashMap<Id, Vec<Id>>,
    /// Layers by their numbers in the file; of several with one number the first.
    numbered: HashMap<i32, usize>,
}

/// The version that an archive states.
fn version(bytes: &[u8]) -> Option<u32> {
    std::str::from_utf8(bytes.get(MAGIC.len()..MAGIC.len() + 8)?).ok()?.trim().parse().ok()
}

/// Reads the tables of an archive.
///
/// # Errors
/// What stands in the way.
pub(super) fn tables(bytes: &[u8]) -> Result<Tables<'_>, String> {
    if !bytes.starts_with(MAGIC) {
        return Err("no 3DM file, by its first words".to_owned());
    }
    let archive =
        version(bytes).ok_or("the file states no version behind its first words: it is damaged".to_owned())?;
    if archive < 2 {
        return Err("an archive of version 1, of Rhino 1; versions 2 to 8 are read".to_owned());
    }
    let mut tables = Tables {
        versions: Versions { archive, toolkit: 0 },
        unit: None,
        layers: Vec::new(),
        records: Vec::new(),
        blocks: HashMap::new(),
        numbered: HashMap::new(),
    };
    let mut rest = Cursor::new(&bytes[MAGIC.len() + 8..], archive >= 50);
    let mut ended = false;
    while !rest.is_at_end() && !ended {
        let damaged = || "the file is cut off or damaged: a chunk is longer than the rest of the file".to_owned();
        let chunk = rest.chunk().ok_or_else(damaged)?;
        ended = chunk.code == code::END_OF_FILE;
        tables.table(chunk)?;
    }
    if !ended {
        return Err("the file is cut off: it has no mark of its end".to_owned());
    }
    tables.name_layers();
    Ok(tables)
}

impl<'a> Tables<'a> {
    fn table(&mut self, table: Chunk<'a>) -> Result<(), String> {
        let mut inside = table.inside;
        let read: fn(&mut Self, Chunk<'a>) -> Option<()> = match table.code {
            code::PROPERTIES => Self::property,
            code::SETTINGS => Self::setting,
            code::LAYERS => Self::layer,
            code::OBJECTS => Self::record,
            code::DEFINITIONS => Self::definition,
            _ => return Ok(()),
        };
        while !inside.is_at_end() {
            let damaged = || "the file is damaged: a record of its tables ends within a value".to_owned();
            let record = inside.chunk().ok_or_else(damaged)?;
            read(self, record).ok_or_else(damaged)?;
            if self.layers.len() > MOST_LAYERS || self.records.len() > MOST_OBJECTS {
                return Err(format!("more than {MOST_LAYERS} layers or {MOST_OBJECTS} objects"));
            }
        }
        Ok(())
    }

    fn property(&mut self, record: Chunk<'a>) -> Option<()> {
        if record.code == code::TOOLKIT {
            self.versions.toolkit = record.value as u32;
        }
        Some(())
    }

    fn setting(&mut self, record: Chunk<'a>) -> Option<()> {
        if record.code != code::UNITS {
            return Some(());
        }
        let mut inside = record.inside;
        let version = inside.int()?;
        let unit = usize::try_from(inside.int()?).ok()?;
        let metres = if unit == CUSTOM && version >= 102 {
            // Tolerances, and how lengths are shown.
            inside.take(24 + 8)?;
            inside.real()?
        } else {
            *UNITS.get(unit).unwrap_or(&0.0)
        };
        self.unit = Some(metres).filter(|metres| *metres > 0.0);
        Some(())
    }

    fn layer(&mut self, record: Chunk<'a>) -> Option<()> {
        if record.code != code::LAYER {
            return Some(());
        }
        let mut inside = record.inside;
        let object = inside.object()?;
        if object.class != class::LAYER {
            return Some(());
        }
        let mut data = object.data.inside;
        let [_, minor] = data.version()?;
        let mut layer = Layer { visible: data.int()? != 1, index: data.int()?, ..Layer::default() };
        // Level, material, an old number, colour, style of lines.
        data.take(4 + 4 + 4 + 4 + 20)?;
        layer.name = data.text()?.chars().take(LONGEST_NAME).collect();
        if minor >= 1 {
            layer.visible = data.flag()?;
        }
        if minor >= 5 {
            // Line type, colour and width in print, lock.
            data.take(4 + 4 + 8 + 1)?;
            layer.id = data.id()?;
        }
        if minor >= 6 {
            layer.parent = data.id()?;
        }
        self.numbered.entry(layer.index).or_insert(self.layers.len());
        self.layers.push(layer);
        Some(())
    }

    /// Names layers with those that they are part of, and hides them with these.
    fn name_layers(&mut self) {
        let own = self.layers.clone();
        let by_id: HashMap<[u8; 16], usize> =
            own.iter().enumerate().filter(|(_, layer)| layer.id != [0; 16]).map(|(k, layer)| (layer.id, k)).collect();
        for (number, layer) in self.layers.iter_mut().enumerate() {
            let mut parent = layer.parent;
            let mut seen = vec![number];
            // A layer may be its own parent in a damaged file.
            while let Some(&k) = by_id.get(&parent).filter(|k| seen.len() <= DEEPEST && !seen.contains(k)) {
                seen.push(k);
                let above = &own[k];
                if layer.name.len() < LONGEST_PATH {
                    layer.name = format!("{}::{}", above.name, layer.name);
                }
                layer.visible &= above.visible;
                parent = above.parent;
            }
        }
    }

    /// A block; one that cannot be read has no objects.
    fn definition(&mut self, record: Chunk<'a>) -> Option<()> {
        if record.code == code::DEFINITION {
            let mut inside = record.inside;
            let later = self.versions.archive >= 60;
            let read = inside.object().and_then(|object| definition(object.data.inside, later));
            self.blocks.extend(read);
        }
        Some(())
    }

    fn record(&mut self, record: Chunk<'a>) -> Option<()> {
        if record.code != code::OBJECT {
            return Some(());
        }
        let mut inside = record.inside;
        let mut found = Record { id: [0; 16], kind: 0, object: None, layer: None, mode: Mode::Shown };
        while !inside.is_at_end() {
            let mut next = inside;
            let chunk = inside.chunk()?;
            match chunk.code {
                code::OBJECT_KIND => found.kind = chunk.value as u32,
                code::CLASS => found.object = next.object(),
                code::OBJECT_ATTRIBUTES => {
                    let (id, layer, mode) = attributes(chunk.inside, self.versions)?;
                    found.id = id;
                    found.layer = self.numbered.get(&layer).copied();
                    found.mode = mode;
                }
                _ => {}
            }
        }
        self.records.push(found);
        Some(())
    }
}

/// The identifier of an object, its layer by its index, and what it is for.
fn attributes(mut inside: Cursor<'_>, versions: Versions) -> Option<(Id, i32, Mode)> {
    let later = versions.archive >= 5 && versions.toolkit >= 200_712_190;
    let [_, minor] = inside.version()?;
    let id = inside.id()?;
    let layer = inside.int()?;
    let (visible, mode) = if later { items(inside)? } else { fixed(inside, minor)? };
    let mode = match mode & 15 {
        3 => Mode::Defined,
        1 => Mode::Hidden,
        _ if !visible => Mode::Hidden,
        _ => Mode::Shown,
    };
    Some((id, layer, mode))
}

/// The identifier of a block and those of its objects; none of these where they stand in another file.
fn definition(mut data: Cursor<'_>, later: bool) -> Option<(Id, Vec<Id>)> {
    if !later {
        data.version()?;
        return Some((data.id()?, ids(&mut data)?));
    }
    let mut inside = data.anonymous()?;
    // Chunks have their version in two numbers.
    inside.take(8)?;
    let mut attributes = inside.inside(code::COMPONENT)?;
    attributes.take(8)?;
    // Each with a byte before it that says whether it is there: a kind, the identifier.
    if attributes.flag()? {
        attributes.int()?;
    }
    let id = if attributes.flag()? { attributes.id()? } else { return None };
    // How it is brought up to date, its unit, and texts.
    inside.int()?;
    inside.chunk()?;
    for _ in 0..3 {
        inside.text()?;
    }
    inside.take(48)?;
    let objects = if inside.flag()? { ids(&mut inside)? } else { Vec::new() };
    Some((id, objects))
}

fn ids(data: &mut Cursor<'_>) -> Option<Vec<Id>> {
    let count = data.count(16)?;
    (0..count).map(|_| data.id()).collect()
}

/// Whether an object is visible, and its mode, of attributes with a number before each; those left out are usual.
fn items(mut inside: Cursor<'_>) -> Option<(bool, u8)> {
    let (mut visible, mut mode) = (true, 0);
    loop {
        match inside.byte()? {
            1 | 2 => drop(inside.text()?),
            3 | 4 | 6 | 7 | 10 => drop(inside.int()?),
            5 => drop(inside.chunk()?),
            8 => drop(inside.take(8)?),
            9 => drop(inside.byte()?),
            11 => visible = inside.flag()?,
            12 => mode = inside.byte()?,
            // Larger numbers say nothing of either.
            _ => return Some((visible, mode)),
        }
    }
}

/// The same of attributes in a fixed order.
fn fixed(mut inside: Cursor<'_>, minor: u8) -> Option<(bool, u8)> {
    // Material, colour, style of lines, density of wires.
    inside.take(4 + 4 + 20 + 4)?;
    let mode = inside.byte()?;
    inside.take(3)?;
    inside.text()?;
    inside.text()?;
    if minor < 2 {
        return Some((true, mode));
    }
    let groups = inside.count(4)?;
    inside.take(4 * groups)?;
    Some((inside.flag()?, mode))
}
