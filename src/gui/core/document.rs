//! What the window works on, as one value: everything in it can be undone; what each change makes of it, or why it
//! cannot be made.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;

use crate::diagnosis::SessionCorrection;
use crate::document::degrees;
use crate::effects::{CATALOGUE, Term};
use crate::export::{Motors, Zeros, find, usual};
use crate::fit::{DEFAULT_EFFECTS, regions_of};
use crate::gui::core::answer::{LoadedModel, Question, QuestionDetails};
use crate::gui::core::loaded_session::LoadedSession;
use crate::gui::core::regions::{self, Decision, Division};
use crate::gui::core::setup::SetupForm;
use crate::kinematics::{DhConvention, JointKind, Robot};
use crate::language::spoken;
use crate::model::RegionalCorrection;
use crate::sessions::division::RegionChoice;
use crate::sessions::{Region, Session};
use crate::text::Template;
use crate::units::rad_from_deg;

/// How the robot is identified.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Method {
    /// Nonlinear least squares in the measuring frame.
    #[default]
    Exact,
    /// The paper's corrections, region by region.
    Regional,
}

/// Which table is exported, and how.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct ExportChoice {
    /// Name of the format.
    pub(crate) format: &'static str,
    /// Joint, counted from 0.
    pub(crate) joint: usize,
    /// Step of the table, degrees or mm; `None`: what the format needs.
    pub(crate) step: Option<f64>,
    /// Who takes the zero offsets of the joints; `None`: what the format is for.
    pub(crate) zeros: Option<Zeros>,
    /// Convention of Denavit–Hartenberg rows; `None`: the one that the robot came in.
    pub(crate) convention: Option<DhConvention>,
    pub(crate) motors: Motors,
    /// File that the export starts from.
    pub(crate) reference: Option<PathBuf>,
}

impl ExportChoice {
    /// What is offered first.
    pub(crate) fn usual(robot: &Robot) -> Self {
        Self {
            format: usual(robot).id,
            ..Self::default()
        }
    }

    /// Whether it is the same table, at whatever step.
    pub(crate) fn is_of_the_table(&self, other: &Self) -> bool {
        (self.format, self.joint) == (other.format, other.joint)
    }

    /// What the file is called unless the user says otherwise.
    pub(crate) fn file_name(&self, session: &str) -> String {
        let (session, format) = (plain(session), find(self.format));
        let extension = format.map_or("txt", |format| format.extension);
        if format.is_some_and(|format| format.rules.is_none()) {
            // It is about the whole robot.
            return format!("{session}.{extension}");
        }
        format!("{session}-joint-{}.{extension}", self.joint + 1)
    }
}

/// A name that every file system takes.
pub(crate) fn plain(name: &str) -> String {
    let kept = |c: char| c.is_alphanumeric() || c == '-' || c == '_';
    let words = name.split(|c| !kept(c)).filter(|word| !word.is_empty());
    let name = words.collect::<Vec<_>>().join("-");
    if name.is_empty() {
        "session".to_owned()
    } else {
        name
    }
}

/// An effect that a search found and that was added to the model.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Added {
    /// Its term, as the search left it.
    pub(crate) term: Term,
    /// Whether it is in the model at present.
    pub(crate) on: bool,
}

/// See the module. Cloning is cheap: the session is shared.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Document {
    pub(crate) loaded_session: Arc<LoadedSession>,
    /// Regions of joint 1.
    pub(crate) regions: Arc<[Region]>,
    pub(crate) division: Division,
    pub(crate) method: Method,
    /// Effects of the exact fit, in the order of the catalogue.
    pub(crate) effects: Vec<&'static str>,
    /// Effects that a search found and that were added to the exact fit, in that order.
    pub(crate) added: Arc<[Added]>,
    /// How far a measured position may be off, mm.
    pub(crate) tolerance_mm: Option<f64>,
    /// How the table is exported.
    pub(crate) export: ExportChoice,
    /// A model that takes the place of the identification.
    pub(crate) loaded_model: Option<Arc<LoadedModel>>,
    /// Whether the robot is to be identified; from then on the answer follows every change.
    pub(crate) identified: bool,
}

impl Document {
    /// A session as it is opened: its own regions and tolerance, nothing identified yet.
    pub(crate) fn new(loaded_session: Arc<LoadedSession>) -> Self {
        let regions = if loaded_session.single_revolute() && !loaded_session.is_empty() {
            // A session at one angle has no range to divide, and so no regions.
            regions_of(&RegionChoice::FromSession, &loaded_session.session).unwrap_or_default()
        } else {
            Vec::new()
        };
        let division = if loaded_session.session.regions.is_empty() {
            Division::Even
        } else {
            Division::Given
        };
        Self {
            regions: regions.into(),
            division,
            method: Method::default(),
            effects: DEFAULT_EFFECTS.to_vec(),
            added: Arc::from([]),
            tolerance_mm: loaded_session.session.tolerance_mm,
            export: ExportChoice::usual(&loaded_session.session.robot),
            loaded_model: None,
            identified: false,
            loaded_session,
        }
    }

