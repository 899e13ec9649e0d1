//! The catalogue: its index, its ranking, and its hulls as inputs of other commands.

use std::fs;

use loftsman::internals::report::{catalogue, catalogue_names, index_csv, ranked};

use crate::support::{carried, folder, program, stderr, stdout};

/// `LOFTSMAN_GOLDEN=1` writes the index anew.
#[test]
fn the_index_has_the_particulars_of_the_files() {
    let made = index_csv().unwrap();
    let path = carried("configs/catalogue/index.csv");
    if std::env::var_os("LOFTSMAN_GOLDEN").is_some() {
        fs::write(&path, &made).unwrap();
    }
    let fields =
        |text: &str| text.lines().map(|row| row.split(',').map(str::to_owned).collect()).collect::<Vec<Vec<_>>>();
    let (made, kept) = (fields(&made), fields(&fs::read_to_string(&path).unwrap()));
    assert_eq!(made.len(), kept.len(), "LOFTSMAN_GOLDEN=1 writes the index anew");
    for (made, kept) in made.iter().flatten().zip(kept.iter().flatten()) {
        let near = match (made.parse::<f64>(), kept.parse::<f64>()) {
            (Ok(a), Ok(b)) => (a - b).abs() <= 1e-3 * (1.0 + a.abs()),
            _ => made == kept,
        };
        assert!(near, "{made} for {kept}: LOFTSMAN_GOLDEN=1 writes the index anew");
    }
}

#[test]
fn every_hull_has_a_source_and_a_licence_and_the_figures_of_its_publication() {
    let (list, _) = catalogue(None).unwrap();
    assert!(list.len() + 1 >= catalogue_names().len(), "{}", list.len());
    for entry in &list {
        assert!(!entry.title.is_empty() && !entry.source.is_empty() && !entry.licence.is_empty(), "{}", entry.name);
        assert!(entry.block > 0.2 && entry.block <= 1.0 && entry.waterplane <= 1.0, "{}", entry.name);
    }
    // C_B and LCB that are published: ITTC, Todd.
    for (name, block, lcb) in [
        ("s175", 0.5716, -1.42),
        ("series60-cb060", 0.6, -1.5),
        ("series60-cb070", 0.7, 0.5),
        ("series60-cb075", 0.75, 1.5),
    ] {
        let entry = list.iter().find(|entry| entry.name == name).unwrap();
        assert!((entry.block - block).abs() < 0.006, "{name}: {}", entry.block);
        assert!((entry.lcb.unwrap() - lcb).abs() < 0.15, "{name}: {:?}", entry.lcb);
    }
    // Closed forms of the modified Wigley hulls, and the volumes 0.0946 and 0.0780 m3 that are published of I and III on 3 m.
    for (name, block, midship, waterplane, published) in [
        ("wigley-i", 0.560_731, 0.909_091, 0.693_333, Some(0.0946)),
        ("wigley-iii", 0.462_222, 0.666_667, 0.693_333, Some(0.0780)),
        ("wigley-blunt", 0.634_382, 0.909_091, 0.803_810, None),
    ] {
        let entry = list.iter().find(|entry| entry.name == name).unwrap();
        assert!((entry.block - block).abs() < 5e-4 && (entry.waterplane - waterplane).abs() < 5e-4, "{entry:?}");
        assert!((entry.midship.unwrap() - midship).abs() < 1e-3 && entry.lcb.unwrap().abs() < 0.01, "{entry:?}");
        let model = entry.volume * 0.03_f64.powi(3);
        assert!(published.is_none_or(|volume| (model - volume).abs() < 1e-4), "{model}");
    }
    // All that is carried is below 1 MB.
    let size: u64 =
        fs::read_dir(carried("configs/catalogue")).unwrap().map(|f| f.unwrap().metadata().unwrap().len()).sum();
    assert!(size < 1 << 20);
}

#[test]
fn the_nearest_hull_comes_first() {
    let (list, _) = catalogue(None).unwrap();
    for wanted in &list {
        let like = [("L", wanted.length), ("B", wanted.breadth), ("T", wanted.draught), ("Cb", wanted.block)];
        let found = ranked(list.clone(), &like);
        assert!(
            found[0].1.unwrap() < 1e-9 && found.windows(2).all(|pair| pair[0].1 <= pair[1].1 || pair[1].1.is_none())
        );
    }
    // One off in each: a length by a tenth (in its logarithm), a coefficient by 0.02.
    let wigley = list.iter().find(|entry| entry.name == "wigley").unwrap();
    let like = [("L", wigley.length * 0.1_f64.exp()), ("Cb", wigley.block + 0.02)];
    assert!((wigley.distance(&like).unwrap() - 1.0).abs() < 1e-9);
}

#[test]
fn hulls_of_the_catalogue_are_inputs() {
    let done = program(&["hydro", "catalogue:s175", "--draughts", "9.5", "--json"]);
    assert_eq!(done.status.code(), Some(0), "{}", stderr(&done));
    let json: serde_json::Value = serde_json::from_str(&stdout(&done)).unwrap();
    let volume = json["rows"][0]["DISPVOL"].as_f64().unwrap();
    assert!((volume / 24_138.5 - 1.0).abs() < 0.01, "{volume}");
    let to = folder("daughter");
    let out = to.to_str().unwrap();
    let done = program(&["derive", "catalogue:tug", "--lpp", "30", "-o", out, "--no-figures"]);
    assert_eq!(done.status.code(), Some(0), "{}", stderr(&done));
    let done = program(&["hydro", "catalogue:s157"]);
    assert_eq!(done.status.code(), Some(3));
    assert!(stderr(&done).contains("E133") && stderr(&done).contains("Known are bulk-carrier"), "{}", stderr(&done));
    let done = program(&["hydro", "s175"]);
    assert!(stderr(&done).contains("E133") && stderr(&done).contains("Give catalogue:s175"), "{}", stderr(&done));
}

#[test]
fn a_folder_of_hulls_is_listed_and_a_file_is_given_out() {
    let to = folder("own");
    let out = to.to_str().unwrap();
    let done = program(&["catalogue", "series60-cb060", "-o", out]);
    assert_eq!(done.status.code(), Some(0), "{}", stderr(&done));
    assert!(stdout(&done).contains("Licence: a publication of the US government"), "{}", stdout(&done));
    let picture = fs::read(to.join("series60-cb060.png")).unwrap();
    assert!(picture.starts_with(b"\x89PNG") && picture.len() > 20_000, "{}", picture.len());
    let done = program(&["catalogue", "--catalogue", out, "--like", "L=121.92 m,Cb=0.6", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&stdout(&done)).unwrap();
    let hulls = json["hulls"].as_array().unwrap();
    let own = hulls.iter().filter(|hull| hull["name"].as_str().unwrap().ends_with("series60-cb060.csv")).count();
    assert_eq!(own, 1);
    assert!(hulls[0]["name"].as_str().unwrap().contains("series60-cb060"));
    let done = program(&["catalogue", "--like", "Cb=-1"]);
    assert_eq!(done.status.code(), Some(2));
}
