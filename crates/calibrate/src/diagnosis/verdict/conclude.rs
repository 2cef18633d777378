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
use super::{gross, handed_out, judgement, limits, repeating, unnamed};
use crate::answers::diagnosis::{Diagnosis, Equivalent, Gaps, HeldOut, Unexplained};
use crate::answers::identification::Identification;
use crate::answers::noise::Noise;
use crate::answers::pose::{NextPose, to_raw};
use crate::diagnosis::candidates::table::NotTestable;
use crate::diagnosis::evidence::Fit;
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
    pub(crate) rivals: &'u [&'u crate::diagnosis::evidence::rival::Rival],
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

#[allow(
    clippy::too_many_lines,
    reason = "the parts of an answer, each a call, in the order in which they need each other"
)]
pub(crate) fn answer(
    mended: &CorrectedSession,
    prepared: &PreparedSearch,
    end: &SearchEnd,
    planner: Planner,
    watch: Watch,
) -> Result<Diagnosis, DiagnoseError> {
    let regression = &prepared.regression;
    let fit = &end.fit;
    let go_on = |progress: Progress| {
        if watch(&progress) {
            Ok(())
        } else {
            Err(DiagnoseError::Cancelled)
        }
    };
    go_on(Progress::Comparing)?;
    let session = &mended.session;
    let problem = &prepared.problem;
    let base = regression.fit(&regression.base, &[]);
    // The model carries names only, as near to the samples as names can come; what no name
    // explains is told apart.
    let with_shapes = fit;
    let names = regression.fit(&fit.model, &[]);
    let fit = if with_shapes.shapes.is_empty() {
        with_shapes
    } else {
        &names
    };
    let nominal_mm = lengths_mm(problem, &prepared.nominal);
    // Unseen samples have done their part: values come from all samples that may be fitted.
    let problem = &with_unlocked(prepared, with_shapes);
    let capped = prepared.is_capped(end);
    let values = values(prepared, problem, [fit, with_shapes], capped);
    let found_steps = steps(prepared, &base, fit);
    let order: Vec<Term> = found_steps.iter().map(|step| step.term.clone()).collect();
    let mut handed_out = handed_out::choose(
        prepared,
        problem,
        [fit, with_shapes],
        &values,
        &order,
        capped,
    );
    let mut held_out = held_out(prepared, &nominal_mm, handed_out.held_out_mm);
    let counted = &handed_out.values.problem;
    let start = over_fitted(counted, &nominal_mm);
    let mut gap = Gaps {
        start_mm: start.map_or(0.0, |s| s.rms_mm),
        identified_mm: handed_out.identified_mm,
        end_mm: handed_out.end_mm,
    };
    let dropped = handed_out.dropped.clone();
    let floor = floor(prepared, &without_dropped(prepared, fit, &dropped));
    let is_dropped = |term: &Term| dropped.iter().any(|d| d.same_column(term));
    let mut steps = found_steps;
    steps.retain(|step| !is_dropped(&step.term));
    meet(&mut steps, &gap);
    let (rivals, equal_steps) = open_questions(prepared, end);
    let equivalent: Vec<_> = rivals.iter().collect();
    go_on(Progress::Planning)?;
    let not_testable = not_testable(regression, &base);
    let undecided = Undecided {
        prepared,
        fit: with_shapes,
        rivals: &equivalent,
        not_testable: &not_testable,
    };
    let proposal = if regression.work.was_stopped() {
        Proposal::not_looked_for(equivalent.len())
    } else {
        planner(&undecided)
    };
    let own = &handed_out.values;
    let set_up = set_up(session, prepared.options().joint_values);
    let mut next_poses = proposal.poses.clone();
    to_raw(&mut next_poses, &set_up, &session.robot);
    let found = found(prepared, with_shapes, &steps, &floor, own);
    let mut unexplained = unexplained(prepared, end, session);
    let mut verdict = judgement::judge(prepared, end, &values, &floor, &held_out, &mut unexplained);
    if tell_what_is_open(prepared, &dropped, &mut unexplained) {
        verdict = judgement::of(found.is_empty(), unexplained.present);
    }
    // What predicts without a name joins the model once everything is said of the names, whose fits need no room
    // any more.
    regression.forget();
    if let Some(completed) = completed(prepared, &handed_out.values, found.len(), &mut held_out) {
        handed_out.values = completed;
    }
    let (names_gap, mut names_held_out) = (gap, held_out.clone());
    let unnamed = unnamed::add(prepared, &mut handed_out, &mut gap, &mut held_out);
    let repeating = repeating::add(
        prepared,
        &handed_out.values,
        &unexplained,
        &mut gap,
        &mut held_out,
    );
    let (repeating, noise_beside) = repeating.unzip();
    if let Some(curve) = repeating.as_ref().and_then(|own| own.curve.as_ref()) {
        // On the samples that the curve is judged by.
        names_held_out = held_out.clone();
        if let Some(gaps) = &mut names_held_out.gaps {
            gaps.end_mm = curve.held_out_mm[0].min(gaps.identified_mm);
        }
    }
    let own = &handed_out.values;
    let identification = identification(prepared, fit, own);
    if let Some(expected) = &identification.expected
        && own.is_completed()
        && session.has_plain_points()
        && expected.rms_mm > gap.start_mm
        && unseen::is_cross_fitted(prepared)
    {
        held_out = HeldOut::none(text!(
            "the poses predict each other, and say so little of others that the model is expected to be off by more there than the nominal robot was here"
        ));
        names_held_out.gaps = None;
    }
    let mut history = history(session, &names_gap, &names_held_out, &steps);
    history.extend(unnamed.as_ref().map(|_| ResidualStep {
        what: "with what predicts without a name".to_owned(),
        gap_mm: gap.end_mm,
        held_out_mm: held_out.gaps.map(|g| g.end_mm),
        runs_held_out_mm: None,
    }));
    history.extend(
        repeating
            .iter()
            .flat_map(|own| &own.curve)
            .map(|curve| ResidualStep {
                what: format!("with {}", crate::effects::UNEXPLAINED),
                gap_mm: gap.end_mm,
                held_out_mm: held_out.gaps.map(|g| g.end_mm),
                runs_held_out_mm: curve.runs_held_out_mm,
            }),
    );
    if let Some(why) =
        gross::beyond_noise(prepared, &floor, &gap, &identification, &mended.problems)
    {
        if !unexplained.present {
            unexplained.present = true;
            unexplained.place = None;
            unexplained.rms_mm = gap.end_mm;
        }
        unexplained.description = behind(why, std::mem::take(&mut unexplained.description));
        verdict = judgement::of(found.is_empty(), true);
    }
    Ok(Diagnosis {
        session: session.name.clone(),
        samples: session.samples.len(),
        verdict,
        data_problems: [
            &*mended.problems,
            prepared.incomplete.as_slice(),
            equal_steps.as_slice(),
            identification.many_set_aside().as_slice(),
            identification.far_tool().as_slice(),
        ]
        .concat(),
        stopped: regression.work.ended(),
        floor,
        gap,
        held_out,
        identified: own.identified(),
        found,
        equivalent: equivalents(&equivalent, with_shapes, &proposal, is_dropped),
        unexplained,
        unnamed: unnamed.or(repeating),
        not_testable,
        not_found: limits::limits(regression, with_shapes),
        outliers: identification.outliers.clone(),
        identification,
        next_poses,
        noise: noise_beside
            .flatten()
            .unwrap_or_else(|| noise_of(prepared, own)),
        model: own.model.settled(),
        history,
        set_up,
    })
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
fn without_dropped<'f>(prepared: &PreparedSearch, fit: &'f Fit, dropped: &[Term]) -> Cow<'f, Fit> {
    if dropped.is_empty() {
        Cow::Borrowed(fit)
    } else {
        Cow::Owned(handed_out::without(prepared, fit, dropped))
    }
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