    /// The same with a model that was read from a file.
    pub(crate) fn with_model(self, loaded_model: Arc<LoadedModel>) -> Self {
        let regions = if self.loaded_session.is_empty() {
            loaded_model
                .calibration
                .regions
                .iter()
                .map(RegionalCorrection::region)
                .collect()
        } else {
            self.regions
        };
        Self {
            regions,
            loaded_model: Some(loaded_model),
            identified: true,
            ..self
        }
    }

    /// The session with what was changed here, as it is saved.
    pub(crate) fn session_to_save(&self) -> Session {
        let mut session = self.loaded_session.session.clone();
        session.regions = self.regions.to_vec();
        session.tolerance_mm = self.tolerance_mm;
        session
    }

    /// What was added and is switched on.
    pub(crate) fn in_the_model(&self) -> impl Iterator<Item = &Term> {
        let on = self.added.iter().filter(|added| added.on);
        on.map(|added| &added.term)
    }

    /// What the answer depends on; `None` while nothing is to be identified.
    pub(crate) fn question(&self) -> Option<Question> {
        self.identified.then(|| Question {
            loaded_session: Arc::clone(&self.loaded_session),
            asks: match (&self.loaded_model, self.method) {
                (Some(given), _) => QuestionDetails::Given(Arc::clone(given)),
                (None, Method::Exact) => QuestionDetails::Exact {
                    effects: self.effects.clone(),
                    with: self.in_the_model().cloned().collect(),
                    found: None,
                },
                (None, Method::Regional) => QuestionDetails::Regional(Arc::clone(&self.regions)),
            },
        })
    }
}

/// A change that was made; the reason where it cannot be made.
pub(crate) type Changed = Result<(), String>;

impl Document {
    /// What a change from one document to the next is called after “Undo”: by the first field that differs.
    pub(crate) fn edit(before: &Self, after: &Self) -> Template {
        let [was, is] = [before, after].map(|document| &document.loaded_session.session);
        let set_up =
            was.robot != is.robot || was.targets != is.targets || was.instrument != is.instrument;
        if after.loaded_model.is_some() && before.loaded_model != after.loaded_model {
            phrase!("open model")
        } else if before.loaded_session.lineage != after.loaded_session.lineage {
            phrase!("open session")
        } else if set_up {
            phrase!("edit robot and instrument")
        } else if before.loaded_session != after.loaded_session {
            phrase!("change samples")
        } else if before.regions != after.regions || before.division != after.division {
            phrase!("change regions")
        } else if before.effects != after.effects || before.added != after.added {
            phrase!("choose effects")
        } else if before.tolerance_mm != after.tolerance_mm {
            phrase!("set tolerance")
        } else if before.export != after.export {
            phrase!("choose table")
        } else {
            phrase!("identify")
        }
    }
}

impl Document {
    /// What asks something of the samples takes the place of a model that was read from a file.
    fn ask_samples(&mut self) -> Changed {
        if self.loaded_session.is_empty() {
            return Err(say!("Open a session that was measured on this robot").to_owned());
        }
        self.loaded_model = None;
        Ok(())
    }

    /// Another session; a model that was read from a file stays where both are of the same robot.
    pub(crate) fn open(&mut self, loaded_session: Arc<LoadedSession>) {
        let given = self.loaded_model.take();
        let given = given.filter(|given| given.is_of(&loaded_session.session));
        let opened = Self::new(loaded_session);
        *self = match given {
            Some(given) => opened.with_model(given),
            None => opened,
        };
    }

    /// A model beside the open session, or by itself.
    pub(crate) fn open_model(&mut self, loaded_model: Arc<LoadedModel>, beside: bool) {
        let beneath = if beside {
            self.clone()
        } else {
            Self::new(Arc::new(loaded_model.alone()))
        };
        *self = beneath.with_model(loaded_model);
    }

    pub(crate) fn choose_method(&mut self, method: Method) -> Changed {
        self.ask_samples()?;
        if method == Method::Regional && !self.loaded_session.single_revolute() {
            return Err(
                say!("regions divide what was measured with a single joint that turns").to_owned(),
            );
        }
        self.method = method;
        Ok(())
    }

    /// Identifies from now on, by this method or as it is chosen.
    pub(crate) fn identify(&mut self, method: Option<Method>) -> Changed {
        self.choose_method(method.unwrap_or(self.method))?;
        self.identified = true;
        Ok(())
    }

