//! Poses of a robot with several joints that determine most of its geometry, whatever is measured.
//!
//! Candidates are spread over the joint limits, for every way of measuring that the session has: its targets, anchors,
//! stations, planes, sockets. Where a target is held in a place a candidate is moved there; poses that the instrument
//! cannot see ([`super::line_of_sight`]) are excluded. They compete ([`super::candidate_set`]) in the information
//! about the whole base model ([`crate::fit::base_model`]), added to its weak priors and to what was measured already;
//! then what was chosen competes with poses around it. Which effects the poses show in addition to the geometry is a
//! matter of conditions ([`super::conditions`]).

use std::iter::repeat_n;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::candidate::{Candidate, Writing, anywhere, ranges};
use super::imagined::{extended, unmeasured, with_candidates};
use super::measuring_methods::{MeasuringMethod, ways};
use super::needs::test_load_kg;
use super::plan::Plan;
use super::plan_options::PlanOptions;
use crate::diagnosis::{DiagnoseError, NextPose};
use crate::fit::base_model;
use crate::fit::priors::Priors;
use crate::fit::problem::Problem;
use crate::kinematics::Range;
use crate::model::Model;
use crate::sessions::{Instrument, Session, Sigma};

/// Candidates of a round.
pub(super) const CANDIDATES: usize = 900;
/// Each of so many candidates has joints at the ends of their ranges, every joint with this share.
const ENDS_EVERY: usize = 3;
const ENDS: f64 = 0.25;
/// So many tries for each candidate that is wanted.
const TRIES: usize = 12;

/// A robot with several joints, how it is measured, and which conditions a technician can vary.
pub(crate) struct Arm {
    /// What was measured, and planned before.
    pub(crate) session: Session,
    /// All of the base model, where it is known to be.
    pub(crate) base: Model,
    pub(crate) priors: Priors,
    pub(crate) ranges: Vec<Range>,
    /// So many of the targets are there already.
    mounted: usize,
    pub(super) ways: Vec<MeasuringMethod>,
    pub(super) cone_rad: Option<f64>,
    pub(crate) seed: u64,
    /// The test load, kg; none: the load stays as it is.
    pub(crate) load_kg: Option<f64>,
    /// Whether the machine is measured cold and warm.
    pub(crate) heats: bool,
    /// Whether speeds are written down.
    speeds: bool,
}

impl Arm {
    /// A session as it is fitted, with these poses measured too.
    pub(crate) fn of_session(
        session: &Session,
        planned: &[NextPose],
        options: &PlanOptions,
    ) -> Result<Self, DiagnoseError> {
        let diagnosis = &options.diagnosis;
        let mut problem = Problem::observing(session, diagnosis.joint_values);
        if problem.samples() == 0 {
            return Err(DiagnoseError::NothingToFit);
        }
        let start = base_model::start(session, &problem, |id| diagnosis.allowed.exists(id));
        let fitted = base_model::fit(&mut problem, &start, true).solution.model;
        let priors = problem.priors.of_any_robot();
        let ranges = ranges(&session.robot, Some(&problem.inputs));
        let samples = &session.samples;
        let points = session.has_plain_points();
        let heaviest = samples.load_kg.iter().flatten().copied();
        let load_kg = test_load_kg(options.load_kg, heaviest.fold(0.0, f64::max));
        let loads = samples.load_kg.is_some() || points && session.robot.gravity_m_s2.is_some();
        let mut session = session.clone();
        let own = session.instrument.tracker.map(|t| t.position_mm);
        let from = own.or(options.instrument_mm);
        let per_axis = matches!(session.instrument.sigma_mm, Some(Sigma::PerAxis(_)));
        if let Some(sigma_mm) = options.sigma_mm {
            session.instrument.sigma_mm = Some(Sigma::Overall(sigma_mm));
            session.instrument.tracker = None;
        } else if points && !per_axis {
            // The noise is that of the residuals, in the mean of the axes that were measured.
            let unit = problem.noise.as_ref().map_or(1.0, |noise| {
                let of = noise.sigma_mm.iter().zip(&problem.axis_weights);
                let squares = of.filter(|own| *own.1 > 0.0).map(|own| own.0 * own.0);
                (squares.sum::<f64>() / problem.axes().max(1) as f64).sqrt()
            });
            session.instrument.sigma_mm = Some(Sigma::Overall(unit * priors.variance.sqrt()));
        }
        // Of the fit the values alone: what is held there may be shown by other poses.
        let base = start.with_each(|_, term| {
            if let Some(own) = fitted.terms().iter().find(|t| t.same_column(term)) {
                term.coefficients.clone_from(&own.coefficients);
            }
        });
        let ways = ways(&session, from);
        if !planned.is_empty() {
            session = extended(&session, &base, planned, &session.targets);
        }
        Ok(Self {
            base,
            mounted: session.targets.len(),
            ways,
            cone_rad: options.cone_rad,
            seed: diagnosis.seed,
            session,
            priors,
            ranges,
            load_kg: loads.then_some(load_kg),
            heats: samples.temperature_c.is_some() || points,
            speeds: samples.speed.iter().any(Option::is_some),
        })
    }

