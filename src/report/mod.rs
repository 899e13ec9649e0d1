//! Whole jobs: from a design or a table to the files about it, and what is printed of them.

mod failure;
mod input;
mod jobs;
mod output;
mod words;

pub use failure::{COMMAND_LINE, Failure};
pub use input::carried::catalogue_names;
pub use input::hydrostatic_body::{
    HydrostaticBody, read_hydrostatic_body, read_hydrostatic_body_at, read_hydrostatic_body_with,
};
pub use input::result::{JobResult, read_result};
pub use input::source::{
    Overrides, Source, conventions_beside, is_hull, offsets, read_design, read_source, read_source_with,
    read_table_file, read_table_file_with, sections_of, source_files,
};
pub use jobs::blend::{BlendJob, BlendOutputs, HULL_KEYS, OfHull, blend_files, blend_outputs};
pub use jobs::blend_page::blend_page;
pub use jobs::catalogue::{
    CatalogueEntry, WANTED, catalogue, catalogue_file, catalogue_json, catalogue_page, catalogue_picture, index_csv,
    ranked,
};
pub use jobs::check::{
    Accepted, Check, CheckProblem, accept, check_files, check_json, check_page, check_table, check_table_with,
};
pub use jobs::compare::hulls::{CompareJob, CompareOutputs, ComparedHull};
pub use jobs::compare::page::compare_page;
pub use jobs::compare::run::{compare_files, compare_outputs};
pub use jobs::convert::{Converted, convert_file, convert_table};
pub use jobs::derive::{DeriveJob, DeriveOutputs, derive_files, derive_outputs, read_derive_job};
pub use jobs::derive_page::derive_page;
pub use jobs::export::{ExportFormat, ExportSettings, Exported, draught_of, export};
pub use jobs::fair::job::{FairJob, FairOutputs, read_fair, read_fair_with};
pub use jobs::fair::page::{fair_line, fair_page};
pub use jobs::fair::run::{fair_outputs, fair_outputs_with_progress};
pub use jobs::fair::short::fair_summary;
pub use jobs::fair_curve::{
    CurveJob, FairedCurve, Kept, fair_curve_files, fair_curve_json, fair_curve_page, faired_curve,
};
pub use jobs::fit::{FitJob, FitOutputs, fit_outputs, fit_page, read_fit, read_fit_with};
pub use jobs::generate::generate_outputs;
pub use jobs::generate_page::summary_page;
pub use jobs::inspect::{inspection_json, inspection_page};
pub use jobs::loft::{LoftFormat, LoftSettings, Lofted, SkinSide, loft};
pub use jobs::outputs::Outputs;
pub use jobs::report::run::report_outputs;
pub use jobs::report::settings::ReportSettings;
pub use jobs::resistance::{ResistanceJob, ResistanceOutputs, resistance_files, resistance_outputs};
pub use jobs::resistance_inputs::ResistanceOptions;
pub use jobs::resistance_page::resistance_page;
pub use jobs::self_test::{SelfCheck, self_test, self_test_page};
pub use jobs::validate::{
    Case, Comparison, Tolerance, Verdict, validate, validation_csv, validation_json, validation_page,
};
pub use output::files::{Destination, Inputs, OutputFile, same_path};
pub use words::codes::{CODES, Explanation, codes_json, codes_list, codes_page, codes_text, explanation, explanations};
pub use words::page::{TENDER, hydrostatics_page};
