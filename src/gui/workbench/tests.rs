//! Commands, one by one.

mod how_far;
mod under_way;

use std::sync::Arc;

use super::Looked;
use super::Workbench;
use crate::gui::core::disk::FileChange;
use crate::gui::core::regions::boundaries;

use crate::export::EXPORTERS;
use crate::fit::Estimate;
use crate::gui::core::document::{ExportChoice, Method};
use crate::gui::core::loaded_session::{LoadedSession, Origin};
use crate::gui::core::search::terms;
use crate::gui::core::setup::SetupForm;
use crate::gui::jobs::{Jobs, Runner};
use crate::gui::testing::workbench;
use crate::gui::view::{About, NextAction, OnDisk, Step, What};
use crate::units::rad_from_deg;

fn done(workbench: &mut Workbench, change: impl FnOnce(&mut Workbench)) {
    workbench.execute(change);
    workbench.receive();
}

#[test]
fn the_exact_fit_finds_what_the_simulation_hid() {
    let mut workbench = workbench();
    done(&mut workbench, |bench| {
        bench.edit(|document| document.choose_effect("backlash", true));
    });
    done(&mut workbench, |bench| bench.identify(None));
    let found = &workbench
        .answer()
        .expect("it can be identified")
        .identification;
    let value = |name: &str| {
        let one = found.parameters.iter().find(|p| p.name == name);
        one.expect("it was fitted").value
    };
    assert!((value("offset_deg") + 3.0).abs() < 0.01);
    assert!((value("delta_mm") + 5.0).abs() < 0.05);
    assert!((value("width_deg") - 0.05).abs() < 0.01);
    assert!(found.gap.after.rms_mm < 0.08);
}

#[test]
fn all_that_a_search_found_is_one_model_to_the_last_bit_wherever_it_goes() {
    let mut workbench = workbench();
    workbench.execute(Workbench::search);
    workbench.receive();
    let found = workbench.diagnosis().expect("it was searched").clone();
    assert!(!found.found.is_empty());
    let terms: Vec<_> = terms(&found).into_iter().flatten().collect();
    done(&mut workbench, |bench| bench.edit(|d| d.add(&terms)));
    let all = found.calibration(&workbench.loaded_session().session);
    let answer = workbench.answer().expect("it is identified");
    assert_eq!(answer.calibration, all);
    assert_eq!(answer.identification.model, all.model);
    let width = |estimates: &[Estimate]| {
        let one = estimates.iter().find(|e| e.name == "width_deg");
        one.expect("it was found").clone()
    };
    let shown = width(&answer.identification.parameters);
    assert_eq!(shown, width(&found.found[0].parameters));
    // There is one fit: what is shown of it is what the search answered.
    if found.correction().is_none() {
        assert_eq!(answer.identification, found.identification);
    }
    assert_eq!(found.identification.outliers, found.outliers);
    assert_eq!(found.identification.model, found.model);
    let gap = answer.identification.gap.after.rms_mm;
    assert!((gap - found.gap.end_mm).abs() < 1e-9, "{gap}");
    // A part of it is another model; all of it is the same one again.
    done(&mut workbench, |bench| {
        bench.edit(|d| d.switch(&[0], false));
    });
    let part = &workbench.answer().expect("identified").calibration;
    assert_ne!(part.model, all.model);
    done(&mut workbench, |bench| bench.edit(|d| d.switch(&[0], true)));
    assert_eq!(workbench.answer().expect("identified").calibration, all);
}

#[test]
fn dragging_a_boundary_identifies_by_region_and_is_undone_in_one_step() {
    let mut workbench = workbench();
    for deg in [1.0, 3.0, 7.0] {
        workbench.execute(|bench| {
            bench.drag(true);
            bench.edit(|document| document.move_boundary(3, rad_from_deg(deg)));
        });
        workbench.receive();
        assert!(workbench.settled(), "the answer follows at once");
        let outcome = workbench.answer().expect("by region");
        assert_eq!(outcome.identification.method, "regional");
    }
    workbench.execute(|bench| bench.drag(false));
    assert_eq!(workbench.undoes(), Some("change regions"));
    workbench.execute(Workbench::undo);
    let all = boundaries(&workbench.document().regions);
    assert!(all[3].at_rad.abs() < 1e-12);
    assert_eq!(workbench.document().method, Method::Exact);
    assert_eq!(workbench.undoes(), None);
}

