//! What is written beside the session: tables, models and measuring lists, reports and pictures, files
//! of targets that the shown model corrects. What they are called, and how they are written.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::ColorImage;

use crate::compensation::decision::FittedErrors;
use crate::export::find;
use crate::gui::cache::{PreviewRequest, StandardsFigures};
use crate::gui::core::compensated::{Compensated, CompensationRequest, MOST_KG};
use crate::gui::core::disk::name_of;
use crate::gui::core::document::plain;
use crate::gui::core::search::Search;
use crate::gui::files::writing::{self, Made, Replace, Source};
use crate::gui::jobs::{Kind, Watch};
use crate::gui::view::{About, Message, Plot, Sheet, Step, What};
use crate::gui::{charts, files};
use crate::pipeline::measuring_list;
use crate::report::exported::sidecar_of;
use crate::report::svg::svg_file;
use crate::robots::named;
use crate::sessions::{robot_document, samples_path};

use super::{Exported, Workbench};

impl Workbench {
    /// What an export's file is called unless the user says otherwise.
    pub(crate) fn name_of(&self, what: What) -> String {
        let document = self.document();
        let session = &document.loaded_session.session.name;
        match what {
            What::Session => self.proposed_path().display().to_string(),
            What::Table => document.export.file_name(session),
            What::Model => format!("{}.model.json", plain(session)),
            What::Poses => format!("{}-next-poses.csv", plain(session)),
            What::Report(About::Session) => format!("{}-report.html", plain(session)),
            What::Report(About::Model) => format!("{}-model-report.html", plain(session)),
            What::Picture(plot) => {
                let (session, name) = (plain(session), plain(plot.name()));
                format!("{session}-{name}.{}", plot.ending())
            }
            What::Robot(id) => format!("{id}.json"),
            What::TypedRobot => {
                let table = self.typed_robots().first();
                format!("{}.json", plain(table.map_or("", |table| &table.name)))
            }
            What::Targets => {
                let path = self.compensated().map(Compensated::proposed_path);
                path.unwrap_or_default().display().to_string()
            }
        }
    }

    /// What is exported by this name: `table`, `model`, `poses`, `report`, `report of the model` or `targets`; a plot
    /// by its own; `data of` a chart.
    pub(crate) fn export_named(name: &str) -> Option<What> {
        Some(match name {
            "table" => What::Table,
            "model" => What::Model,
            "poses" => What::Poses,
            "report" => What::Report(About::Session),
            "report of the model" => What::Report(About::Model),
            "targets" => What::Targets,
            "workspace" => What::Picture(Plot::Workspace),
            _ => What::Picture(Plot::Chart(charts::find(name)?.id)),
        })
    }

    /// The name under which the table that is chosen was saved last: what is to be entered in the controller names this
    /// file from then on.
    pub(super) fn saved_as(&self) -> Option<String> {
        let (session, choice) = (self.loaded_session(), &self.document().export);
        let ending = find(choice.format)?.extension;
        let is_it = |one: &&Exported| {
            one.of.loaded_session.lineage == session.lineage
                && one.choice == *choice
                && one.path.extension().is_some_and(|e| e == ending)
        };
        let saved = self.file_state.exported.iter().rfind(is_it)?;
        Some(saved.path.file_name()?.to_str()?.to_owned())
    }

    /// Writes an export to the file that was typed; whether one that is there may be replaced.
    pub(crate) fn export_as(&mut self, what: What, path: PathBuf, replace: bool) {
        if self.needs_picture(what) {
            return self.wait_for_picture(move |bench| bench.export_as(what, path, replace));
        }
        self.view.sheet = None;
        let path = self.placed(&path);
        if let Some(write) = self.prepared(what) {
            write(self, path, replace);
        }
    }

    /// An export, once it is known where to: all that goes into it is taken now. Where there is nothing to be
    /// written, that is said.
    pub(super) fn prepared(&mut self, what: What) -> Option<Write> {
        self.write_of(what).unwrap_or_else(|first| {
            self.complain(say!("There is nothing to export yet"), [first]);
            None
        })
    }

