//! From where the search ended to the answer: refits on all samples, and the evidence of every
//! step put together.

use std::borrow::Cow;

use crate::effects::{JointValues, Term, called};
use crate::fit::base_model;
use crate::fit::expected::expected_error;
use crate::fit::gap::{deviations, lengths_mm, over_fitted, suspects};
use crate::fit::problem::Problem;
use crate::kinematics::Robot;
use crate::model::{ResidualStep, SetUp};
use crate::observations::KINDS;
use crate::observations::figures::{KindFigures, apart_beside};
use crate::sessions::{Session, SessionCorrection};
use crate::text::Text;

use super::named_effects::found;
use super::remainder::unexplained;
use super::repeatability::robot_mm;
use super::testable::not_testable;
use super::unseen::{self, held_out};
use super::values::{Values, corrected_for_selection};
use super::{equal_steps, gross, handed_out, judgement, limits, repeating, unnamed};
use crate::answers::diagnosis::{Diagnosis, Equivalent, Gaps, HeldOut, Unexplained, Unnamed};
use crate::answers::identification::Identification;
use crate::answers::noise::Noise;
use crate::answers::pose::{NextPose, to_raw};
use crate::diagnosis::candidates::table::NotTestable;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::evidence::rival::Rival;
use crate::diagnosis::search::CHANCE_OF_A_STEP;
use crate::diagnosis::search::SearchResult as SearchEnd;
use crate::diagnosis::search::floor;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::diagnosis::search::{Step, steps};
use crate::diagnosis::search::{aliases, other_settings};
use crate::diagnosis::search::{is_above, stands_above};
use crate::diagnosis::{DiagnoseError, Progress, Watch};
use crate::set_up_errors::{CorrectedSession, DataProblem};

/// What stays undecided, for the proposal of poses.
pub struct Undecided<'u, 'a> {
    pub(crate) prepared: &'u PreparedSearch<'a>,
    pub(crate) fit: &'u Fit,
    pub(crate) rivals: &'u [&'u Rival],
    pub(crate) not_testable: &'u [NotTestable],
}

/// Poses to measure next, and for each rival what would tell it from the model.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Proposal {
    pub(crate) poses: Vec<NextPose>,
    pub(crate) separate_by: Vec<Text>,
}

impl Proposal {
    /// No poses for so many rivals.
    fn not_looked_for(rivals: usize) -> Self {
        Self {
            poses: Vec::new(),
            separate_by: vec![text!("not looked for: the search was stopped"); rivals],
        }
    }
}

/// Proposes poses.
pub(crate) type Planner<'p> = &'p dyn Fn(&Undecided) -> Proposal;

/// So many rivals that are likelier, likeliest first, are held against what is said of them.
const MOST_HELD_AGAINST: usize = 3;
/// At most so many rivals are listed.
const MOST_EQUIVALENT: usize = 6;

