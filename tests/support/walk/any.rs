//! A command at random, of every kind, sensible or not.

use std::path::PathBuf;
use std::sync::Arc;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::diagnosis::SessionCorrection;
use crate::effects::CATALOGUE;
use crate::export::EXPORTERS;
use crate::gui::core::compensated::CompensationRequest;
use crate::gui::core::document::{Document, ExportChoice, Method};
use crate::gui::core::loaded_session::LoadedSession;
use crate::gui::core::robot_table::RobotTable;
use crate::gui::core::search::term_of;
use crate::gui::core::setup::SetupForm;
use crate::gui::core::simulate::Form;
use crate::gui::import_draft::{Companion, ImportAnswers, ImportDraft, RobotFrom};
use crate::gui::view::{About, NextAction, Sheet, What};
use crate::gui::view::{Preferences, Theme};
use crate::gui::workbench::{Change, Workbench};
use crate::present::units::{AngleUnit, LengthUnit};
use crate::programs::{ExternalAxes, Precedence};
use crate::progress::{Progress, unwatched};
use crate::robots::library;
use crate::sessions::Sigma;
use crate::text::Language;
use crate::units::rad_from_deg;

use super::looks::{chart, chart_of, look, plot, record, seen, way_to_look};

/// Files that the walk opens and writes.
pub(super) struct Files {
    /// Written by the walk: sessions and models.
    pub(super) written: Vec<PathBuf>,
    /// A file that an instrument wrote.
    pub(super) instrument_file: PathBuf,
    /// A session of an arm with six joints.
    pub(super) arm: PathBuf,
    /// A folder to write into.
    pub(super) folder: PathBuf,
}

/// Something that is done to a workbench.
pub(super) struct Deed {
    pub(super) kind: &'static str,
    pub(super) says: String,
    pub(super) change: Change,
    /// The session or model that it writes, if all goes well.
    pub(super) writes: Option<PathBuf>,
}

impl Deed {
    /// The same in the middle of a gesture, or by itself.
    fn while_dragging(self, dragging: bool) -> Self {
        let change = self.change;
        Self {
            change: Box::new(move |bench| {
                bench.drag(dragging);
                change(bench);
            }),
            ..self
        }
    }
}

pub(super) fn deed<T: std::fmt::Debug + Send + 'static>(
    kind: &'static str,
    with: T,
    change: impl FnOnce(&mut Workbench, T) + Send + 'static,
) -> Deed {
    Deed {
        kind,
        says: format!("{kind} {with:?}"),
        change: Box::new(move |bench| change(bench, with)),
        writes: None,
    }
}

impl Files {
    pub(super) fn any(&self, random: &mut ChaCha8Rng) -> PathBuf {
        match random.random_range(0..7) {
            6 => self.arm.clone(),
            0 => self.folder.clone(),
            1 => self.folder.join("there is no such file.json"),
            2 => self.folder.join("damaged.json"),
            3 => self.instrument_file.clone(),
            _ => one_of(random, &self.written)
                .cloned()
                .unwrap_or_else(|| self.folder.join("nothing yet.json")),
        }
    }

    pub(super) fn to_write(&self, random: &mut ChaCha8Rng, ending: &str) -> PathBuf {
        match random.random_range(0..12) {
            0 => self.folder.clone(),
            1 => self.folder.join("no folder").join("a.json"),
            2 => self.folder.join("damaged.json").join("a.json"),
            3 => self.folder.join("without an ending"),
            _ => {
                let number: u8 = random.random_range(0..4);
                self.folder.join(format!("größe {number}.{ending}"))
            }
        }
    }
}

pub(super) fn one_of<'a, T>(random: &mut ChaCha8Rng, all: &'a [T]) -> Option<&'a T> {
    (!all.is_empty()).then(|| &all[random.random_range(0..all.len())])
}

pub(super) fn pick<T: Copy>(random: &mut ChaCha8Rng, all: &[T]) -> T {
    all[random.random_range(0..all.len())]
}

fn angle(random: &mut ChaCha8Rng) -> f64 {
    match random.random_range(0..30) {
        0 => f64::NAN,
        1 => f64::INFINITY,
        2 => 1e300,
        _ => rad_from_deg(random.random_range(-200.0..200.0)),
    }
}