    /// What writes it, or what to do first.
    fn write_of(&mut self, what: What) -> Result<Option<Write>, &'static str> {
        Ok(match what {
            What::Session => {
                self.measured()?;
                let document = Arc::clone(self.history.present());
                Some(Box::new(move |bench: &mut Self, path, replace| {
                    let replacing = [Replace::Nothing, Replace::Named][usize::from(replace)];
                    bench.save_document(document, &path, replacing);
                }))
            }
            What::Report(about) => Some(self.report(about)?),
            What::Picture(plot) => self.picture(plot),

            What::Targets => Some(self.targets()?),
            What::Robot(id) => named(id).ok().map(|one| list(robot_document(&one.robot))),
            What::TypedRobot => {
                let table = self.typed_robots().first();
                table.and_then(|table| Some(list(robot_document(&table.robot().ok()?))))
            }
            What::Poses => {
                let diagnosis = self.diagnosis().ok_or(say!("Run the diagnosis first"))?;
                let robot = &self.loaded_session().session.robot;
                let poses = measuring_list(&diagnosis.next_poses, robot);
                Some(list(poses))
            }
            What::Table | What::Model => Some(self.table_or_model(what)?),
        })
    }

    fn measured(&self) -> Result<(), &'static str> {
        if self.loaded_session().is_empty() {
            return Err(say!("Open a session that was measured on this robot"));
        }
        Ok(())
    }

    /// From what is shown, but under the name that is chosen.
    fn table_or_model(&self, what: What) -> Result<Write, &'static str> {
        let identified = self.shown_outcome();
        let identified = identified.ok_or(say!("Identify the robot first"))?;
        let choice = self.document().export.clone();
        let question = self.question().ok_or(say!("Identify the robot first"))?;
        let inputs = choice.reference.iter().cloned().collect();
        let wanted = PreviewRequest {
            identified,
            choice: choice.clone(),
            name: None,
        };
        let make = move |path: &Path, _: &Watch| {
            Ok((writing::documents(&wanted, what, path)?, Vec::new()))
        };
        let then = move |bench: &mut Self, message| bench.take_exported(message, question, choice);
        Ok(later(inputs, make, then))
    }

    /// Everything that the open session, its model and its tables stand in: no paper replaces it.
    pub(super) fn inputs(&self) -> Vec<PathBuf> {
        let files = self.loaded_session().files.iter();
        let mut inputs: Vec<PathBuf> = files.map(|f| f.path.clone()).collect();
        if let Some(file) = self.file() {
            inputs.extend([file.to_path_buf(), samples_path(file)]);
        }
        let known = self.place().into_iter().flat_map(|place| &place.files);
        inputs.extend(known.map(|known| known.path.clone()));
        let given = self.document().loaded_model.as_ref();
        inputs.extend(given.map(|given| given.path.clone()));
        for one in &self.file_state.exported {
            inputs.extend([one.path.clone(), sidecar_of(&one.path)]);
        }
        inputs
    }

    fn report(&self, about: About) -> Result<Write, &'static str> {
        let in_use = self.shown_outcome();
        let source = if about == About::Model {
            Source::Model(in_use.ok_or(say!("Identify the robot first"))?)
        } else {
            self.measured()?;
            let answered = |search: &&Arc<Search>| search.answer.is_ok();
            let searched = self.search_of_this().filter(answered).cloned();
            Source::Session(Arc::clone(self.history.present()), searched, in_use)
        };
        let stated = self.stated();
        let tables: Vec<PathBuf> = self.exported().cloned().collect();
        let make = move |path: &Path, watch: &Watch| {
            writing::report(&source, (&stated, &tables), path, watch)
        };
        Ok(later(self.inputs(), make, Self::take_written))
    }

    /// A chart as a drawing; the workspace as it was seen.
    fn picture(&mut self, plot: Plot) -> Option<Write> {
        let inputs = self.inputs();
        let make: Box<dyn FnOnce() -> Result<Vec<u8>, String> + Send> = match plot {
            Plot::Workspace => {
                let image = self.picture.take()?;
                Box::new(move || files::png(&image))
            }
            Plot::Chart(chart) => {
                let drawn = self.on_paper(chart)?;
                Box::new(move || {
                    drawn().map(|(chart, title)| svg_file(&chart, &title).into_bytes())
                })
            }
        };
        let make = move |path: &Path, _: &Watch| writing::picture(make, path, plot.ending());
        Some(later(inputs, make, Self::take_written))
    }

    /// Whether it shows the workspace, of which there is no picture yet.
    pub(super) fn needs_picture(&self, what: What) -> bool {
        what == What::Picture(Plot::Workspace) && self.picture.is_none()
    }

    /// A picture of the workspace is taken of the next frame, in which nothing lies over it.
    pub(super) fn wait_for_picture(&mut self, then: impl FnOnce(&mut Self) + 'static) {
        self.view.sheet = None;
        self.view.message = None;
        self.view.hovered = None;
        self.waiting = Some((Box::new(then), false));
    }

    /// Whether a picture of the workspace is being taken: nothing may lie over it.
    pub(crate) fn poses(&self) -> bool {
        self.waiting.is_some()
    }

    /// Whether a picture of the workspace is to be taken; said once.
    pub(crate) fn wants_picture(&mut self) -> bool {
        let asked = self.waiting.as_mut().map(|(_, asked)| asked);
        asked.is_some_and(|asked| !std::mem::replace(asked, true))
    }

    /// Goes on with the picture that was waited for; `None`: the workspace is not shown.
    pub(crate) fn take_picture(&mut self, image: Option<ColorImage>) {
        let Some((then, _)) = self.waiting.take() else {
            return;
        };
        if image.is_none() {
            let first = say!("Show the workspace first");
            return self.complain(say!("There is nothing to export yet"), [first]);
        }
        self.picture = image;
        self.execute(then);
        self.picture = None;
    }

    /// The standards' figures of what is shown, or why there are none. Where they are shown those before stand while newer
    /// ones are worked out; other steps say those of the same answer.
    pub(crate) fn figures(&self) -> Option<&Result<StandardsFigures, String>> {
        self.answer()?;
        let ((of, diagnosed), made) = self.derived.figures.made()?;
        let now = self.plot_inputs();
        let same = *of == now && *diagnosed == self.diagnosis().map(FittedErrors::from);
        let stands = self.shows_figures() && Arc::ptr_eq(&of.loaded_session, &now.loaded_session);
        (same || stands).then_some(made)
    }

    /// In the export step, and where a decision rests on them in every step.
    pub(super) fn shows_figures(&self) -> bool {
        let wanted = self.view.step == Step::Export || self.rule_and_tolerance().is_some();
        wanted && !self.loaded_session().is_empty() && self.answer().is_some()
    }

    /// The file of targets that was corrected last.
    pub(crate) fn compensated(&self) -> Option<&Compensated> {
        self.derived.compensated.as_deref()
    }

    /// Asks for a file of targets.
    pub(crate) fn choose_targets(&mut self) {
        self.choose_near(files::choose_targets, Self::compensate_file);
    }

    /// Corrects the targets of a file by the model that is shown.
    pub(crate) fn compensate_file(&mut self, path: PathBuf) {
        self.compensate(self.request_for(path));
    }

    /// A file as it was corrected last, or for the first time.
    fn request_for(&self, path: PathBuf) -> CompensationRequest {
        let before = self.compensated().map(|one| &one.wanted);
        let before = before.filter(|wanted| wanted.path == path);
        before
            .cloned()
            .unwrap_or_else(|| CompensationRequest::new(path))
    }

    /// Asks for a file of the controller that declares what the program uses, and reads it with it.
    pub(crate) fn choose_declarations(&mut self, mut wanted: CompensationRequest) {
        let program = wanted.path.clone();
        let ask = move || files::choose_declarations(&program);
        self.choose(ask, move |bench, path| {
            if let Some(path) = path.filter(|path| !wanted.with.contains(path)) {
                wanted.with.push(path);
                bench.compensate(wanted);
            }
        });
    }

    /// Asks for a file that the export starts from.
    pub(crate) fn choose_reference(&mut self) {
        self.choose_near(files::choose_reference, |bench, path| {
            let mut choice = bench.document().export.clone();
            choice.reference = Some(path);
            bench.edit(|document| document.choose_export(choice));
        });
    }

    /// Corrects targets as it is asked for.
    pub(crate) fn compensate(&mut self, mut wanted: CompensationRequest) {
        let Some(outcome) = self.shown_outcome() else {
            return self.complain(
                say!("The targets were not corrected"),
                [say!("Identify the robot first")],
            );
        };
        // What is typed is within the field's range; a command need not be.
        wanted.load_kg = match wanted.load_kg {
            load if load.is_nan() => 0.0,
            load => load.clamp(0.0, MOST_KG),
        };
        let model = self.name_of(What::Model);
        let name = name_of(&wanted.path);
        let says = say!("correcting the targets of {name}", name);
        let session = Arc::clone(&outcome.question.loaded_session);
        let work = move |_: &Watch| {
            let verified = outcome.handed_out();
            let verified = verified.as_deref().map_err(Clone::clone);
            Compensated::of(verified, &model, wanted)
        };
        self.jobs.start(
            Kind::Once,
            says,
            work,
            move |bench: &mut Self, compensated| {
                if !Arc::ptr_eq(&session, bench.loaded_session()) {
                    return bench.is_of_another(say!("The targets were not corrected"));
                }
                bench.derived.compensated = Some(Arc::new(compensated));
                bench.view.sheet = Some(Sheet::Compensation);
            },
        );
    }

    /// The corrected targets, and what was changed beside them.
    fn targets(&self) -> Result<Write, &'static str> {
        let compensated = self.derived.compensated.clone();
        let compensated = compensated.ok_or(say!("Targets and programs"))?;
        let mut inputs = self.inputs();
        inputs.push(compensated.wanted.path.clone());
        inputs.extend(compensated.wanted.with.iter().cloned());
        let make = move |path: &Path, _: &Watch| writing::targets(&compensated, path);
        Ok(later(inputs, make, Self::take_written))
    }
}

/// What is written once it has a path, and whether a file that is there may be replaced.
pub(super) type Write = Box<dyn FnOnce(&mut Workbench, PathBuf, bool) + Send>;

/// None of `inputs` is replaced.
fn later(
    inputs: Vec<PathBuf>,
    make: impl FnOnce(&Path, &Watch) -> Made + Send + 'static,
    then: impl FnOnce(&mut Workbench, Message) + Send + 'static,
) -> Write {
    Box::new(move |bench, path, replace| {
        let says = say!("writing {path}", path = path.display());
        let work = move |watch: &Watch| writing::write(make, &path, replace, &inputs, watch);
        bench.jobs.start(Kind::Writes, says, work, then);
    })
}

/// A text of which nothing more has to be known.
fn list(text: String) -> Write {
    let made = (writing::alone(text.into_bytes()), Vec::new());
    later(Vec::new(), |_, _| Ok(made), Workbench::take_written)
}