#[test]
fn undo_brings_the_session_before_back() {
    let mut workbench = workbench();
    let first = Arc::clone(workbench.loaded_session());
    workbench.execute(|bench| bench.ask_then(NextAction::Example(1)));
    workbench.receive();
    assert_eq!(workbench.loaded_session().len(), 30);
    workbench.execute(Workbench::undo);
    assert!(Arc::ptr_eq(&first, workbench.loaded_session()));
}

#[test]
fn an_answer_to_another_question_is_not_shown() {
    let mut workbench = workbench();
    done(&mut workbench, |bench| bench.identify(None));
    assert!(workbench.answer().is_some());
    workbench.execute(|bench| bench.ask_then(NextAction::Example(1)));
    workbench.receive();
    assert!(workbench.answer().is_none(), "nothing is identified yet");
}

#[test]
fn what_cannot_be_done_is_said_and_changes_nothing() {
    let mut workbench = workbench();
    let before = workbench.document().clone();
    done(&mut workbench, |bench| {
        bench.edit(|document| document.divide(0));
    });
    assert_eq!(*workbench.document(), before);
    let message = workbench.view.message.as_ref().expect("it is said");
    assert!(message.wrong && message.details[0].contains("0 regions"));
    assert_eq!(workbench.undoes(), None);
}

#[test]
fn a_wrong_file_leaves_everything_as_it_was() {
    let mut workbench = workbench();
    done(&mut workbench, |bench| bench.identify(None));
    let before = workbench.document().clone();
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("wrong.json");
    std::fs::write(&path, "{ \"format\": \"truepose-session/1\", ").expect("it can be written");
    workbench.execute(|bench| bench.open_file(path));
    workbench.receive();
    assert_eq!(*workbench.document(), before);
    assert!(workbench.answer().is_some());
    let message = workbench.view.message.as_ref().expect("it is said");
    assert!(message.title.contains("nothing was changed"));
    assert!(
        message.details[0].contains("line 1"),
        "{:?}",
        message.details
    );
}

#[test]
fn a_saved_session_brings_its_regions_and_its_tolerance_back() {
    let mut workbench = workbench();
    done(&mut workbench, |bench| {
        bench.edit(|document| document.divide(4));
    });
    done(&mut workbench, |bench| {
        bench.edit(|document| document.set_tolerance(Some(0.35)));
    });
    assert!(workbench.unsaved());
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("kept.json");
    workbench.execute(|bench| bench.export_as(What::Session, path.clone(), false));
    workbench.receive();
    assert!(!workbench.unsaved(), "{:?}", workbench.view.message);
    let regions = Arc::clone(&workbench.document().regions);
    workbench.execute(|bench| bench.open_file(path.clone()));
    workbench.receive();
    assert_eq!(workbench.document().regions, regions);
    assert_eq!(workbench.document().tolerance_mm, Some(0.35));

    workbench.execute(|bench| bench.export_as(What::Session, path.clone(), false));
    workbench.receive();
    let message = workbench.view.message.as_ref().expect("it is said");
    assert!(message.wrong && message.details[0].contains("exists already"));
}

/// A look at the disk may be under way while the window saves: it compares with what was known before.
#[test]
fn what_this_window_saved_is_not_taken_for_a_change_by_another_program() {
    let mut workbench = workbench();
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("own.json");
    workbench.execute(|bench| bench.export_as(What::Session, path.clone(), true));
    workbench.receive();
    let (before, _) = workbench.derived.on_disk.made().expect("looked at");
    let before = before.clone();
    done(&mut workbench, |bench| {
        bench.edit(|document| document.divide(5));
    });
    workbench.execute(Workbench::save);
    workbench.receive();
    let change = OnDisk {
        path: path.clone(),
        change: FileChange::Changed,
    };
    let looked = Looked {
        change: Some(change),
        missing: Vec::new(),
    };
    workbench.derived.on_disk.take(before, looked);
    assert_eq!(workbench.on_disk(), None);
    // A change that another program made after that is said.
    std::fs::write(&path, "{}").expect("written");
    done(&mut workbench, Workbench::look_at_disk);
    let seen = workbench.on_disk().expect("it is said");
    assert_eq!(seen.change, FileChange::Changed);
}

