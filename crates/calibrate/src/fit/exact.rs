//! The exact identification: nonlinear least squares in the measuring frame, for any effects.
//!
//! Suspected outliers are found by fitting, inspecting the residuals, and fitting again without them until nothing
//! changes. Where the instrument's noise is given as one number the ratio between the axes is taken from the
//! residuals.

use crate::answers::identification::{Identification, NotIdentifiable};
use crate::effects::{
    Effect, JointValues, OF_A_SINGLE_AXIS, Role, Survey, Term, called, find, form_in, role,
};
use crate::model::Model;
use crate::model::names::name_on_joint;
use crate::sessions::Session;
use crate::text::Text;

use nalgebra::DMatrix;

use super::answer::{covariance_of, parameters_of, report};
use super::base_model::Fitted;
use super::estimator::fit_without_outliers;
use super::expected::expected_error;
use super::levels::levels;
use super::problem::{Problem, Watch};
use super::solver::{Solution, Stopped};
use super::unseen::completed;
use super::{IdentifyError, base_model, observed, scan, specification};

/// The effects that every calibration identifies.
pub const DEFAULT_EFFECTS: [&str; 2] = OF_A_SINGLE_AXIS;

/// Fits the named effects, each on every joint where it can be tested.
///
/// # Errors
/// An unknown effect, or no sample to fit.
pub fn identify_exact(
    session: &Session,
    effects: &[String],
    values: JointValues,
) -> Result<Identification, IdentifyError> {
    identify_watched(session, effects, &[], true, values, &|| true)
}

/// Like [`identify_exact`], with terms in addition to the named effects whose settings (orders, times) are known, from
/// a diagnosis: they are fitted too, from where they are, and nothing is scanned for them. A named effect that is
/// among them already is not fitted twice. Without `priors` nothing holds the geometry of several joints where few
/// poses determine it. Asks before every pass over the samples whether to go on.
///
/// # Errors
/// As [`identify_exact`], and [`IdentifyError::Cancelled`] where `keep_going` said no.
pub fn identify_watched(
    session: &Session,
    effects: &[String],
    initial_terms: &[Term],
    priors: bool,
    values: JointValues,
    keep_going: &dyn Fn() -> bool,
) -> Result<Identification, IdentifyError> {
    let session = &*session.whole()?;
    let mut prepared = prepare(session, effects, initial_terms, values, keep_going)?;
    if !priors {
        prepared.base = prepared.base.without_priors();
    }
    Ok(Fresh::fitted(prepared, keep_going)?.report(session))
}

/// A fit from all samples, with what it was made of.
pub(super) struct Fresh<'a> {
    /// The samples.
    pub(super) problem: Problem<'a>,
    pub(super) fitted: Solution,
    /// The robot without the terms.
    nominal: Model,
    /// Effects that were asked for and cannot be fitted.
    pub(super) not_identifiable: Vec<NotIdentifiable>,
    /// Other notes.
    notes: Vec<Text>,
    base: BaseModel,
    /// Its covariance, where that comes from what each pose pulls.
    by_pose: Option<DMatrix<f64>>,
}

impl<'a> Fresh<'a> {
    pub(super) fn fitted(
        prepared: FitStart<'a>,
        keep_going: &dyn Fn() -> bool,
    ) -> Result<Self, IdentifyError> {
        let FitStart {
            mut problem,
            start,
            nominal,
            mut not_identifiable,
            base,
        } = prepared;
        let mut by_pose = None;
        let (fitted, notes) = if base == BaseModel::Absent {
            (fit_without_outliers(&mut problem, &start), Vec::new())
        } else {
            let priors = base == BaseModel::WithPriors;
            let Fitted {
                mut solution,
                held,
                mut notes,
            } = base_model::fit(&mut problem, &start, priors);
            not_identifiable.extend(held);
            if let Some(alike) = specification::alike(&mut problem, &solution) {
                if problem.inputs.pose.is_some() {
                    notes.push(text!("the reflectors of a pose are off as no lack of repeatability would have them: something is there in every pose that the geometry lacks, and every row counts alike"));
                }
                solution = alike.solution;
                by_pose = Some(alike.covariance);
            }
            (solution, notes)
        };
        if fitted.stopped == Stopped::Cancelled || !keep_going() {
            return Err(IdentifyError::Cancelled);
        }
        Ok(Self {
            problem,
            fitted,
            nominal,
            not_identifiable,
            notes,
            base,
            by_pose,
        })
    }