    /// Fits this effect, or leaves it out.
    pub(crate) fn choose_effect(&mut self, id: &str, on: bool) -> Changed {
        self.ask_samples()?;
        let chosen = |other: &&'static str| {
            if *other == id {
                on
            } else {
                self.effects.contains(other)
            }
        };
        let all = CATALOGUE.iter().map(|effect| effect.about().id);
        self.effects = all.filter(chosen).collect();
        Ok(())
    }

    /// How far a position may be off, mm.
    pub(crate) fn set_tolerance(&mut self, tolerance_mm: Option<f64>) -> Changed {
        if tolerance_mm.is_some_and(|t| !(t.is_finite() && t > 0.0)) {
            return Err(say!("a tolerance is a number above 0").to_owned());
        }
        self.tolerance_mm = tolerance_mm;
        Ok(())
    }

    /// Another table.
    pub(crate) fn choose_export(&mut self, choice: ExportChoice) -> Changed {
        let joints = self.loaded_session.session.robot.joints.len();
        let usable = choice
            .step
            .is_none_or(|step| step.is_finite() && step > 0.0);
        if !usable || choice.joint >= joints {
            return Err(say!("a table needs a joint of the robot and a step above 0").to_owned());
        }
        self.export = choice;
        Ok(())
    }

    /// Adds what a search found to the exact fit, all of it switched on.
    pub(crate) fn add(&mut self, terms: &[Term]) -> Changed {
        let mut added = self.added.to_vec();
        for term in terms {
            match added.iter_mut().find(|a| a.term.same_column(term)) {
                Some(there) => there.on = true,
                None => added.push(Added {
                    term: term.clone(),
                    on: true,
                }),
            }
        }
        self.exactly_with(added)
    }

    /// Switches added effects (counted in the order in which they were added) on or off.
    pub(crate) fn switch(&mut self, all: &[usize], on: bool) -> Changed {
        let mut added = self.added.to_vec();
        for index in all {
            added
                .get_mut(*index)
                .ok_or(say!("it is not there any more"))?
                .on = on;
        }
        self.exactly_with(added)
    }

    /// What is added is wanted: the exact fit follows at once.
    fn exactly_with(&mut self, added: Vec<Added>) -> Changed {
        self.ask_samples()?;
        self.added = added.into();
        self.method = Method::Exact;
        self.identified = true;
        Ok(())
    }

    /// Another description of the robot, its reflectors and the instrument, where that makes a robot.
    pub(crate) fn set_up(&mut self, form: &SetupForm) -> Changed {
        let session = &self.loaded_session.session;
        // Compared as it is filled in: missing cells are never equal.
        if *form != SetupForm::of(session) {
            self.take_session(form.session(session)?);
        }
        Ok(())
    }

    /// Takes samples out of every fit and figure, or in again.
    pub(crate) fn exclude(&mut self, samples: &[usize], out: bool) -> Changed {
        self.ask_samples()?;
        let loaded_session = &self.loaded_session;
        let of_session = &loaded_session.session.samples;
        let mut excluded: BTreeSet<usize> = of_session.excluded_by_hand().into_iter().collect();
        for sample in samples.iter().filter(|sample| **sample < of_session.len()) {
            if out {
                excluded.insert(*sample);
            } else {
                excluded.remove(sample);
            }
        }
        let held_out = of_session.held_out.as_deref();
        let counts = |i: usize| {
            loaded_session.usable[i] && !excluded.contains(&i) && !held_out.is_some_and(|h| h[i])
        };
        if out && !(0..of_session.len()).any(counts) {
            return Err(say!("no sample would be left to fit").to_owned());
        }
        let whole = loaded_session.made_of().map(|(whole, _)| Arc::clone(whole));
        let whole = whole.unwrap_or_else(|| Arc::clone(loaded_session));
        let excluded: Vec<usize> = excluded.into_iter().collect();
        self.loaded_session = Arc::new(LoadedSession::excluding(&whole, &excluded));
        Ok(())
    }

    /// Takes mistakes of setting up back, one after the other.
    pub(crate) fn correct(&mut self, mends: &[SessionCorrection]) -> Changed {
        self.ask_samples()?;
        let mut session = self.loaded_session.session.clone();
        for mend in mends {
            mend.apply(&mut session);
        }
        as_saved(&mut session);
        let left = session.samples.len();
        if session.samples.incomplete().len() == left {
            return Err(say!("no sample would be left to fit").to_owned());
        }
        let same_rows = left == self.loaded_session.len();
        self.take_session(session);
        if !same_rows {
            let mut loaded_session = LoadedSession::clone(&self.loaded_session);
            // Samples have other numbers now.
            for finding in &mut loaded_session.findings {
                finding.samples.clear();
            }
            self.loaded_session = Arc::new(loaded_session);
        }
        Ok(())
    }

    /// The same opening with another description of the robot, or other samples.
    fn take_session(&mut self, session: Session) {
        let loaded_session = LoadedSession::with(&self.loaded_session, session);
        let given = self.loaded_model.take();
        self.loaded_model = given.filter(|given| given.is_of(&loaded_session.session));
        if !loaded_session.single_revolute() {
            self.regions = Arc::from([]);
            self.division = Division::Given;
            self.method = Method::Exact;
        }
        self.loaded_session = Arc::new(loaded_session);
    }
}