/// A tick for a file that holds another model's table would be wrong.
#[test]
fn a_step_is_done_for_the_model_that_was_exported_alone() {
    let mut workbench = workbench();
    done(&mut workbench, |bench| bench.identify(None));
    let folder = tempfile::tempdir().expect("a folder");
    workbench.execute(|bench| {
        bench.export_as(
            crate::gui::view::What::Table,
            folder.path().join("table.csv"),
            false,
        );
    });
    workbench.receive();
    assert_eq!(workbench.exported().count(), 1);
    done(&mut workbench, |bench| {
        bench.edit(|document| document.choose_effect("backlash", true));
    });
    done(&mut workbench, |bench| bench.identify(None));
    assert_eq!(workbench.exported().count(), 0);
    workbench.execute(Workbench::undo);
    workbench.receive();
    assert_eq!(workbench.exported().count(), 1);
}

#[test]
fn an_export_writes_the_table_and_what_it_means() {
    let mut workbench = workbench();
    done(&mut workbench, |bench| bench.identify(None));
    workbench.execute(|bench| bench.view.step = Step::Export);
    workbench.receive();
    let made = workbench.export().expect("prepared").expect("possible");
    let table = made.export.reads_as.as_ref().expect("a table");
    let first = table.forward.values()[0];
    assert!((first - 3.0).abs() < 0.05, "add what is missing: {first}");
    assert!(
        made.remainder.rms_mm > 4.5,
        "a joint cannot lengthen a link"
    );
    let folder = tempfile::tempdir().expect("a folder");
    workbench.execute(|bench| {
        bench.export_as(
            crate::gui::view::What::Table,
            folder.path().join("table.csv"),
            false,
        );
    });
    workbench.receive();
    for name in ["table.csv", "table.csv.meta.json"] {
        assert!(folder.path().join(name).exists(), "{name}");
    }
}

#[test]
fn a_robot_that_is_edited_is_seen_at_once_and_undone_in_one_step() {
    let mut workbench = workbench();
    let before = workbench
        .loaded_session()
        .gap_before
        .expect("there are samples")
        .rms_mm;
    let mut form = SetupForm::of(&workbench.loaded_session().session);
    for k in 1..=5 {
        form.robot.tool[0] += f64::from(k);
        workbench.execute(|bench| {
            bench.drag(true);
            bench.edit(|document| document.set_up(&form.clone()));
        });
        workbench.receive();
    }
    workbench.execute(|bench| bench.drag(false));
    let after = workbench
        .loaded_session()
        .gap_before
        .expect("there are samples")
        .rms_mm;
    assert!((after - before).abs() > 1.0);
    assert!(workbench.unsaved());
    assert_eq!(workbench.undoes(), Some("edit robot and instrument"));
    workbench.execute(Workbench::undo);
    assert_eq!(workbench.undoes(), None);
    assert!(!workbench.unsaved());
}

#[test]
fn an_identification_that_was_cancelled_is_not_begun_again_by_itself() {
    let mut workbench = workbench();
    workbench.jobs = Jobs::new(Runner::Threads, Arc::new(|| {}));
    workbench.execute(|bench| bench.identify(None));
    workbench.execute(Workbench::cancel_newest);
    assert!(workbench.is_declined());
    workbench.execute(|bench| bench.view.step = Step::Export);
    assert!(
        workbench.jobs.newest().is_none(),
        "it is not asked for again"
    );
    workbench.execute(|bench| bench.identify(None));
    assert!(workbench.jobs.newest().is_some());
}

#[test]
fn a_search_ends_where_another_session_is_opened() {
    let mut workbench = workbench();
    workbench.jobs = Jobs::new(Runner::Threads, Arc::new(|| {}));
    workbench.execute(Workbench::search);
    assert!(workbench.searching().is_some());
    let session = workbench.loaded_session().session.clone();
    let other = LoadedSession::new(session, Vec::new(), Origin::Imported("other.txt".into()));
    workbench.execute(|bench| bench.replace(|d| d.open(Arc::new(other))));
    assert!(workbench.searching().is_none());
}

#[test]
fn a_search_that_is_stopped_answers_nothing_and_takes_the_place_of_nothing() {
    let mut workbench = workbench();
    workbench.execute(Workbench::search);
    workbench.receive();
    assert!(workbench.diagnosis().is_some());
    workbench.jobs = Jobs::new(Runner::Threads, Arc::new(|| {}));
    workbench.execute(Workbench::search);
    workbench.execute(Workbench::stop_search);
    assert!(workbench.searching().is_none() && workbench.stopped().is_some());
    let diagnosis = workbench.diagnosis().expect("that which was complete");
    assert_eq!(diagnosis.stopped, None);
}

