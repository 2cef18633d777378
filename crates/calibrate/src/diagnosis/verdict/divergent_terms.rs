//! Divergent terms: terms that cancel each other where the robot was measured and run away elsewhere, such as two sags
//! of many millimetres whose difference is what the samples show. Such a model is right at every sample and wrong at
//! home.
//!
//! ```text
//! d   = p(all) − p(none)       what the names do together, mm
//! d_k = p(k alone) − p(none)   what one of them does
//! max |d| over the joint ranges  >  5 max |d| at the samples,     rms Σ_k |d_k|  >  3 rms |d|
//! ```

use crate::effects::{Inputs, Term};
use crate::fit::base_model;
use crate::fit::problem::Problem;
use crate::fit::ranges::{along_joint, over_the_ranges};
use crate::fit::spread::spread;
use crate::model::{Model, Positions};
use crate::{budget, thresholds};

/// Parts that are so many times as large as their sum cancel each other.
/// A model whose names do that at the samples, while their sum is far elsewhere, is not right there.
const CANCEL: f64 = 3.0;

/// The largest joint effect of the names of a model of several joints over the joint ranges, and at the samples, mm,
/// where they run away; `None` where they do not.
pub(crate) fn runs_away(problem: &Problem, model: &Model) -> Option<[f64; 2]> {
    if model.robot.joints.len() < 2 || problem.used.is_empty() {
        return None;
    }
    let measured = problem
        .inputs
        .select(&spread(&problem.used, budget::SAMPLES));
    let here = TermDisplacements::of(model, &measured);
    if here.parts_mm <= CANCEL * here.together_mm {
        return None;
    }
    let ranges = TermDisplacements::of(model, &over_the_ranges(problem));
    let home = TermDisplacements::of(model, &along_joint(problem, &[0.0]));
    let most = ranges.largest_mm.max(home.largest_mm);
    (most > thresholds::FAR * here.largest_mm).then_some([most, here.largest_mm])
}

/// The joint effect of names at some poses.
struct TermDisplacements {
    /// Longest, mm.
    largest_mm: f64,
    /// Root mean square length, mm.
    together_mm: f64,
    /// The same of the sum of the lengths of all parts, mm.
    parts_mm: f64,
}

impl TermDisplacements {
    fn of(model: &Model, inputs: &Inputs) -> Self {
        let is_name = |term: &Term| !base_model::belongs(term.effect.about().id);
        let base = model.without(is_name);
        let without = base.predict(inputs);
        let all = model.predict(inputs);
        // Not by columns: what an order or a phase does is not its column times its value.
        let names = model.terms().iter().filter(|term| is_name(term));
        let alone: Vec<Positions> = names
            .map(|term| base.with_term(term.clone()).predict(inputs))
            .collect();
        let (mut largest, mut together, mut parts, mut count) = (0.0_f64, 0.0, 0.0, 0_usize);
        for i in 0..inputs.len() {
            let from = without.get(i);
            let part = |positions: &Positions| {
                let [x, y, z] = positions.get(i);
                (x - from[0]).hypot(y - from[1]).hypot(z - from[2])
            };
            let sum = part(&all);
            let apart: f64 = alone.iter().map(part).sum();
            if sum.is_finite() && apart.is_finite() {
                largest = largest.max(sum);
                together += sum * sum;
                parts += apart * apart;
                count += 1;
            }
        }
        let rms = |sum: f64| (sum / count.max(1) as f64).sqrt();
        Self {
            largest_mm: largest,
            together_mm: rms(together),
            parts_mm: rms(parts),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::JointValues;
    use crate::sessions::load;

    fn gear(order: f64, amplitude_deg: f64, phase_deg: f64) -> Term {
        let parameters = [
            ("amplitude_deg", amplitude_deg),
            ("order", order),
            ("phase_deg", phase_deg),
        ];
        Term::from_parameters("gear-transmission-error", 1, &parameters, 6).unwrap()
    }

    /// Near one another their columns nearly cancel at the samples however large they are.
    #[test]
    fn orders_that_cancel_each_other_run_away() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../sessions/arm/arm.json");
        let session = load(std::path::Path::new(path)).unwrap().session;
        let mut problem = Problem::new(&session, JointValues::Commanded);
        // Measured near home only: over the ranges the difference of two orders grows.
        for (used, q) in problem.used.iter_mut().zip(&session.samples.q[0]) {
            *used &= q.to_degrees().abs() < 20.0;
        }
        let with = |terms: [Term; 2]| {
            let base = Model::nominal(session.robot.clone());
            terms
                .into_iter()
                .fold(base, |model, term| model.with_term(term))
        };
        let small = with([gear(9.0, 0.02, 10.0), gear(8.0, 0.03, 50.0)]);
        assert_eq!(runs_away(&problem, &small), None);
        let large = with([gear(9.0, 40.0, 0.0), gear(8.999, 40.0, 180.0)]);
        assert!(runs_away(&problem, &large).is_some());
    }
}
