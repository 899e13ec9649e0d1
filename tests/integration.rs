//! The integration tests in one binary, which is compiled and linked once: one module a file. One of them alone is run
//! by `cargo test --test integration families::`.
//!
//! A test that needs a process of its own (it sets variables of the environment, say) has to be a binary beside this
//! one. None does.

mod analytic_bodies;
mod analytic_round_bodies;
mod architecture;
mod bodies;
mod body_cases;
mod book;
mod charts;
mod cli;
mod cli_refusals;
mod codes;
mod configs;
mod draught;
mod errors;
mod examples;
mod export;
mod fair;
mod fair_curve;
mod fair_files;
mod fair_grades;
mod fair_hulls;
mod fair_locks;
mod fair_points;
mod fair_refusals;
mod fair_rocker;
mod fair_rules;
mod fair_sections;
mod fair_strength;
mod families;
mod fit;
mod fit_features;
mod fit_report;
mod hemisphere;
mod hydrostatics;
mod inflections;
mod inspect;
mod machines;
mod methods;
mod partners;
mod qp;
mod qp_problems;
mod random;
mod report;
mod report_browser;
mod report_figures;
mod resistance;
mod sections;
mod support;
mod suspects;
mod suspects_lines;
mod suspects_outlines;
mod table_errors;
mod table_files;
mod table_layouts;
mod table_reading;
mod table_sections;
mod text_formats;
mod truth;
mod truth_draws;
mod truth_hulls;
mod truth_tables;
mod validation;
mod words;
