//! From the end of the search to the answer: refits on all samples, and the evidence of every step.

use crate::effects::{JointValues, Term, called};
use crate::fit::base_model;
use crate::fit::expected::expected_error;
use crate::model::SetUp;
use crate::observations::KINDS;
use crate::observations::figures::KindFigures;
use crate::odds;
use crate::sessions::{Session, SessionCorrection};
use crate::text::Text;

use super::history::history;
use super::named::Named;
use super::named_effects::found;
use super::open_questions::{OpenQuestions, Planner, equivalents};
use super::predicting::Predicting;
use super::remainder::unexplained;
use super::repeatability::robot_mm;
use super::values::Values;
use super::{gross, judgement, limits};
use crate::answers::diagnosis::{Diagnosis, Unexplained};
use crate::answers::identification::Identification;
use crate::answers::noise::Noise;
use crate::answers::pose::to_raw;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::search::SearchResult as SearchEnd;
use crate::diagnosis::search::floor;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::diagnosis::{DiagnoseError, Progress, Watch};
use crate::set_up_errors::CorrectedSession;

/// The answer of the end of a search.
pub(crate) fn answer(
    corrected: &CorrectedSession,
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
    let (session, regression) = (&corrected.session, &prepared.regression);
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
    let mut unexplained = unexplained(prepared, end, session);
    judgement::judge(
        prepared,
        end,
        &named.judged,
        &floor,
        &figures.held_out,
        &mut unexplained,
    );
    report_open_questions(prepared, &named.dropped, &mut unexplained);
    // What predicts without a name joins the model once the names are evaluated; their fits are then freed.
    regression.forget();
    let with = Predicting::with(prepared, &named, found.len(), &unexplained);
    let mut identification = identification(prepared, &named.alone, &with.values);
    let outliers = &mut identification.outliers;
    // In ascending order.
    outliers.retain(|outlier| with.come_back.binary_search(&outlier.sample).is_err());
    let with = with.unless_little_is_shown(prepared, &identification);
    let gross = gross::beyond_noise(
        prepared,
        &floor,
        &with.figures.gap,
        &identification,
        &corrected.problems,
    );
    if let Some(why) = gross {
        report_gross_error(why, with.figures.gap.end_mm, &mut unexplained);
    }
    Ok(Diagnosis {
        session: session.name.clone(),
        samples: session.samples.len(),
        verdict: judgement::of(found.is_empty(), unexplained.present),
        data_problems: [
            &*corrected.problems,
            prepared.incomplete.as_slice(),
            open.equal_steps.as_slice(),
            identification.many_set_aside().as_slice(),
            identification.far_tool().as_slice(),
        ]
        .concat(),
        stopped: regression.work.ended(),
        floor,
        equivalent: equivalents(&open.rivals, &end.fit, &proposal, |t| named.is_dropped(t)),
        unexplained,
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

/// An error larger than any noise is unexplained, whatever the floor.
fn report_gross_error(why: Text, end_mm: f64, unexplained: &mut Unexplained) {
    if !unexplained.present {
        unexplained.present = true;
        unexplained.place = None;
        unexplained.rms_mm = end_mm;
    }
    unexplained.description = behind(why, std::mem::take(&mut unexplained.description));
}

/// The noise as reported. Of several kinds of measurement the search knows one number, which replaces σ of each; in mm
/// it is the RMS residual of lengths.
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

/// Reports which names were found and are not handed out, and that the search was stopped.
fn report_open_questions(
    prepared: &PreparedSearch,
    dropped: &[Term],
    unexplained: &mut Unexplained,
) {
    if !dropped.is_empty() {
        report_dropped(unexplained, dropped, prepared.problem.session);
    }
    if let Some(why) = prepared.regression.work.ended() {
        unexplained.present = true;
        let before = std::mem::take(&mut unexplained.description);
        unexplained.description = behind(why.describe().into(), before);
    }
}

/// The model that is handed out, in the form of `identify`.
fn identification(prepared: &PreparedSearch, fit: &Fit, own: &Values) -> Identification {
    let held = prepared.not_identifiable.clone();
    let mut identification = own.identification(&prepared.nominal, held);
    add_unseen_errors(prepared, fit, &mut identification.kinds);
    if base_model::is_arm(own.problem.session) {
        let covariance = own.covariance.as_ref();
        identification.expected = covariance
            .and_then(|c| expected_error(&own.problem, &own.model, c, own.is_completed()));
    }
    identification
}

/// Adds the errors on unseen samples to those of every kind.
fn add_unseen_errors(prepared: &PreparedSearch, fit: &Fit, kinds: &mut [KindFigures]) {
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

/// The set-up corrections that a session had in memory; where its fit starts from the values read back, they
/// take the place of the commanded ones.
fn set_up(session: &Session, joint_values: JointValues) -> SetUp {
    let made = session.samples.corrected.iter();
    let made = made.flat_map(|corrected| corrected.by.clone());
    let read = (joint_values == JointValues::Read).then_some(SessionCorrection::TakeReadBack);
    SetUp::new(made.chain(read))
}

/// Reports which names were found and are not handed out.
fn report_dropped(unexplained: &mut Unexplained, dropped: &[Term], session: &Session) {
    let names: Vec<String> = dropped
        .iter()
        .map(|term| term.name_on(&session.robot))
        .collect();
    let clause = text!(
        "the RMS error of the samples, fitted or cross-validated, is no smaller with {effects}, or what it does runs away over the joint ranges: not handed out",
        effects = Text::listed(names.iter().map(|name| called(name)), ", ")
    );
    unexplained.description = behind(clause, std::mem::take(&mut unexplained.description));
    unexplained.present = true;
    unexplained.p = unexplained.p.min(odds::TAKEN.chance());
    unexplained.resembles.extend(names);
}

/// A clause in front of those before it.
fn behind(clause: Text, before: Text) -> Text {
    if before.is_empty() {
        clause
    } else {
        text!("{first}; {next}", first = clause, next = before)
    }
}
