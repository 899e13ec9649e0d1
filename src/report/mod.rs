//! Whole jobs: from a design or a table to the files about it, and what is printed of them.

mod blend;
mod blend_page;
mod catalogue;
mod check;
mod codes;
mod comb_lines;
mod compare;
mod compare_page;
mod convert;
mod derive;
mod derive_page;
mod derived_hull;
mod doubts;
mod export;
mod failure;
mod fair;
mod fair_curve;
mod fair_figures;
mod fair_grades;
mod fair_held;
mod fair_page;
mod fair_refused;
mod fair_short;
mod files;
mod fit;
mod generate;
mod hydrostatic_body;
mod inspect;
mod lengths;
mod lines_plan;
mod loft;
mod markdown;
mod overshoot;
mod page;
mod resistance;
mod resistance_inputs;
mod resistance_page;
mod result;
mod result_figures;
mod result_files;
mod result_page;
mod result_tables;
mod self_test;
mod source;
mod staging;
mod validate;
mod verdict;
mod waves;

pub use blend::{BlendJob, BlendOutputs, HULL_KEYS, OfHull, blend_files, blend_outputs};
pub use blend_page::blend_page;
pub use catalogue::{
    CatalogueEntry, WANTED, catalogue, catalogue_file, catalogue_json, catalogue_names, catalogue_page,
    catalogue_picture, index_csv, ranked,
};
pub use check::{
    Accepted, Check, CheckProblem, accept, check_files, check_json, check_page, check_table, check_table_with,
};
pub use codes::{CODES, Explanation, codes_json, codes_list, codes_page, codes_text, explanation, explanations};
pub use compare::{CompareJob, CompareOutputs, ComparedHull, compare_files, compare_outputs};
pub use compare_page::compare_page;
pub use convert::{Converted, convert_file, convert_table, is_hull};
pub use derive::{DeriveJob, DeriveOutputs, derive_files, derive_outputs, read_derive_job};
pub use derive_page::derive_page;
pub use export::{ExportFormat, ExportSettings, Exported, draught_of, export};
pub use failure::{COMMAND_LINE, Failure};
pub use fair::{FairJob, FairOutputs, fair_outputs, fair_outputs_with_progress, read_fair, read_fair_with};
pub use fair_curve::{CurveJob, FairedCurve, Kept, fair_curve_files, fair_curve_json, fair_curve_page, faired_curve};
pub use fair_page::{fair_line, fair_page};
pub use fair_short::fair_summary;
pub use files::{Destination, Inputs, OutputFile, same_path};
pub use fit::{FitJob, FitOutputs, fit_outputs, fit_page, read_fit, read_fit_with};
pub use generate::{Outputs, generate_outputs};
pub use hydrostatic_body::{
    HydrostaticBody, read_hydrostatic_body, read_hydrostatic_body_at, read_hydrostatic_body_with,
};
pub use inspect::{inspection_json, inspection_page};
pub use loft::{LoftFormat, LoftSettings, Lofted, SkinSide, loft};
pub use page::{TENDER, hydrostatics_page, self_test_page, summary_page};
pub use resistance::{ResistanceJob, ResistanceOutputs, resistance_files, resistance_outputs};
pub use resistance_inputs::ResistanceOptions;
pub use resistance_page::resistance_page;
pub use result::{JobResult, read_result};
pub use result_files::{ReportSettings, report_outputs};
pub use self_test::{SelfCheck, self_test};
pub use source::{
    Overrides, Source, conventions_beside, offsets, read_design, read_source, read_source_with, read_table_file,
    read_table_file_with, sections_of, source_files,
};
pub use validate::{Case, Comparison, Tolerance, Verdict, validate, validation_csv, validation_json, validation_page};