/// A robot that may make no sense.
fn setup(random: &mut ChaCha8Rng, loaded_session: &LoadedSession) -> SetupForm {
    let mut form = SetupForm::of(&loaded_session.session);
    let number = random.random_range(-300.0..300.0);
    let axis = random.random_range(0..3);
    match random.random_range(0..8) {
        0 => form.robot.rows[0].numbers[axis] = number,
        1 => form.robot.rows[0].travel = Some([number, 90.0]),
        2 => form.robot.tool[axis] = number,
        3 => form
            .measured
            .iter_mut()
            .for_each(|m| m.sigma = Some(Sigma::Overall(number))),
        4 => form.robot.rows[0].slides = true,
        5 => form.robot.rows[0].numbers[..3].fill(0.0),
        6 => form.robot.rows[0].travel = None,
        _ => {
            let targets = form.measured.iter_mut().flat_map(|m| &mut m.targets);
            targets
                .take(1)
                .for_each(|target| target.position_mm[axis] = number);
        }
    }
    form
}

fn correction(random: &mut ChaCha8Rng) -> SessionCorrection {
    match random.random_range(0..5) {
        0 => SessionCorrection::ScaleJoint {
            joint: random.random_range(0..2),
            factor: -1.0,
        },
        1 => SessionCorrection::Reorder([1, 2, 0]),
        2 => SessionCorrection::FreeFrame,
        3 => SessionCorrection::TurnHome {
            joint: 0,
            by_rad: 1.0,
        },
        _ => SessionCorrection::Remove((0..random.random_range(0..6)).collect()),
    }
}

/// A change of the document.
fn edit(random: &mut ChaCha8Rng, workbench: &Workbench) -> Deed {
    let loaded_session = workbench.loaded_session();
    let region = random.random_range(0..9);
    match random.random_range(0..40) {
        0 | 1 => deed("Divide", random.random_range(0..12), |bench, it| {
            bench.edit(|d| d.divide(it));
        }),
        2..=8 => deed("MoveBoundary", (region, angle(random)), |bench, it| {
            bench.edit(|d| d.move_boundary(it.0, it.1));
        }),
        9..=11 => deed("Split", region, |bench, it| {
            bench.edit(|d| d.split(it));
        }),
        12 | 13 => deed("Join", region, |bench, it| {
            bench.edit(|d| d.join(it));
        }),
        14 | 15 => deed("Delete", region, |bench, it| {
            bench.edit(|d| d.delete(it));
        }),
        16 | 17 => {
            let name = ["", "1", "2", "Ost", "  x ", "ß·∆"];
            deed(
                "Rename",
                (region, pick(random, &name).to_owned()),
                |bench, it| bench.edit(|d| d.rename(it.0, &it.1)),
            )
        }
        18 => deed("RegionsOfSession", (), |bench, ()| {
            bench.edit(Document::regions_of_session);
        }),
        19 => deed("KeepRegions", (), |bench, ()| {
            bench.replace(Document::keep_regions);
        }),
        20 => deed(
            "Method",
            pick(random, &[Method::Exact, Method::Regional]),
            |bench, it| bench.edit(|d| d.choose_method(it)),
        ),
        21 | 22 => {
            let effect = CATALOGUE[random.random_range(0..4)].about().id;
            deed("Effect", (effect, random.random()), |bench, it| {
                bench.edit(|d| d.choose_effect(it.0, it.1));
            })
        }
        23 | 24 => {
            let tolerances = [None, Some(0.3), Some(0.0), Some(-1.0), Some(f64::NAN)];
            deed("Tolerance", pick(random, &tolerances), |bench, it| {
                bench.edit(|d| d.set_tolerance(it));
            })
        }
        25 | 26 => deed(
            "Export",
            ExportChoice {
                format: pick(random, EXPORTERS).id,
                step: random
                    .random::<bool>()
                    .then(|| random.random_range(-1.0..10.0)),
                joint: random.random_range(0..2),
                ..ExportChoice::usual(&loaded_session.session.robot)
            },
            |bench, it| bench.edit(|d| d.choose_export(it)),
        ),
        27 | 28 => deed("Setup", setup(random, loaded_session), |bench, it| {
            bench.edit(|d| d.set_up(&it));
        }),
        29 => deed("Correct", vec![correction(random)], |bench, it| {
            bench.edit(|d| d.correct(&it));
        }),
        35 => deed(
            "Exclude",
            (
                (0..random.random_range(0..60)).collect::<Vec<_>>(),
                random.random(),
            ),
            |bench, it| bench.edit(|d| d.exclude(&it.0, it.1)),
        ),
        30 => {
            // Nothing found is added as well: nothing changes then.
            let found = workbench.diagnosis().into_iter();
            let terms = found.flat_map(|d| d.found.iter().filter_map(|f| term_of(d, f)));
            deed("Add", terms.collect::<Vec<_>>(), |bench, it| {
                bench.edit(|d| d.add(&it));
            })
        }
        31 | 32 => deed(
            "Switch",
            (random.random_range(0..3), random.random()),
            |bench, it| bench.edit(|d| d.switch(&[it.0], it.1)),
        ),
        33 | 34 => deed(
            "IdentifyBy",
            Some(pick(random, &[Method::Exact, Method::Regional])),
            super::super::Workbench::identify,
        ),
        _ => deed("Identify", (), |bench, ()| bench.identify(None)),
    }
}