/// Rivals that the samples cannot rule out, and what equal steps of the commands have to do with it.
fn open_questions(
    prepared: &PreparedSearch,
    end: &SearchEnd,
) -> (
    Vec<crate::diagnosis::evidence::rival::Rival>,
    Option<DataProblem>,
) {
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
    rivals.extend(aliases::under_another_noise(
        regression,
        fit,
        &end.other_ends,
    ));
    let settings = other_settings::open_settings(regression, fit);
    let equal_steps = super::equal_steps::equal_steps(prepared, &settings);
    let equal_steps =
        equal_steps.or_else(|| super::equal_steps::of_withdrawn(prepared, &end.withdrawn));
    rivals.extend(settings);
    (rivals, equal_steps)
}

/// Says which names were found and are not handed out, and that the search was stopped; whether there is anything of
/// the kind.
fn tell_what_is_open(
    prepared: &PreparedSearch,
    dropped: &[Term],
    unexplained: &mut Unexplained,
) -> bool {
    if !dropped.is_empty() {
        tell_dropped(unexplained, dropped, prepared.problem.session);
    }
    let ended = prepared.regression.work.ended();
    if let Some(why) = &ended {
        unexplained.present = true;
        let before = std::mem::take(&mut unexplained.description);
        unexplained.description = behind(why.describe().into(), before);
    }
    !dropped.is_empty() || ended.is_some()
}

/// The values with what no sample shows where it is expected; samples that are held out are predicted with it, and
/// where names stand in the model no worse than `identify` does.
fn completed<'a>(
    prepared: &PreparedSearch,
    values: &Values<'a>,
    names: usize,
    held_out: &mut HeldOut,
) -> Option<Values<'a>> {
    let completed = values.clone().completed();
    let apart = unseen::of_model(prepared, &completed.model);
    if let (Some(end_mm), Some(gaps)) = (apart, &mut held_out.gaps) {
        if names == 0 {
            gaps.identified_mm = end_mm;
        } else if end_mm > gaps.identified_mm {
            return None;
        }
        gaps.end_mm = end_mm;
    }
    Some(completed)
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

fn history(session: &Session, gap: &Gaps, held_out: &HeldOut, steps: &[Step]) -> Vec<ResidualStep> {
    let mut history = vec![ResidualStep {
        what: "nominal robot".to_owned(),
        gap_mm: gap.start_mm,
        held_out_mm: held_out.gaps.map(|g| g.start_mm),
        runs_held_out_mm: None,
    }];
    history.push(ResidualStep {
        what: base_in_words(&session.robot).to_owned(),
        gap_mm: gap.identified_mm,
        held_out_mm: held_out.gaps.map(|g| g.identified_mm),
        runs_held_out_mm: None,
    });
    history.extend(steps.iter().map(|step| ResidualStep {
        what: format!("with {}", step.term.name_on(&session.robot)),
        gap_mm: step.gap_mm[1],
        held_out_mm: step.held_out_mm.map(|h| h[1]),
        runs_held_out_mm: None,
    }));
    if let (Some(last), false) = (history.last_mut(), steps.is_empty()) {
        // The steps are those of the search; the last is what is handed out.
        last.gap_mm = gap.end_mm;
        last.held_out_mm = held_out.gaps.map(|g| g.end_mm);
    }
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
    rivals: &[&crate::diagnosis::evidence::rival::Rival],
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