/// The answer of the end of a search.
pub(crate) fn answer(
    mended: &CorrectedSession,
    prepared: &PreparedSearch,
    end: &SearchEnd,
    planner: Planner,
    watch: Watch,
) -> Result<Diagnosis, DiagnoseError> {
    let go_on = |progress: Progress| {
        watch(&progress)
            .then_some(())
            .ok_or(DiagnoseError::Cancelled)
    };
    go_on(Progress::Comparing)?;
    let (session, regression) = (&mended.session, &prepared.regression);
    let named = Named::of(prepared, end);
    let floor = floor(prepared, &named.handed_out);
    let figures = &named.figures;
    let open = OpenQuestions::of(prepared, end);
    go_on(Progress::Planning)?;
    let proposal = open.proposal(prepared, &end.fit, planner);
    let set_up = set_up(session, prepared.options().joint_values);
    let mut next_poses = proposal.poses.clone();
    to_raw(&mut next_poses, &set_up, &session.robot);
    let found = found(prepared, &end.fit, &named.steps, &floor, &named.values);
    let mut left = unexplained(prepared, end, session);
    judgement::judge(
        prepared,
        end,
        &named.judged,
        &floor,
        &figures.held_out,
        &mut left,
    );
    tell_what_is_open(prepared, &named.dropped, &mut left);
    // What predicts without a name joins the model once everything is said of the names, whose fits need no room
    // any more.
    regression.forget();
    let with = Predicting::with(prepared, &named, found.len(), &left);
    let identification = identification(prepared, &named.alone, &with.values);
    let with = with.unless_little_is_shown(prepared, &identification);
    let gross = gross::beyond_noise(
        prepared,
        &floor,
        &with.figures.gap,
        &identification,
        &mended.problems,
    );
    if let Some(why) = gross {
        tell_gross(why, with.figures.gap.end_mm, &mut left);
    }
    Ok(Diagnosis {
        session: session.name.clone(),
        samples: session.samples.len(),
        verdict: judgement::of(found.is_empty(), left.present),
        data_problems: [
            &*mended.problems,
            prepared.incomplete.as_slice(),
            open.equal_steps.as_slice(),
            identification.many_set_aside().as_slice(),
            identification.far_tool().as_slice(),
        ]
        .concat(),
        stopped: regression.work.ended(),
        floor,
        equivalent: equivalents(&open.rivals, &end.fit, &proposal, |t| named.is_dropped(t)),
        unexplained: left,
        not_testable: open.not_testable,
        not_found: limits::limits(regression, &end.fit),
        outliers: identification.outliers.clone(),
        next_poses,
        noise: with
            .noise
            .clone()
            .unwrap_or_else(|| noise_of(prepared, &with.values)),
        history: history(session, &named.steps, &with),
        identified: with.values.identified(),
        model: with.values.model.settled(),
        gap: with.figures.gap,
        held_out: with.figures.held_out,
        unnamed: with.unnamed,
        identification,
        found,
        set_up,
    })
}

/// The errors of a model: over the samples that were fitted, and over those that no fit has seen.
#[derive(Clone)]
pub(super) struct Figures {
    pub(super) gap: Gaps,
    pub(super) held_out: HeldOut,
}

/// The names that a search ends with, on all samples that may be fitted.
struct Named<'a> {
    /// The fit of the names alone, and of those that are handed out.
    alone: Fit,
    handed_out: Fit,
    /// The values that the verdict is about, and those that are handed out.
    judged: Values<'a>,
    values: Values<'a>,
    figures: Figures,
    steps: Vec<Step>,
    /// Names that were found and are not handed out.
    dropped: Vec<Term>,
}

impl<'a> Named<'a> {
    fn of(prepared: &PreparedSearch<'a>, end: &SearchEnd) -> Self {
        let regression = &prepared.regression;
        let with_shapes = &end.fit;
        let base = regression.fit(&regression.base, &[]);
        // The model carries names only, as near to the samples as names can come; what no name
        // explains is told apart.
        let alone = if with_shapes.shapes.is_empty() {
            with_shapes.clone()
        } else {
            regression.fit(&with_shapes.model, &[])
        };
        let nominal_mm = lengths_mm(&prepared.problem, &prepared.nominal);
        // Unseen samples have done their part: values come from all samples that may be fitted.
        let problem = with_unlocked(prepared, with_shapes);
        let capped = prepared.is_capped(end);
        let fits = [&alone, with_shapes];
        let judged = values(prepared, &problem, fits, capped);
        let mut steps = steps(prepared, &base, &alone);
        let order: Vec<Term> = steps.iter().map(|step| step.term.clone()).collect();
        let own = handed_out::choose(prepared, &problem, fits, &judged, &order, capped);
        let start = over_fitted(&own.values.problem, &nominal_mm);
        let gap = Gaps {
            start_mm: start.map_or(0.0, |s| s.rms_mm),
            identified_mm: own.identified_mm,
            end_mm: own.end_mm,
        };
        steps.retain(|step| !own.dropped.iter().any(|d| d.same_column(&step.term)));
        meet(&mut steps, &gap);
        Self {
            handed_out: without_dropped(prepared, &alone, &own.dropped),
            figures: Figures {
                held_out: held_out(prepared, &nominal_mm, own.held_out_mm),
                gap,
            },
            values: own.values,
            dropped: own.dropped,
            alone,
            judged,
            steps,
        }
    }