fn then(random: &mut ChaCha8Rng, files: &Files) -> NextAction {
    match random.random_range(0..6) {
        0 => NextAction::Leave,
        1 | 2 => NextAction::Open(files.any(random)),
        3 => NextAction::Simulate(form(random)),
        _ => NextAction::Example(random.random_range(0..5)),
    }
}

fn form(random: &mut ChaCha8Rng) -> Form {
    Form {
        poses: random.random_range(0..12),
        noise_mm: pick(random, &[0.0, 0.03, -1.0]),
        ..Form::default()
    }
}

/// A foreign file as it stands in its sheet, and an answer about it.
fn any_instrument_file(
    random: &mut ChaCha8Rng,
    files: &Files,
    workbench: &Workbench,
) -> Box<ImportDraft> {
    let foreign = {
        let progress = Progress::new(&unwatched);
        ImportDraft::of(&files.instrument_file, progress.whole()).expect("it is a table")
    };
    let mut foreign = foreign.expect("the walk has written it");
    foreign.answers = any_answers(random, files, workbench);
    Box::new(foreign)
}

fn any_answers(random: &mut ChaCha8Rng, files: &Files, workbench: &Workbench) -> ImportAnswers {
    let mut answers = ImportAnswers::default();
    let path = |random: &mut ChaCha8Rng| files.any(random).display().to_string();
    answers.robot = match random.random_range(0..6) {
        0 => RobotFrom::File,
        1 => RobotFrom::Here(Box::new(workbench.loaded_session().session.robot.clone())),
        2 => RobotFrom::Typed(Box::new(RobotTable::one_axis())),
        3 => RobotFrom::Example(random.random_range(0..4)),
        4 => {
            let all = crate::robots::library();
            let one = &all[random.random_range(0..all.len())];
            RobotFrom::Listed(Box::new(one.robot.clone()))
        }
        _ => RobotFrom::Open,
    };
    if answers.robot == RobotFrom::File {
        answers.choose(Companion::Robot, path(random));
    }
    if random.random_range(0..3) == 0 {
        answers.reading.columns = vec!["q1_deg".to_owned(), "x_mm".to_owned(), "y_mm".to_owned()];
    }
    if random.random_range(0..6) == 0 {
        answers.choose(Companion::Commands, path(random));
        answers.clock_offset_s = Some(angle(random));
    }
    if random.random_range(0..6) == 0 {
        answers.choose(Companion::Reference, path(random));
        answers.choose(Companion::Targets, path(random));
    }
    answers
}

fn what(random: &mut ChaCha8Rng) -> (What, &'static str) {
    match random.random_range(0..10) {
        9 => (What::Targets, "csv"),
        0 | 1 => (What::Table, "csv"),
        2..=4 => (What::Model, "json"),
        5 => (What::Poses, "csv"),
        6 => (What::Report(About::Model), "html"),
        7 => (What::Report(About::Model), "pdf"),

        _ => {
            let plot = plot(random);
            (What::Picture(plot), plot.ending())
        }
    }
}

fn sheet(random: &mut ChaCha8Rng, files: &Files, workbench: &Workbench) -> Option<Sheet> {
    let path = || files.folder.join("typed.json").display().to_string();
    Some(match random.random_range(0..12) {
        at @ 0..2 => Sheet::Path {
            what: if at == 0 {
                What::Session
            } else {
                what(random).0
            },
            path: path(),
            replace: random.random(),
        },
        2 => Sheet::Simulate(form(random)),
        3 => Sheet::Unsaved(then(random, files)),
        4 => Sheet::Overwrite(files.any(random)),
        5 => Sheet::Import(any_instrument_file(random, files, workbench)),
        6 => Sheet::Recovery,
        7 => Sheet::Preferences,
        8 => Sheet::About,
        9 => Sheet::Robots,
        10 => Sheet::set_up(SetupForm {
            robot: typed_robot(random),
            measured: None,
        }),
        _ => return None,
    })
}