    pub(super) fn report(self, session: &Session) -> Identification {
        let Self {
            problem,
            fitted,
            nominal,
            not_identifiable,
            notes,
            base,
            by_pose,
        } = self;
        let is_arm = base != BaseModel::Absent && base_model::is_arm(session);
        let seen = by_pose.clone().or_else(|| covariance_of(&problem, &fitted));
        let completed = is_arm
            .then(|| completed(&problem, &fitted, seen.as_ref()))
            .flatten();
        let is_completed = completed.is_some();
        let (mut shown, own) = completed.map_or((fitted, by_pose), |c| (c.solution, c.covariance));
        // A fit that was repeated has a fade besides its setting, which no model's file holds.
        shown.model = shown.model.settled();
        let mut answer = report(session, &problem, shown.clone(), &nominal, not_identifiable);
        answer.notes.extend(notes);
        if let Some(own) = own {
            answer.parameters = parameters_of(&problem, &shown, Some(&own)).concat();
            answer.covariance = Some(own);
        }
        if is_arm {
            answer.levels = levels(&problem, &answer.model);
            let own = answer.covariance.as_ref();
            let expected = |c| expected_error(&problem, &answer.model, c, is_completed);
            answer.expected = own.and_then(expected);
        }
        answer
    }
}

/// The start of a fit.
pub(super) struct FitStart<'a> {
    /// The samples.
    pub(super) problem: Problem<'a>,
    /// The terms to fit, with their best settings.
    pub(super) start: Model,
    /// The robot without them.
    pub(super) nominal: Model,
    /// Effects that were asked for and cannot be fitted.
    pub(super) not_identifiable: Vec<NotIdentifiable>,
    base: BaseModel,
}

/// The terms that are fitted with every name where joint values alone do not determine them: the geometry of several
/// joints, and the unknown places of other measurements than points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum BaseModel {
    Absent,
    /// Nothing holds what few poses show.
    WithoutPriors,
    /// Weak priors on the geometry do.
    WithPriors,
}

impl BaseModel {
    fn without_priors(self) -> Self {
        match self {
            Self::Absent => Self::Absent,
            Self::WithoutPriors | Self::WithPriors => Self::WithoutPriors,
        }
    }
}

/// Looks which of the effects the session can show, and scans those with a setting.
pub(super) fn prepare<'a>(
    session: &'a Session,
    effects: &[String],
    initial_terms: &[Term],
    values: JointValues,
    keep_going: &'a dyn Fn() -> bool,
) -> Result<FitStart<'a>, IdentifyError> {
    let mut problem = Problem::observing(session, values);
    problem.watch = Watch::by(keep_going);
    if problem.samples() == 0 {
        return Err(IdentifyError::NothingToFit);
    }
    let survey = Survey::new(session, &problem.inputs);
    let mut not_identifiable = Vec::new();
    let mut terms = Vec::new();
    let base = base_model::is_arm(session) && asks_for_base(effects);
    for id in effects {
        if base && role(id) == Role::ToolRadius {
            continue;
        }
        let effect = find(id).ok_or_else(|| IdentifyError::UnknownEffect(id.clone()))?;
        let places = places(effect, &survey);
        let is_known = initial_terms.iter().any(|t| t.effect.about().id == id);
        if let Some(because) = same_everywhere(&places).filter(|_| !is_known) {
            not_identifiable.push(NotIdentifiable {
                combination: called(id),
                because,
            });
            continue;
        }
        for (joint, obstacle) in places {
            let there = |t: &Term| t.effect.about().id == id && t.joint == joint;
            match obstacle {
                _ if initial_terms.iter().any(there) => {}
                Some(because) => not_identifiable.push(NotIdentifiable {
                    combination: name_on_joint(effect, joint, &session.robot),
                    because,
                }),
                None => terms.push(Term::absent(form_in(effect, &survey, joint), joint, 0.0)),
            }
        }
    }
    if base {
        let known = |id: &str| terms.iter().any(|t: &Term| t.effect.about().id == id);
        let new = base_model::terms(session, &problem, |id| !known(id));
        terms.extend(new);
    } else {
        terms.extend(base_model::extra_terms(session, &problem));
    }
    let nominal = Model::nominal(session.robot.clone());
    let base = base || problem.observed.is_some();
    let placed = Model::new(session.robot.clone(), terms.clone());
    let placed = observed::nominal_of(session, problem.observed.as_ref(), &placed);
    let start = scan::with_best_settings(&problem, &nominal, terms);
    let start = initial_terms
        .iter()
        .fold(start, |model, term| model.with_term(term.clone()));
    Ok(FitStart {
        problem,
        start,
        nominal: placed,
        not_identifiable,
        base: if base {
            BaseModel::WithPriors
        } else {
            BaseModel::Absent
        },
    })
}

/// Whether these are the effects of every calibration, or more: then those of several joints have
/// their geometry as well.
fn asks_for_base(effects: &[String]) -> bool {
    let named = |id: &str| effects.iter().any(|e| e == id);
    DEFAULT_EFFECTS.iter().all(|id| named(id))
}

fn places(effect: &Effect, survey: &Survey) -> Vec<(usize, Option<Text>)> {
    let joints = if effect.about().per_joint {
        survey.joints.len()
    } else {
        1
    };
    (0..joints)
        .map(|joint| (joint, effect.obstacle(survey, joint)))
        .collect()
}

/// The common reason against an effect on every joint, if there is one.
fn same_everywhere(places: &[(usize, Option<Text>)]) -> Option<Text> {
    let first = places.first()?.1.clone()?;
    places
        .iter()
        .all(|(_, obstacle)| obstacle.as_ref() == Some(&first))
        .then_some(first)
}