    fn is_dropped(&self, term: &Term) -> bool {
        self.dropped.iter().any(|d| d.same_column(term))
    }
}

/// The model with everything that predicts: what no sample shows where it is expected, and what repeats without a name.
struct Predicting<'a> {
    values: Values<'a>,
    /// With it, and of the names alone, on the samples that both are judged by.
    figures: Figures,
    names: Figures,
    unnamed: Option<Unnamed>,
    /// The noise beside it, where that is known better with it.
    noise: Option<Noise>,
}

impl<'a> Predicting<'a> {
    fn with(
        prepared: &PreparedSearch<'a>,
        named: &Named<'a>,
        names: usize,
        left: &Unexplained,
    ) -> Self {
        let completed = completed(prepared, &named.values, names, &named.figures);
        let (values, figures) =
            completed.unwrap_or_else(|| (named.values.clone(), named.figures.clone()));
        if let Some((with, after, unnamed)) = unnamed::beside(prepared, &values, &figures) {
            return Self {
                values: with,
                names: figures,
                figures: after,
                unnamed: Some(unnamed),
                noise: None,
            };
        }
        let Some(own) = repeating::beside(prepared, &values, left, &figures) else {
            return Self {
                values,
                names: figures.clone(),
                figures,
                unnamed: None,
                noise: None,
            };
        };
        let mut names = Figures {
            held_out: own.figures.held_out.clone(),
            ..figures
        };
        if let Some(gaps) = &mut names.held_out.gaps {
            gaps.end_mm = own.curve.held_out_mm[0].min(gaps.identified_mm);
        }
        Self {
            values,
            names,
            figures: own.figures,
            unnamed: Some(own.unnamed),
            noise: own.noise,
        }
    }

    /// No figure of unseen poses where those that were measured say little of others.
    fn unless_little_is_shown(
        mut self,
        prepared: &PreparedSearch,
        identification: &Identification,
    ) -> Self {
        let expected_mm = identification.expected.as_ref().map(|e| e.rms_mm);
        if expected_mm.is_some_and(|mm| mm > self.figures.gap.start_mm)
            && self.values.is_completed()
            && self.values.problem.session.has_plain_points()
            && unseen::is_cross_fitted(prepared)
        {
            self.figures.held_out = HeldOut::none(text!(
                "the poses predict each other, and say so little of others that the model is expected to be off by more there than the nominal robot was here"
            ));
            self.names.held_out.gaps = None;
        }
        self
    }
}

/// An error that no noise is so large as is unexplained, whatever the floor says.
fn tell_gross(why: Text, end_mm: f64, left: &mut Unexplained) {
    if !left.present {
        left.present = true;
        left.place = None;
        left.rms_mm = end_mm;
    }
    left.description = behind(why, std::mem::take(&mut left.description));
}

/// One figure, one name: the first name starts from the model of `identify`, whose noise may be another than that of
/// the search, and the last one ends at the model that is handed out.
fn meet(steps: &mut [Step], gap: &Gaps) {
    if let Some(first) = steps.first_mut() {
        first.gap_mm[0] = gap.identified_mm;
    }
    if let Some(last) = steps.last_mut() {
        last.gap_mm[1] = gap.end_mm;
    }
}

/// The fit of the names that are handed out.
fn without_dropped(prepared: &PreparedSearch, fit: &Fit, dropped: &[Term]) -> Fit {
    if dropped.is_empty() {
        return fit.clone();
    }
    handed_out::without(prepared, fit, dropped)
}

