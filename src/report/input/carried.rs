//! The hulls that the program carries, as files.

use std::path::Path;

use crate::config::{TEMPLATES, template};
use crate::report::failure::{Failure, problem};

/// How paths of the catalogue begin.
pub(in crate::report) const PREFIX: &str = "catalogue:";

/// Tables of the catalogue.
const TABLES: [(&str, &str); 8] = [
    ("pdstrip-yacht", include_str!("../../../configs/catalogue/pdstrip-yacht.csv")),
    ("s175", include_str!("../../../configs/catalogue/s175.csv")),
    ("series60-cb060", include_str!("../../../configs/catalogue/series60-cb060.csv")),
    ("series60-cb070", include_str!("../../../configs/catalogue/series60-cb070.csv")),
    ("series60-cb075", include_str!("../../../configs/catalogue/series60-cb075.csv")),
    ("wigley-blunt", include_str!("../../../configs/catalogue/wigley-blunt.csv")),
    ("wigley-i", include_str!("../../../configs/catalogue/wigley-i.csv")),
    ("wigley-iii", include_str!("../../../configs/catalogue/wigley-iii.csv")),
];

/// The index, as [`index_csv`] makes it.
pub(in crate::report) const INDEX: &str = include_str!("../../../configs/catalogue/index.csv");

/// Names of the hulls that the program carries.
#[must_use]
pub fn catalogue_names() -> Vec<&'static str> {
    TEMPLATES.iter().map(|template| template.name).chain(TABLES.iter().map(|(name, _)| *name)).collect()
}

/// The file of a hull that the program carries: the ending of its name, and its text.
pub(in crate::report) fn carried(name: &str) -> Option<(&'static str, String)> {
    let table = TABLES.iter().find(|(known, _)| *known == name).map(|(_, text)| ("csv", (*text).to_owned()));
    table.or_else(|| Some(("toml", template(name).filter(|_| TEMPLATES.iter().any(|known| known.name == name))?)))
}

/// The name of a hull of the catalogue that a path stands for; none for other paths.
pub(in crate::report) fn name_of(path: &Path) -> Option<&str> {
    let name = path.file_name()?.to_str()?.strip_prefix(PREFIX)?;
    Some(name.strip_suffix(".csv").or_else(|| name.strip_suffix(".toml")).unwrap_or(name))
}

/// The ending of the file that a path of the catalogue stands for; none for other paths.
pub(in crate::report) fn catalogue_ending(path: &Path) -> Option<&'static str> {
    carried(name_of(path)?).map(|(ending, _)| ending)
}

/// The contents of the file that a path of the catalogue stands for; none for other paths.
///
/// # Errors
/// E133 for a name that is not in the catalogue.
pub(in crate::report) fn catalogue_bytes(path: &Path) -> Option<Result<Vec<u8>, Failure>> {
    let name = name_of(path)?;
    let missing = || {
        let message = format!("no hull of the catalogue is called '{name}'");
        let remedy = format!("Known are {}", catalogue_names().join(", "));
        Failure::Input(vec![problem("E133", path, message, remedy)])
    };
    Some(carried(name).map(|(_, text)| text.into_bytes()).ok_or_else(missing))
}

/// What is wrong with a path that names no file, but without its prefix a hull of the catalogue; none for other paths.
pub(in crate::report) fn without_prefix(path: &Path) -> Option<Failure> {
    let name = path.to_str().filter(|name| carried(name).is_some())?;
    let message = "no file has this name; a hull of the catalogue has".to_owned();
    Some(Failure::Input(vec![problem("E133", path, message, format!("Give {PREFIX}{name}"))]))
}

/// What a comment `key: value` of a table says.
pub(in crate::report) fn comment<'t>(text: &'t str, key: &str) -> &'t str {
    let lines = text.lines().filter_map(|line| line.strip_prefix('#'));
    let value = |line: &'t str| {
        let (own, value) = line.trim().split_once(':')?;
        (own == key).then(|| value.trim())
    };
    lines.filter_map(value).next().unwrap_or_default()
}