/// Changes of the regions.
impl Document {
    /// So many regions of the same width.
    pub(crate) fn divide(&mut self, number: usize) -> Changed {
        self.divide_by(&RegionChoice::Uniform(number), Division::Even)
    }

    /// The regions that the session brings along.
    pub(crate) fn regions_of_session(&mut self) -> Changed {
        self.divide_by(&RegionChoice::FromSession, Division::Given)
    }

    fn divide_by(&mut self, choice: &RegionChoice, division: Division) -> Changed {
        self.ask_samples()?;
        let regions = regions_of(choice, &self.loaded_session.session);
        self.take_regions(regions.map_err(|e| spoken(e.describe()))?, division)
    }

    /// What the adaptive division decided.
    pub(crate) fn adapt(&mut self, regions: Vec<Region>, decision: Decision) -> Changed {
        self.take_regions(regions, Division::Adaptive(decision))
    }

    /// Goes on with the regions as they are, by hand.
    pub(crate) fn keep_regions(&mut self) {
        self.division = Division::Given;
    }

    /// Moves a boundary (counted in ascending order) to this angle, rad.
    pub(crate) fn move_boundary(&mut self, boundary: usize, to_rad: f64) -> Changed {
        let travel = self.loaded_session.travel();
        let moved = regions::moved(&self.regions, boundary, to_rad, travel);
        let otherwise = say!("the boundary cannot be moved there");
        self.by_hand(moved, otherwise)
    }

    /// Cuts a region in half.
    pub(crate) fn split(&mut self, region: usize) -> Changed {
        let split = regions::split(&self.regions, region);
        let otherwise = say!("the region is too narrow to be split");
        self.by_hand(split, otherwise)
    }

    /// Makes one region of this and the one after it.
    pub(crate) fn join(&mut self, region: usize) -> Changed {
        let otherwise = say!(
            "no region begins where this one ends; enter the end of this region as the start of the next one first"
        );
        let joined = regions::joined(&self.regions, region);
        self.by_hand(joined, otherwise)
    }

    /// Takes a region away: where it was nothing is corrected.
    pub(crate) fn delete(&mut self, region: usize) -> Changed {
        let otherwise = say!("the last region stays: without one nothing is corrected");
        let rest = regions::without(&self.regions, region);
        self.by_hand(rest, otherwise)
    }

    fn by_hand(&mut self, made: Option<Vec<Region>>, otherwise: &str) -> Changed {
        self.ask_samples()?;
        self.take_regions(made.ok_or(otherwise)?, Division::Given)
    }

    /// Regions that are worked on are regions that are wanted: the answer follows them at once.
    fn take_regions(&mut self, regions: Vec<Region>, division: Division) -> Changed {
        self.identify(Some(Method::Regional))?;
        // Exactly as a file will have them: what is saved is read again to the last bit.
        let as_saved = |region: Region| Region {
            from_rad: rad_from_deg(degrees(region.from_rad)),
            to_rad: rad_from_deg(degrees(region.to_rad)),
            ..region
        };
        let regions: Vec<Region> = regions.into_iter().map(as_saved).collect();
        // Regions that stay as they are stay the same to everything that looks at them.
        if self.regions[..] != regions[..] {
            self.regions = Arc::from(regions);
        }
        self.division = division;
        Ok(())
    }

    /// Another name for a region.
    pub(crate) fn rename(&mut self, region: usize, name: &str) -> Changed {
        let name = name.trim();
        if name.is_empty() {
            return Err(say!("a region needs a name").to_owned());
        }
        let taken = |(k, r): (usize, &Region)| k != region && r.name == name;
        if self.regions.iter().enumerate().any(taken) {
            return Err(say!("{name} is taken; choose another name", name));
        }
        let mut regions = self.regions.to_vec();
        let renamed = regions
            .get_mut(region)
            .ok_or(say!("it is not there any more"))?;
        name.clone_into(&mut renamed.name);
        self.regions = regions.into();
        Ok(())
    }
}

/// Angles that were computed become those that a file will have: what is saved is read again to
/// the last bit.
pub(super) fn as_saved(session: &mut Session) {
    let samples = &mut session.samples;
    for (k, joint) in session.robot.joints.iter().enumerate() {
        let read = samples.q_read[k].iter_mut().flatten();
        let angles = samples.q[k].iter_mut().chain(read);
        for q in angles.filter(|_| joint.kind == JointKind::Revolute) {
            *q = rad_from_deg(degrees(*q));
        }
    }
}
