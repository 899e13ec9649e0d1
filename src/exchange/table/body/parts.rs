//! Which parts of a body count: groups, solids and layers by name, shells by number.

use super::super::problem::{FilePosition, Problems};
use super::super::settings::PartChoice;
use crate::hull::TriangleMesh;
use crate::units::counted;

/// Most shells that are listed, and most triangles of a mesh whose shells are listed unasked.
const LISTED: usize = 12;
const MOST_LISTED: usize = 200_000;

/// A part of a file with its name.
pub(in super::super::super) type NamedMesh = (String, TriangleMesh);

pub(super) fn joined(meshes: impl Iterator<Item = TriangleMesh>) -> TriangleMesh {
    let all: Vec<TriangleMesh> = meshes.collect();
    TriangleMesh::from_corners(all.iter().flat_map(TriangleMesh::corners))
}

/// The first names, and how many more there are.
pub(super) fn some(names: &[&str]) -> String {
    let more = if names.len() > LISTED { format!(" and {} more", names.len() - LISTED) } else { String::new() };
    names[..names.len().min(LISTED)].join(", ") + &more
}

/// Names that are chosen.
fn names(choice: Option<&[PartChoice]>) -> Vec<&str> {
    let parts = choice.unwrap_or_default().iter();
    parts
        .filter_map(|part| match part {
            PartChoice::Name(name) => Some(name.as_str()),
            PartChoice::Number(_) => None,
        })
        .collect()
}

/// Whether parts are chosen by their names.
pub(in super::super) fn is_by_name(choice: Option<&[PartChoice]>) -> bool {
    !names(choice).is_empty()
}

/// Whether a name is chosen, or none is.
pub(super) fn is_chosen(own: &str, choice: Option<&[PartChoice]>) -> bool {
    let names = names(choice);
    names.is_empty() || names.iter().any(|name| own.eq_ignore_ascii_case(name))
}

/// Which of the names a file has are chosen; all where none is. A name that it has not is a problem.
pub(in super::super) fn chosen_names(
    known: &[&str],
    choice: Option<&[PartChoice]>,
    problems: &mut Problems,
) -> Vec<bool> {
    let names = names(choice);
    for name in &names {
        if !known.iter().any(|own| own.eq_ignore_ascii_case(name)) {
            let remedy = match known {
                [] => "The file has no named parts: give their numbers".to_owned(),
                known => format!("Known are {}", some(known)),
            };
            problems.error("E311", FilePosition::FILE, format!("parts: no part '{name}'"), &remedy);
        }
    }
    known.iter().map(|own| is_chosen(own, choice)).collect()
}

/// The mesh of the named parts that are chosen; says what there are.
pub(super) fn of_names(parts: Vec<NamedMesh>, choice: Option<&[PartChoice]>, problems: &mut Problems) -> TriangleMesh {
    let known: Vec<&str> = parts.iter().map(|(name, _)| name.as_str()).collect();
    if known.len() > 1 {
        problems.note(format!("parts of the file: {}", some(&known)));
    }
    let chosen = chosen_names(&known, choice, problems);
    if let [_] = parts[..] {
        return parts.into_iter().next().map(|(_, mesh)| mesh).unwrap_or_default();
    }
    joined(parts.into_iter().zip(chosen).filter(|(_, chosen)| *chosen).map(|((_, mesh), _)| mesh))
}

/// The mesh of the shells that are chosen by their numbers, from 1, the largest first; all where none is. The first of
/// several meshes of one body alone has problems to say.
pub(super) fn of_numbers(
    mesh: TriangleMesh,
    choice: Option<&[PartChoice]>,
    problems: Option<&mut Problems>,
) -> TriangleMesh {
    let number = |part: &PartChoice| match part {
        PartChoice::Number(number) => Some(*number),
        PartChoice::Name(_) => None,
    };
    let numbers: Vec<usize> = choice.unwrap_or_default().iter().filter_map(number).collect();
    if numbers.is_empty() && (choice.is_some() || mesh.triangles.len() > MOST_LISTED) {
        return mesh;
    }
    let shells = mesh.parts();
    let Some(problems) = problems else { return chosen(mesh, shells, &numbers) };
    if shells.len() > 1 {
        problems.note(format!("shells, the largest first: {}", listed(&shells)));
    }
    for number in numbers.iter().filter(|number| !(1..=shells.len()).contains(number)) {
        let message = format!("parts: no shell {number}; the body has {}", counted(shells.len(), "shell"));
        problems.error("E311", FilePosition::FILE, message, "`inspect` and `hydro` list them");
    }
    chosen(mesh, shells, &numbers)
}

fn chosen(mesh: TriangleMesh, shells: Vec<TriangleMesh>, numbers: &[usize]) -> TriangleMesh {
    if numbers.is_empty() {
        return mesh;
    }
    joined((1..).zip(shells).filter(|(number, _)| numbers.contains(number)).map(|(_, shell)| shell))
}

fn listed(shells: &[TriangleMesh]) -> String {
    let one = |(number, shell): (usize, &TriangleMesh)| {
        let [low, high] = shell.bounds().unwrap_or_default();
        let ends = |k: usize| format!("{:.3} to {:.3}", low[k], high[k]);
        format!(
            "{number} ({}, x {}, y {}, z {})",
            counted(shell.triangles.len(), "triangle"),
            ends(0),
            ends(1),
            ends(2)
        )
    };
    let list: Vec<String> = (1..).zip(shells.iter().take(LISTED)).map(one).collect();
    let more = if shells.len() > LISTED { format!(" and {} more", shells.len() - LISTED) } else { String::new() };
    list.join("; ") + &more
}