/// The noise as it is said. Of several kinds of measurement the search knows one number, which stands for σ of
/// each; in mm it is what lengths are left with.
fn noise_of(prepared: &PreparedSearch, values: &Values) -> Noise {
    let regression = &prepared.regression;
    let own = values.problem.noise.clone();
    let noise = own.unwrap_or_else(|| regression.noise.clone());
    if values.problem.observed.is_none() {
        let robot_mm = robot_mm(prepared, values);
        return Noise { robot_mm, ..noise };
    }
    let [found_mm, searched_mm] = [values.sigma_mm()[0], noise.sigma_mm[0]];
    noise.scaled(found_mm / searched_mm.max(f64::MIN_POSITIVE))
}

/// What the samples leave open.
struct OpenQuestions {
    /// Rivals that the samples cannot rule out.
    rivals: Vec<Rival>,
    /// What equal steps of the commands have to do with it.
    equal_steps: Option<DataProblem>,
    not_testable: Vec<NotTestable>,
}

impl OpenQuestions {
    fn of(prepared: &PreparedSearch, end: &SearchEnd) -> Self {
        let (regression, fit) = (&prepared.regression, &end.fit);
        let mut rivals = aliases::open_rivals(regression, fit);
        // What is likelier and carries itself has taken the place already; what does not is no rival.
        let mut held = 0;
        rivals.retain(|r| {
            if !is_above(&r.fit, fit) {
                return true;
            }
            held += 1;
            held <= MOST_HELD_AGAINST && stands_above(prepared, &r.fit, fit)
        });
        let others = &end.other_ends;
        rivals.extend(aliases::under_another_noise(regression, fit, others));
        let settings = other_settings::open_settings(regression, fit);
        let equal_steps = equal_steps::equal_steps(prepared, &settings)
            .or_else(|| equal_steps::of_withdrawn(prepared, &end.withdrawn));
        rivals.extend(settings);
        let base = regression.fit(&regression.base, &[]);
        Self {
            rivals,
            equal_steps,
            not_testable: not_testable(regression, &base),
        }
    }

    /// Poses that would decide.
    fn proposal(&self, prepared: &PreparedSearch, fit: &Fit, planner: Planner) -> Proposal {
        if prepared.regression.work.was_stopped() {
            return Proposal::not_looked_for(self.rivals.len());
        }
        planner(&Undecided {
            prepared,
            fit,
            rivals: &self.rivals.iter().collect::<Vec<_>>(),
            not_testable: &self.not_testable,
        })
    }
}

/// Says which names were found and are not handed out, and that the search was stopped.
fn tell_what_is_open(prepared: &PreparedSearch, dropped: &[Term], unexplained: &mut Unexplained) {
    if !dropped.is_empty() {
        tell_dropped(unexplained, dropped, prepared.problem.session);
    }
    if let Some(why) = prepared.regression.work.ended() {
        unexplained.present = true;
        let before = std::mem::take(&mut unexplained.description);
        unexplained.description = behind(why.describe().into(), before);
    }
}

/// The values with what no sample shows where it is expected; samples that are held out are predicted with it, and
/// where names stand in the model no worse than `identify` does.
fn completed<'a>(
    prepared: &PreparedSearch,
    values: &Values<'a>,
    names: usize,
    figures: &Figures,
) -> Option<(Values<'a>, Figures)> {
    let completed = values.clone().completed();
    let mut figures = figures.clone();
    let apart = unseen::of_model(prepared, &completed.model);
    if let (Some(end_mm), Some(gaps)) = (apart, &mut figures.held_out.gaps) {
        if names == 0 {
            gaps.identified_mm = end_mm;
        } else if end_mm > gaps.identified_mm {
            return None;
        }
        gaps.end_mm = end_mm;
    }
    Some((completed, figures))
}

