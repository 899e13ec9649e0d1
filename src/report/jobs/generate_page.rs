//! The short page of `generate`.

use super::outputs::Outputs;
use crate::hydrostatics::Conventions;
use crate::report::words::page::{WIDTH, conventions_line, dimensions, quantities, wrapped};

/// The summary of the main job: at most 24 lines of 80 columns.
#[must_use]
pub fn summary_page(outputs: &Outputs, conventions: &Conventions, folder: &str) -> String {
    let summary = &outputs.summary;
    let p = summary.particulars;
    let name: String = summary.name.chars().take(WIDTH - 14).collect();
    let mut page = format!("{name} ({})\n", summary.family);
    page.push_str(&(dimensions(&(&p).into()) + "\n"));
    if !summary.targets.is_empty() {
        page.push_str(&format!("{:<6}{:>14}{:>14}{:>12}  {}\n", "", "requested", "achieved", "error", "origin"));
        for target in &summary.targets {
            page.push_str(&format!(
                "{:<6}{:>14.6}{:>14.6}{:>12.1e}  {}\n",
                target.key, target.requested, target.achieved, target.error, target.origin
            ));
        }
        page.push('\n');
    }
    page.push_str(&quantities(&outputs.design_row, conventions, p.lpp));
    page.push('\n');
    page.push_str(&wrapped(&conventions_line(conventions), 2));
    let names: Vec<&str> = outputs.files.iter().map(|file| file.name.as_str()).collect();
    page.push_str(&wrapped(&format!("Written to {folder}: {}.", names.join(", ")), 2));
    page
}
