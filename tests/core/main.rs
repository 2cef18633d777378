//! Everything below the window, from outside: what a caller of the library and a person at the
//! terminal meet. One binary, so that the library is linked once; a file per subject.

#[path = "../support/cases.rs"]
mod cases;
#[path = "../support/compensating.rs"]
mod compensating;
#[path = "../support/controllers.rs"]
mod controllers;
#[path = "../support/exporting.rs"]
mod exporting;
#[path = "../support/gantry.rs"]
mod gantry;
#[path = "../support/hidden_robot.rs"]
mod hidden_robot;
#[path = "../support/program.rs"]
mod program;
#[path = "../support/rig.rs"]
mod rig;

mod arms;
mod arms_verdicts;
mod axis_tables;
mod bad_files;
mod bundled_sessions;
mod cli;
mod compensation;
mod contract_rules;
mod corrected_robots;
mod costs;
mod diagnosis;
mod diagnosis_blunders;
mod diagnosis_conditions;
mod diagnosis_invariance;
mod documents;
mod doors;
mod effects;
mod effects_as_data;
mod export_consumers;
mod exports;
mod faults;
mod few_poses;
mod foreign_files;
mod fuzz_smoke;
mod gate;
mod gear_ratio;
mod guides;
mod hostile;
mod house;
mod imports;
mod installed;
mod kinematics_reference;
mod languages;
mod library;
mod library_parts;
mod library_sessions;
mod limits;
mod mistakes;
mod observations;
mod observed_poses;
mod odd_rows;
mod paper;
mod plan;
mod plan_arms;
mod program_frames;
mod program_table;
mod programs;
mod public_reports;
mod recordings;
mod recovery;
mod report;
mod report_details;
mod report_languages;
mod rivals;
mod robot_library;
mod robots;
mod rows;
mod security;
mod sessions_on_disk;
mod simulated_geometry;
mod standards;
mod streams;
mod target_places;
mod unexplained;
mod unnamed;
mod unseen_poses;