#[test]
fn new_files_belong_beside_what_they_were_made_of() {
    let mut workbench = workbench();
    let folder = tempfile::tempdir().expect("a folder");
    let tracker = folder.path().join("tracker.txt");
    let session = workbench.loaded_session().session.clone();
    let imported = LoadedSession::new(session, Vec::new(), Origin::Imported(tracker));
    workbench.execute(|bench| bench.replace(|d| d.open(Arc::new(imported))));
    let proposed = workbench.proposed_path();
    assert_eq!(proposed.parent(), Some(folder.path()));
    // A bare name means the same folder, not the one that the program was started in.
    workbench.execute(|bench| bench.export_as(What::Session, "column.json".into(), false));
    workbench.receive();
    let saved = folder.path().join("column.json");
    assert!(saved.exists(), "{:?}", workbench.view.message);
    assert_eq!(workbench.proposed_path(), saved);
    let message = workbench.view.message.as_ref().expect("it is said");
    assert_eq!(message.file.as_deref(), Some(&*saved));
    let report = workbench.name_of(What::Report(About::Session));
    let report = workbench.placed(report.as_ref());
    assert_eq!(report.parent(), Some(folder.path()));
}

#[test]
fn excluding_a_sample_keeps_the_sample_and_not_the_session() {
    let mut workbench = workbench();
    let opened = Arc::downgrade(workbench.loaded_session());
    let mut before = Vec::new();
    for sample in 1..=4 {
        done(&mut workbench, |bench| {
            bench.edit(|d| d.exclude(&[sample], true));
        });
        before.push(Arc::downgrade(workbench.loaded_session()));
    }
    let alive = before.iter().filter(|one| one.strong_count() > 0).count();
    assert_eq!(alive, 1, "that which is open");
    assert!(opened.strong_count() > 0, "and that from which it differs");
    // A session that is still held comes back as itself.
    let held = Arc::clone(workbench.loaded_session());
    let excluded = |workbench: &Workbench| {
        let samples = &workbench.loaded_session().session.samples;
        samples.excluded_by_hand()
    };
    for left in [&[1, 2, 3][..], &[1, 2], &[1], &[]] {
        workbench.execute(Workbench::undo);
        assert_eq!(excluded(&workbench), left);
    }
    assert!(std::ptr::eq(
        opened.as_ptr(),
        Arc::as_ptr(workbench.loaded_session())
    ));
    for _ in 0..4 {
        workbench.execute(Workbench::redo);
    }
    assert!(Arc::ptr_eq(&held, workbench.loaded_session()));
    assert_eq!(excluded(&workbench), [1, 2, 3, 4]);
}

#[test]
fn a_preparation_that_was_cancelled_is_not_begun_again_by_itself() {
    let mut workbench = workbench();
    workbench.execute(|bench| bench.identify(None));
    workbench.receive();
    workbench.jobs = Jobs::new(Runner::Threads, Arc::new(|| {}));
    workbench.execute(|bench| bench.view.step = Step::Export);
    assert!(workbench.jobs.newest().is_some());
    workbench.execute(Workbench::cancel_newest);
    assert!(workbench.is_unprepared());
    workbench.execute(|bench| bench.view.fit());
    assert!(
        workbench.jobs.newest().is_none(),
        "it is not asked for again"
    );
    workbench.execute(Workbench::prepare_again);
    assert!(!workbench.is_unprepared() && workbench.jobs.newest().is_some());
}

#[test]
fn the_figures_of_one_format_do_not_stand_under_the_name_of_another() {
    let mut workbench = workbench();
    workbench.execute(|bench| bench.identify(None));
    workbench.execute(|bench| bench.view.step = Step::Export);
    workbench.receive();
    assert!(workbench.export().is_some_and(|made| made.is_ok()));
    workbench.jobs = Jobs::new(Runner::Threads, Arc::new(|| {}));
    let choice = workbench.document().export.clone();
    let mut others = EXPORTERS.iter().filter(|other| other.id != choice.format);
    let format = others.next().expect("there are several").id;
    workbench.execute(|bench| bench.edit(|d| d.choose_export(ExportChoice { format, ..choice })));
    assert!(workbench.export().is_none(), "it is being prepared");
    workbench.execute(Workbench::cancel_newest);
    assert!(workbench.export().is_none() && workbench.is_unprepared());
}