/// A robot of the library as a table, with a number that may be none.
fn typed_robot(random: &mut ChaCha8Rng) -> RobotTable {
    let mut table = RobotTable::of(&pick(random, &library().iter().collect::<Vec<_>>()).robot);
    table.tool[0] = pick(random, &[0.0, 50.0, f64::NAN, 1e300]);
    if random.random() {
        table.remove(random.random_range(0..8));
    }
    table
}

fn draft(random: &mut ChaCha8Rng, workbench: &Workbench) -> Deed {
    let drafted = setup(random, workbench.loaded_session());
    deed("Draft", drafted, |bench, it| {
        bench.show_sheet(Some(Sheet::set_up(it)));
    })
}

fn own_robot(random: &mut ChaCha8Rng, workbench: &Workbench) -> Deed {
    let mut names = workbench.typed_robots().iter().map(|own| own.name.clone());
    match names.next_back().filter(|_| random.random()) {
        Some(name) => deed("ForgetRobot", name, |bench, it| bench.forget_robot(&it)),
        None => deed("KeepRobot", (typed_robot(random), false), |bench, it| {
            bench.keep_robot(it.0, it.1);
        }),
    }
}

fn preferences(random: &mut ChaCha8Rng) -> Preferences {
    let languages = [
        None,
        Some(Language::English),
        Some(Language::German),
        Some(Language::Chinese),
        Some(Language::Long),
        Some(Language::Marked),
    ];
    Preferences {
        language: pick(random, &languages),
        length: pick(
            random,
            &[
                LengthUnit::Millimetre,
                LengthUnit::Micrometre,
                LengthUnit::Inch,
            ],
        ),
        angle: pick(
            random,
            &[
                AngleUnit::Degree,
                AngleUnit::Radian,
                AngleUnit::Milliradian,
                AngleUnit::ArcSecond,
            ],
        ),
        decimals: random.random::<bool>().then(|| random.random()),
        comma: [None, Some(false), Some(true)][random.random_range(0..3)],
        theme: pick(random, &[Theme::System, Theme::Light, Theme::Dark]),
        zoom: random.random_range(-1.0..9.0),
    }
}

/// Of files that hold no targets as well, under loads that are none.
fn compensation(random: &mut ChaCha8Rng, files: &Files) -> Deed {
    deed(
        "Compensate",
        CompensationRequest {
            load_kg: angle(random),
            measured_frame: random.random(),
            external: pick(
                random,
                &[
                    ExternalAxes::Asked,
                    ExternalAxes::Other,
                    ExternalAxes::CarryRobot,
                ],
            ),
            tool: pick(
                random,
                &[
                    Precedence::Unsettled,
                    Precedence::Model,
                    Precedence::Program,
                ],
            ),
            frame: pick(
                random,
                &[
                    Precedence::Unsettled,
                    Precedence::Model,
                    Precedence::Program,
                ],
            ),
            ..CompensationRequest::new(files.any(random))
        },
        super::super::Workbench::compensate,
    )
}

