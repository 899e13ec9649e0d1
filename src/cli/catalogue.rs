//! `loftsman catalogue [NAME] [--like L=90,B=15,T=5,Cb=0.72]`

use std::path::PathBuf;

use clap::Args;

use super::stream;
use crate::report::{
    Destination, Failure, Inputs, OutputFile, WANTED, catalogue, catalogue_file, catalogue_json, catalogue_names,
    catalogue_page, catalogue_picture, ranked,
};
use crate::units::{Dimension, parse};

#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// A hull of the catalogue; without a name all of them
    name: Option<String>,
    /// Particulars to which the hulls should be close, as L=90,B=15,T=5,Cb=0.72
    #[arg(long, value_delimiter = ',', value_parser = wanted, value_name = "LIST", conflicts_with = "name", allow_hyphen_values = true)]
    like: Vec<(&'static str, f64)>,
    /// A folder whose hulls are listed too
    #[arg(long, value_name = "FOLDER")]
    catalogue: Option<PathBuf>,
    /// One JSON object
    #[arg(long)]
    json: bool,
    /// Folder for the file of the hull and its lines plan
    #[arg(short, long, value_name = "FOLDER", requires = "name")]
    output: Option<PathBuf>,
    /// Overwrite the file when it is there already
    #[arg(long)]
    force: bool,
}

const AFTER: &str = "\
The catalogue has the presets of `new` and tables of offsets that may be carried, with their sources and licences. `catalogue:NAME` \
stands for a hull of it wherever one is read: hydro catalogue:s175, derive catalogue:series60-cb070 --lpp 90.
Keys of --like: L, B, T (lengths), volume, Cb, Cm, Cwp, LCB (per cent of Lpp from midship, + forward). The distance is the root mean \
square of ln(x/x0)/0.1 of lengths, (c - c0)/0.02 of coefficients and the difference of LCB.";

fn wanted(text: &str) -> Result<(&'static str, f64), String> {
    let known = || format!("known are {}", WANTED.join(", "));
    let (key, value) = text.split_once('=').ok_or_else(|| format!("expected KEY=VALUE; {}", known()))?;
    let key = WANTED.into_iter().find(|known| known.eq_ignore_ascii_case(key.trim())).ok_or_else(known)?;
    let measure = parse(value.trim_end_matches('%')).map_err(|error| error.to_string())?;
    let is_length = matches!(key, "L" | "B" | "T");
    let fits = measure.dimension == Dimension::None || is_length && measure.dimension == Dimension::Length;
    if !fits || key != "LCB" && measure.value <= 0.0 {
        return Err(format!("{key} must be a {}", if is_length { "length" } else { "number" }));
    }
    Ok((key, measure.value))
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let (mut entries, left_out) = catalogue(arguments.catalogue.as_deref())?;
    left_out.iter().for_each(|line| stream::message(line));
    if let Some(name) = &arguments.name {
        entries.retain(|entry| entry.name == *name);
        let file = catalogue_file(name);
        if entries.is_empty() && file.is_none() {
            return Err(Failure::Usage(format!(
                "no hull of the catalogue is called '{name}'; known are {}",
                catalogue_names().join(", ")
            )));
        }
        if let (Some(folder), Some((file, text))) = (&arguments.output, file) {
            let destination = Destination { folder, inputs: &Inputs::of::<PathBuf>(&[]), force: arguments.force };
            let mut files = vec![OutputFile::text(&file, text)];
            if cfg!(feature = "pictures") {
                files.push(catalogue_picture(name)?);
            }
            destination.write(&files)?;
            stream::message(&format!("written to {}", folder.join(file).display()));
        }
    }
    let list = ranked(entries, &arguments.like);
    if arguments.json {
        return stream::data(&stream::json(&catalogue_json(&list))?);
    }
    let mut page = catalogue_page(&list, !arguments.like.is_empty());
    if let (Some(_), [(entry, _)]) = (&arguments.name, list.as_slice()) {
        page.push_str(&format!("{}\nSource: {}.\nLicence: {}.\n", entry.title, entry.source, entry.licence));
    }
    stream::data(&page)
}