/// What is handed out, as `identify` would say it.
fn identification(prepared: &PreparedSearch, fit: &Fit, own: &Values) -> Identification {
    let held = prepared.not_identifiable.clone();
    let mut identification = own.identification(&prepared.nominal, held);
    tell_unseen(prepared, fit, &mut identification.kinds);
    if base_model::is_arm(own.problem.session) {
        let covariance = own.covariance.as_ref();
        identification.expected = covariance
            .and_then(|c| expected_error(&own.problem, &own.model, c, own.is_completed()));
    }
    identification
}

/// Values of the names, from a fit of them alone or with the shapes beside them.
fn values<'a>(
    prepared: &PreparedSearch,
    problem: &Problem<'a>,
    [alone, with_shapes]: [&Fit; 2],
    capped: bool,
) -> Values<'a> {
    // A shape over a joint of several takes of their geometry, which then predicts nothing without it.
    let several = prepared.regression.base.robot.joints.len() > 1;
    let of_kinds = problem.observed.is_some();
    let without = (several || of_kinds) && !with_shapes.shapes.is_empty();
    let own = if without { alone } else { with_shapes };
    let values = Values::of(prepared, problem, own, capped || without);
    corrected_for_selection(prepared, with_shapes, values)
}

fn history(session: &Session, steps: &[Step], with: &Predicting) -> Vec<ResidualStep> {
    let Figures { gap, held_out } = &with.names;
    let seen = held_out.gaps.as_ref();
    let one = |what: String, gap_mm: f64, held_out_mm: Option<f64>| ResidualStep {
        what,
        gap_mm,
        held_out_mm,
        runs_held_out_mm: None,
    };
    let base = base_in_words(&session.robot).to_owned();
    let mut history = vec![
        one(
            "nominal robot".to_owned(),
            gap.start_mm,
            seen.map(|g| g.start_mm),
        ),
        one(base, gap.identified_mm, seen.map(|g| g.identified_mm)),
    ];
    history.extend(steps.iter().map(|step| {
        let what = format!("with {}", step.term.name_on(&session.robot));
        one(what, step.gap_mm[1], step.held_out_mm.map(|h| h[1]))
    }));
    if let (Some(last), false) = (history.last_mut(), steps.is_empty()) {
        // The steps are those of the search; the last is what is handed out.
        last.gap_mm = gap.end_mm;
        last.held_out_mm = seen.map(|g| g.end_mm);
    }
    let curve = |unnamed: &Unnamed| unnamed.curve.as_ref().map(|c| c.runs_held_out_mm);
    history.extend(with.unnamed.as_ref().map(|unnamed| {
        let runs = curve(unnamed);
        let what = match runs {
            Some(_) => format!("with {}", crate::effects::UNEXPLAINED),
            None => "with what predicts without a name".to_owned(),
        };
        let seen = with.figures.held_out.gaps.map(|g| g.end_mm);
        ResidualStep {
            runs_held_out_mm: runs.flatten(),
            ..one(what, with.figures.gap.end_mm, seen)
        }
    }));
    history
}

/// Puts beside the errors of every kind those that no fit has seen.
fn tell_unseen(prepared: &PreparedSearch, fit: &Fit, kinds: &mut [KindFigures]) {
    let regression = &prepared.regression;
    let Some(rows) = regression.rows.observed() else {
        return;
    };
    if !prepared.folds.predict_poses {
        return;
    }
    let unseen = rows.by_kind(&prepared.folds.unseen(regression, fit).rows);
    for (kind, unseen) in KINDS.iter().zip(unseen) {
        let about = kind.about();
        let own = kinds.iter_mut().find(|own| own.kind == about.name);
        if let (Some(own), Some(unseen)) = (own, unseen) {
            own.unseen_rms = Some(unseen * about.unit.read().1);
        }
    }
}

/// What belongs to every calibration of a robot.
pub(crate) fn base_in_words(robot: &Robot) -> &'static str {
    match robot.joints.len() {
        1 => "zero offset and link length",
        _ => "geometry: frame, zero offsets, links and tool",
    }
}