/// A command of any kind but those that ask the system.
#[allow(clippy::too_many_lines, reason = "one line for each kind")]
pub(super) fn command(random: &mut ChaCha8Rng, workbench: &Workbench, files: &Files) -> Deed {
    match random.random_range(0..160) {
        0..=29 => edit(random, workbench).while_dragging(false),
        30..=49 => edit(random, workbench).while_dragging(true),
        50..=55 | 150 => deed("EndDrag", (), |bench, ()| bench.drag(false)),
        56..=63 => deed("Undo", (), |bench, ()| bench.undo()),
        64..=67 => deed("Redo", (), |bench, ()| bench.redo()),
        68 if random.random() => {
            let several = random.random_range(0..3);
            deed(
                "Drop",
                (0..several).map(|_| files.any(random)).collect::<Vec<_>>(),
                super::super::Workbench::drop_files,
            )
        }
        68 => deed("OpenFile", files.any(random), |bench, it| {
            bench.open_file(it);
        }),
        69 => deed("Say", any_answers(random, files, workbench), |bench, it| {
            bench.change_draft(|draft| draft.answers = it);
        }),
        70 if random.random() => deed("ConfirmColumns", (), |bench, ()| {
            bench.change_draft(ImportDraft::confirm);
        }),
        70 => deed("Import", (), |bench, ()| bench.import()),
        71 => deed(
            "OpenExample",
            NextAction::Example(random.random_range(0..5)),
            super::super::Workbench::ask_then,
        ),
        72 | 73 => deed("Do", then(random, files), super::super::Workbench::go),
        74 => match (workbench.file(), workbench.at_risk().session) {
            // Otherwise it asks the system.
            (Some(_), true) => deed("SaveThen", then(random, files), |bench, it| {
                bench.save_then(it);
            }),
            _ => deed("no_sheet", (), |bench, ()| bench.show_sheet(None)),
        },
        75..=77 if workbench.file().is_some() || workbench.loaded_session().is_empty() => {
            deed("Save", (), |bench, ()| bench.save())
        }
        78 => deed("SaveDespite", (), |bench, ()| bench.save_despite()),
        79 => deed("Reload", (), |bench, ()| bench.reload()),
        80 if random.random() => compensation(random, files),
        80 => deed("KeepMine", (), |bench, ()| bench.keep_mine()),
        81 | 82 => deed(
            "UseRecent",
            files.any(random),
            super::super::Workbench::use_recent,
        ),
        83 => deed("Left Restore", (), |bench, ()| bench.restore()),
        84 if random.random_range(0..4) == 0 => {
            deed("Left Discard", (), |bench, ()| bench.discard_left_behind())
        }
        84 | 85 => deed("KeepRecovery", (), |bench, ()| bench.keep_recovery()),
        86 => deed("LookAtDisk", (), |bench, ()| bench.look_at_disk()),
        87..=90 => {
            let path = files.to_write(random, "json");
            let deed = deed("SaveAs", (path.clone(), random.random()), |bench, it| {
                bench.export_as(What::Session, it.0, it.1);
            });
            Deed {
                writes: Some(path),
                ..deed
            }
        }
        91..=95 => {
            let (what, ending) = what(random);
            let path = files.to_write(random, ending);
            let writes = (what == What::Model).then(|| path.clone());
            let deed = deed("ExportTo", (what, path, random.random()), |bench, it| {
                bench.export_as(it.0, it.1, it.2);
            });
            Deed { writes, ..deed }
        }
        96 => deed("Adapt", (), |bench, ()| bench.adapt()),
        97..=103 => deed("Stop Import", (), |bench, ()| bench.cancel_look()),
        // It takes its time.
        104 if random.random_range(0..5) == 0 && workbench.loaded_session().len() < 60 => {
            deed("Search", (), |bench, ()| bench.search())
        }
        104 => deed("Stop Search", (), |bench, ()| bench.stop_search()),
        105 => deed("Simulate", form(random), |bench, it| {
            bench.ask_then(NextAction::Simulate(it));
        }),
        106 if random.random() => deed("Stop Dialog", (), |bench, ()| bench.stop_asking()),
        106 => deed("Stop Newest", (), |bench, ()| bench.cancel_newest()),
        at @ 107..=133 => seen(random, workbench, at),
        152 | 153 => chart_of(random),
        154 => way_to_look(random),
        134 | 135 | 151 | 156 | 157 => look(random),
        155 => deed("Results", Some(random.random()), |bench, it| {
            bench.view.results = it;
        }),
        136..=138 => deed(
            "Prefer",
            preferences(random),
            super::super::Workbench::prefer,
        ),
        139 if random.random() => record(random, workbench, files),
        139..=142 => draft(random, workbench),
        143..=147 => deed("Sheet", sheet(random, files, workbench), |bench, it| {
            bench.show_sheet(it);
        }),
        148 if random.random_range(0..4) == 0 => {
            deed("Leave", (), |bench, ()| bench.ask_then(NextAction::Leave))
        }
        75..=77 | 148 => deed("Dismiss", (), |bench, ()| bench.view.message = None),
        149 => own_robot(random, workbench),
        158 if random.random_range(0..8) == 0 => {
            deed("Prepare", (), |bench, ()| bench.prepare_again())
        }
        158 => deed("CopyNumbers", chart(random), |bench, it| {
            bench.copy_numbers(it, drop);
        }),
        _ => {
            // A session beside which models and regions make sense again.
            let files = [Arc::clone(workbench.loaded_session())];
            let single = files[0].single_revolute() && files[0].len() > 12;
            if single {
                deed("EndDrag", (), |bench, ()| bench.drag(false))
            } else {
                deed("Do", NextAction::Simulate(form(random)), |bench, it| {
                    bench.go(it);
                })
            }
        }
    }
}
