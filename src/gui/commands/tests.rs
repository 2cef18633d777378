//! Commands, one by one and thousands at random.

use std::sync::Arc;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{Command, Workbench};
use crate::gui::boundaries::{NARROWEST_RAD, boundaries};

use crate::diagnosis::Mend;
use crate::diagnostic::{Place, Severity};
use crate::effects::CATALOGUE;
use crate::gui::document::{ExportChoice, Method};
use crate::gui::edit::Edit;
use crate::gui::preferences::Preferences;
use crate::gui::setup::{SetupForm, SigmaForm};
use crate::gui::simulate::Form;
use crate::gui::subject::Component;
use crate::gui::subject::Subject;
use crate::gui::tasks::{Runner, Tasks};
use crate::gui::testing::workbench;
use crate::gui::view::{Plane, Step, Then};
use crate::kinematics::JointKind;
use crate::units::rad_from_deg;

fn done(workbench: &mut Workbench, edit: Edit) {
    workbench.execute(Command::Edit(edit));
    workbench.receive();
}

#[test]
fn the_exact_fit_finds_what_the_simulation_hid() {
    let mut workbench = workbench();
    done(&mut workbench, Edit::Effect("backlash", true));
    done(&mut workbench, Edit::Identify);
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
fn dragging_a_boundary_identifies_by_region_and_is_undone_in_one_step() {
    let mut workbench = workbench();
    for deg in [1.0, 3.0, 7.0] {
        let edit = Edit::MoveBoundary(3, rad_from_deg(deg));
        workbench.execute(Command::Drag(edit));
        workbench.receive();
        assert!(workbench.settled(), "the answer follows at once");
        let outcome = workbench.answer().expect("by region");
        assert_eq!(outcome.identification.method, "regional");
    }
    workbench.execute(Command::EndDrag);
    assert_eq!(workbench.undoes(), Some("move boundary"));
    workbench.execute(Command::Undo);
    let all = boundaries(&workbench.document().regions);
    assert!(all[3].at_rad.abs() < 1e-12);
    assert_eq!(workbench.document().method, Method::Exact);
    assert_eq!(workbench.undoes(), None);
}

#[test]
fn undo_brings_the_session_before_back() {
    let mut workbench = workbench();
    let first = Arc::clone(workbench.subject());
    workbench.execute(Command::OpenExample(1));
    workbench.receive();
    assert_eq!(workbench.subject().len(), 30);
    workbench.execute(Command::Undo);
    assert!(Arc::ptr_eq(&first, workbench.subject()));
}

#[test]
fn an_answer_to_another_question_is_not_shown() {
    let mut workbench = workbench();
    done(&mut workbench, Edit::Identify);
    assert!(workbench.answer().is_some());
    workbench.execute(Command::OpenExample(1));
    workbench.receive();
    assert!(workbench.answer().is_none(), "nothing is identified yet");
}

#[test]
fn what_cannot_be_done_is_said_and_changes_nothing() {
    let mut workbench = workbench();
    let before = workbench.document().clone();
    done(&mut workbench, Edit::Divide(0));
    assert_eq!(*workbench.document(), before);
    let message = workbench.view().message.as_ref().expect("it is said");
    assert!(message.wrong && message.details[0].contains("0 regions"));
    assert_eq!(workbench.undoes(), None);
}

#[test]
fn a_wrong_file_leaves_everything_as_it_was() {
    let mut workbench = workbench();
    done(&mut workbench, Edit::Identify);
    let before = workbench.document().clone();
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("wrong.json");
    std::fs::write(&path, "{ \"format\": \"truepose-session/1\", ").expect("it can be written");
    workbench.execute(Command::OpenFile(path));
    workbench.receive();
    assert_eq!(*workbench.document(), before);
    assert!(workbench.answer().is_some());
    let message = workbench.view().message.as_ref().expect("it is said");
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
    done(&mut workbench, Edit::Divide(4));
    done(&mut workbench, Edit::Tolerance(Some(0.35)));
    assert!(workbench.unsaved());
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("kept.json");
    workbench.execute(Command::SaveAs {
        path: path.clone(),
        replace: false,
    });
    workbench.receive();
    assert!(!workbench.unsaved(), "{:?}", workbench.view().message);
    let regions = Arc::clone(&workbench.document().regions);
    workbench.execute(Command::OpenFile(path.clone()));
    workbench.receive();
    assert_eq!(workbench.document().regions, regions);
    assert_eq!(workbench.document().tolerance_mm, Some(0.35));

    workbench.execute(Command::SaveAs {
        path,
        replace: false,
    });
    workbench.receive();
    let message = workbench.view().message.as_ref().expect("it is said");
    assert!(message.wrong && message.details[0].contains("exists already"));
}

#[test]
fn an_export_writes_the_table_and_what_it_means() {
    let mut workbench = workbench();
    done(&mut workbench, Edit::Identify);
    workbench.execute(Command::GoTo(Step::Export));
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
    workbench.execute(Command::ExportTo {
        what: crate::gui::tasks::What::Table,
        path: folder.path().join("table.csv"),
        replace: false,
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
        .subject()
        .gap_before
        .expect("there are samples")
        .rms_mm;
    let mut form = SetupForm::of(&workbench.subject().session);
    for k in 1..=5 {
        form.tool_mm[0] += f64::from(k);
        workbench.execute(Command::Drag(Edit::Setup(Box::new(form.clone()))));
        workbench.receive();
    }
    workbench.execute(Command::EndDrag);
    let after = workbench
        .subject()
        .gap_before
        .expect("there are samples")
        .rms_mm;
    assert!((after - before).abs() > 1.0);
    assert!(workbench.unsaved());
    assert_eq!(workbench.undoes(), Some("edit robot and instrument"));
    workbench.execute(Command::Undo);
    assert_eq!(workbench.undoes(), None);
    assert!(!workbench.unsaved());
}

#[test]
fn an_identification_that_was_cancelled_is_not_begun_again_by_itself() {
    let mut workbench = workbench();
    workbench.tasks = Tasks::new(Runner::Threads, Arc::new(|| {}));
    workbench.execute(Command::Edit(Edit::Identify));
    workbench.execute(Command::Cancel);
    assert!(workbench.is_declined());
    workbench.execute(Command::GoTo(Step::Export));
    assert!(workbench.tasks.newest().is_none(), "nobody asked again");
    workbench.execute(Command::Edit(Edit::Identify));
    assert!(workbench.tasks.newest().is_some());
}

/// What holds after every command.
fn consistent(workbench: &Workbench) {
    let document = workbench.document();
    let samples = workbench.subject().len();
    let view = workbench.view();
    let samples_shown = [view.hovered, view.selected].into_iter().flatten();
    for sample in samples_shown.chain(view.marked.iter().copied()) {
        assert!(sample < samples);
    }
    for region in document.regions.iter() {
        let width = region.to_rad - region.from_rad;
        assert!(width >= NARROWEST_RAD * (1.0 - 1e-9), "{region:?}");
    }
    let mut sorted: Vec<_> = document.regions.iter().collect();
    sorted.sort_by(|a, b| a.from_rad.total_cmp(&b.from_rad));
    for pair in sorted.windows(2) {
        assert!(pair[0].to_rad <= pair[1].from_rad + 1e-9, "{pair:?}");
    }
    let mut names: Vec<_> = document.regions.iter().map(|r| &r.name).collect();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), document.regions.len(), "names are unique");
    if let Some(answer) = workbench.answer() {
        assert_eq!(answer.lengths_mm.len(), samples);
    }
    assert!((0.0..=1.0).contains(&view.blend));
    assert!(view.preferences == view.preferences.sound());
    let errors = workbench
        .subject()
        .session
        .robot
        .problems(&Place::default());
    assert!(
        errors.iter().all(|d| d.severity != Severity::Error),
        "{errors:?}"
    );
}

/// A robot that may make no sense.
fn any_setup(random: &mut ChaCha8Rng, subject: &Subject) -> SetupForm {
    let mut form = SetupForm::of(&subject.session);
    let number = random.random_range(-300.0..300.0);
    let axis = random.random_range(0..3);
    match random.random_range(0..7) {
        0 => form.joints[0].axis[axis] = number,
        1 => form.joints[0].limits = Some([number, 90.0]),
        2 => form.tool_mm[axis] = number,
        3 => form.sigma = SigmaForm::One(number),
        4 => form.joints[0].kind = JointKind::Prismatic,
        5 => form.joints[0].axis = [0.0; 3],
        _ => form.targets[0].position_mm[axis] = number,
    }
    form
}

fn any_mend(random: &mut ChaCha8Rng) -> Mend {
    match random.random_range(0..5) {
        0 => Mend::ScaleJoint {
            joint: random.random_range(0..2),
            factor: -1.0,
        },
        1 => Mend::Reorder([1, 2, 0]),
        2 => Mend::FreeFrame,
        3 => Mend::TurnHome {
            joint: 0,
            by_rad: 1.0,
        },
        _ => Mend::Remove((0..random.random_range(0..6)).collect()),
    }
}

fn any_command(random: &mut ChaCha8Rng, subject: &Subject) -> Command {
    let effect = CATALOGUE[random.random_range(0..4)].about().id;
    let angle = rad_from_deg(random.random_range(-200.0..200.0));
    let boundary = random.random_range(0..9);
    match random.random_range(0..40) {
        26 => Command::Edit(Edit::Setup(Box::new(any_setup(random, subject)))),
        27 => Command::Drag(Edit::Setup(Box::new(any_setup(random, subject)))),
        28 => Command::Edit(Edit::Mend(vec![any_mend(random)])),
        29 => Command::Mark((0..random.random_range(0..50)).collect()),
        30 => Command::Prefer(Preferences {
            decimals: Some(random.random()),
            zoom: random.random_range(-1.0..9.0),
            decimal_comma: random.random(),
            ..Preferences::default()
        }),
        31 => Command::Follow(random.random()),
        32 => Command::Do(Then::Example(random.random_range(0..4))),
        33 => Command::OpenExample(random.random_range(0..4)),
        34 => Command::Sheet(None),
        35 => Command::Reload,
        36 => Command::LookAtDisk,
        37 => Command::Cancel,
        38 => Command::KeepMine,
        39 => Command::Restore(random.random_range(0..2)),
        0 => Command::Edit(Edit::Divide(random.random_range(0..9))),
        1 => Command::Edit(Edit::MoveBoundary(boundary, angle)),
        2..=5 => Command::Drag(Edit::MoveBoundary(boundary, angle)),
        6 => Command::EndDrag,
        7 => Command::Edit(Edit::Split(random.random_range(0..7))),
        8 => Command::Edit(Edit::Join(random.random_range(0..7))),
        9 => Command::Edit(Edit::Rename(
            random.random_range(0..7),
            random.random_range(0..9).to_string(),
        )),
        10 => Command::Edit(Edit::Method(Method::Exact)),
        11 => Command::Edit(Edit::Method(Method::Regional)),
        12 => Command::Edit(Edit::Effect(effect, random.random())),
        13 => Command::Edit(Edit::Tolerance(random.random::<bool>().then_some(0.3))),
        14 => Command::Edit(Edit::Identify),
        15 => Command::Edit(Edit::RegionsOfSession),
        16 | 17 => Command::Undo,
        18 => Command::Redo,
        19 => Command::GoTo(Step::ALL[random.random_range(0..Step::ALL.len())]),
        20 => Command::Look(Plane::ALL[random.random_range(0..3)]),
        21 => Command::Blend(random.random_range(-1.0..2.0)),
        22 => Command::Component(Component::ALL[random.random_range(0..7)]),
        23 => Command::Select(Some(random.random_range(0..40))),
        24 => Command::Edit(Edit::Export(ExportChoice {
            step: random
                .random::<bool>()
                .then_some(random.random_range(-1.0..10.0)),
            joint: random.random_range(0..2),
            ..ExportChoice::default()
        })),
        _ if random.random_range(0..4) == 0 => Command::Simulate(Form {
            step_deg: random.random_range(10.0..60.0),
            both_ways: random.random(),
            ..Form::default()
        }),
        _ => Command::Hover(Some(random.random_range(0..40))),
    }
}

#[test]
fn thousands_of_commands_at_random_leave_a_consistent_workbench() {
    for seed in 0..4 {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut workbench = workbench();
        workbench.execute(Command::Simulate(Form {
            step_deg: 15.0,
            ..Form::default()
        }));
        workbench.receive();
        for _ in 0..700 {
            let subject = Arc::clone(workbench.subject());
            workbench.execute(any_command(&mut random, &subject));
            workbench.receive();
            consistent(&workbench);
        }
        // All the way back and forth: the same document, and the answer that belongs to it.
        workbench.execute(Command::EndDrag);
        let last = workbench.document().clone();
        let mut steps = 0;
        while workbench.undoes().is_some() {
            workbench.execute(Command::Undo);
            workbench.receive();
            consistent(&workbench);
            steps += 1;
        }
        for _ in 0..steps {
            workbench.execute(Command::Redo);
            workbench.receive();
        }
        assert_eq!(*workbench.document(), last, "seed {seed}");
        assert!(workbench.settled());
    }
}