/// All samples that may be fitted, those that an option locked away as well, without those that
/// are far off beside the model.
fn with_unlocked<'p, 'a>(prepared: &'p PreparedSearch<'a>, fit: &Fit) -> Cow<'p, Problem<'a>> {
    if !prepared.locked.contains(&true) {
        return Cow::Borrowed(&*prepared.problem);
    }
    let model = &Values::of(prepared, &prepared.problem, fit, false).model;
    let mut all = (*prepared.problem).clone();
    all.take_in(&prepared.locked, |all| match &all.observed {
        Some(layer) => apart_beside(layer, model),
        None => suspects(all, &deviations(all, model)),
    });
    Cow::Owned(all)
}

/// The set-up corrections that a session had in memory; where its fit starts from the values read back, they
/// take the place of the commanded ones.
fn set_up(session: &Session, joint_values: JointValues) -> SetUp {
    let made = session.samples.corrected.iter();
    let made = made.flat_map(|corrected| corrected.by.clone());
    let read = (joint_values == JointValues::Read).then_some(SessionCorrection::TakeReadBack);
    SetUp::new(made.chain(read))
}

/// Says which names were found and are not handed out.
fn tell_dropped(unexplained: &mut Unexplained, dropped: &[Term], session: &Session) {
    let names: Vec<String> = dropped
        .iter()
        .map(|term| term.name_on(&session.robot))
        .collect();
    let says = text!(
        "the RMS error of the samples, fitted or cross-validated, is no smaller with {effects}, or what it does runs away over the joint ranges: not handed out",
        effects = Text::listed(names.iter().map(|name| called(name)), ", ")
    );
    unexplained.description = behind(says, std::mem::take(&mut unexplained.description));
    unexplained.present = true;
    unexplained.p = unexplained.p.min(CHANCE_OF_A_STEP);
    unexplained.resembles.extend(names);
}

/// A clause, and what was said before it behind it.
fn behind(clause: Text, before: Text) -> Text {
    if before.is_empty() {
        clause
    } else {
        text!("{first}; {next}", first = clause, next = before)
    }
}

fn equivalents(
    rivals: &[Rival],
    fit: &Fit,
    proposal: &Proposal,
    is_dropped: impl Fn(&Term) -> bool,
) -> Vec<Equivalent> {
    let robot = &fit.model.robot;
    let ids = |terms: &[Term]| -> Vec<String> { terms.iter().map(|t| t.name_on(robot)).collect() };
    let mut all: Vec<Equivalent> = Vec::new();
    for (rival, separate_by) in rivals.iter().zip(&proposal.separate_by) {
        if rival.removed.iter().any(&is_dropped) {
            continue;
        }
        let (explanation, instead) = (ids(&rival.removed), ids(&rival.instead));
        let mut there = all.iter_mut();
        let known = there.find(|e| e.explanation == explanation && e.instead == instead);
        if let Some(known) = known {
            // One name at several other settings is listed once.
            known.orders.extend(rival.other_settings());
            continue;
        }
        if all.len() == MOST_EQUIVALENT {
            continue;
        }
        all.push(Equivalent {
            explanation,
            instead,
            odds: (fit.ln_evidence - rival.fit.ln_evidence).exp(),
            separate_by: separate_by.clone(),
            orders: rival.other_settings(),
            model: rival.fit.model.clone(),
        });
    }
    for one in all.iter_mut().filter(|e| !e.orders.is_empty()) {
        let orders = one
            .orders
            .iter()
            .map(|o| crate::diagnosis::candidates::shown(*o));
        let orders = orders.collect::<Vec<_>>().join(", ");
        one.separate_by = text!(
            "orders (or leads) {orders}, the same at these steps: {separate_by}",
            orders,
            separate_by = &one.separate_by
        );
    }
    all
}