    /// A robot that was not measured, seen from a place in its base frame.
    pub(crate) fn of_robot(plan: &Plan, options: &PlanOptions) -> Self {
        let (robot, targets) = (&plan.robot, &plan.targets);
        let way = |target: usize| MeasuringMethod {
            like: None,
            places: Vec::new(),
            target: u32::try_from(target).unwrap_or(0),
            held: None,
            from: options.instrument_mm,
        };
        let mut arm = Self {
            session: unmeasured(robot, targets, Some(plan.sigma_mm)),
            base: Model::nominal(robot.clone()),
            priors: Priors::unmeasured(Instrument::default().targets_sigma_mm),
            ranges: ranges(robot, None),
            // Away from the tool's origin a target has to be mounted first.
            mounted: 1,
            ways: (0..targets.len()).map(way).collect(),
            cone_rad: options.cone_rad,
            seed: options.diagnosis.seed,
            load_kg: robot
                .gravity_m_s2
                .map(|_| test_load_kg(options.load_kg, 0.0)),
            heats: true,
            speeds: true,
        };
        let some = arm.candidates(8 * targets.len(), false, &mut arm.random(0));
        let some = arm.with(&some, false);
        let problem = Problem::observing(&some, crate::effects::JointValues::Commanded);
        arm.base = base_model::start(&some, &problem, |_| true);
        arm
    }

    pub(crate) fn random(&self, stream: u64) -> ChaCha8Rng {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed ^ 0x00a2_3d07);
        random.set_stream(stream);
        random
    }

    /// Poses over the joint ranges, in all ways of measuring in turn; with `ends` many have joints at the
    /// ends of their ranges.
    pub(crate) fn candidates(
        &self,
        count: usize,
        ends: bool,
        random: &mut ChaCha8Rng,
    ) -> Vec<Candidate> {
        let drawn = (0..count * TRIES).map(|k| {
            let mut q = anywhere(&self.ranges, random);
            for (q, range) in q.iter_mut().zip(&self.ranges) {
                let (at_end, low) = (random.random::<f64>() < ENDS, random.random::<bool>());
                if ends && k % ENDS_EVERY == 0 && at_end {
                    *q = if low { range.from } else { range.to };
                }
            }
            (q, k / ENDS_EVERY % self.ways.len().max(1))
        });
        let measurable = drawn.filter_map(|(q, way)| self.measurable(q, way));
        measurable.take(count).collect()
    }

    /// Poses around these, each in the same way.
    pub(crate) fn around(
        &self,
        chosen: &[Candidate],
        near: f64,
        random: &mut ChaCha8Rng,
    ) -> Vec<Candidate> {
        let each = CANDIDATES.div_ceil(chosen.len().max(1)).max(2);
        let drawn = chosen.iter().flat_map(|like| repeat_n(like, each));
        let measurable = drawn.filter_map(|like| {
            let one = |(q, range): (&f64, &Range)| {
                let share = near * (2.0 * random.random::<f64>() - 1.0);
                (q + share * (range.to - range.from)).clamp(range.from, range.to)
            };
            let q = like.q.iter().zip(&self.ranges).map(one);
            self.measurable(q.collect(), like.way)
        });
        measurable.collect()
    }

    /// A pose near these joint values, if there is one that can be measured in this way.
    fn measurable(&self, mut q: Vec<f64>, way: usize) -> Option<Candidate> {
        self.session.robot.follow(&mut q);
        let brought = self.ways[way].brought(way, &self.session, &self.base, &self.ranges, q);
        brought.filter(|candidate| self.sees(candidate))
    }

    /// How poses are written down whose conditions are varied, or are not.
    pub(crate) fn writing(&self, varied: bool) -> Writing<'_> {
        Writing {
            targets: &self.session.targets,
            mounted: self.mounted,
            speeds: varied && self.speeds,
            loads: varied && self.load_kg.is_some(),
            temperatures: varied && self.heats,
        }
    }

    /// The session with these poses measured too.
    pub(crate) fn with(&self, candidates: &[Candidate], varied: bool) -> Session {
        let (session, writing) = (&self.session, &self.writing(varied));
        let like = |way: usize| self.ways[way].like;
        with_candidates(session, &self.base, candidates, like, writing)
    }
}
