//! Terms that cancel each other where the robot was measured and run away elsewhere: two sags of many
//! millimetres whose difference is what the samples show. Such a model is right at every sample and wrong
//! at home.
//!
//! ```text
//! d = Σ_k J_k c_k              what the coefficients c of the names do together, mm
//! max |d| over the joint ranges  >  5 max |d| at the samples,     rms Σ_k |J_k c_k|  >  3 rms |d|
//! ```

use crate::effects::{Inputs, Term};
use crate::fit::base_model;
use crate::fit::expected::{along_joint, over_the_ranges};
use crate::fit::problem::Problem;
use crate::fit::spread::spread;
use crate::model::Model;

/// So many times as large as at any sample is far.
const FAR: f64 = 5.0;
/// Parts that are so many times as large as their sum cancel each other.
/// A model whose names do that at the samples, while their sum is far elsewhere, is not right there.
const CANCEL: f64 = 3.0;
/// Samples that are looked at.
const MOST_SAMPLES: usize = 1000;

/// How far the names of a model of several joints lead over the joint ranges, and at the samples, mm, where
/// they run away; `None` where they do not.
pub(crate) fn runs_away(problem: &Problem, model: &Model) -> Option<[f64; 2]> {
    if model.robot.joints.len() < 2 || problem.used.is_empty() {
        return None;
    }
    let measured = problem.inputs.select(&spread(&problem.used, MOST_SAMPLES));
    let here = TermDisplacements::of(model, &measured);
    if here.parts_mm <= CANCEL * here.together_mm {
        return None;
    }
    let ranges = TermDisplacements::of(model, &over_the_ranges(problem));
    let home = TermDisplacements::of(model, &along_joint(problem, &[0.0]));
    let most = ranges.largest_mm.max(home.largest_mm);
    (most > FAR * here.largest_mm).then_some([most, here.largest_mm])
}

/// What names do at some poses.
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
        let named: Vec<(usize, f64)> = model
            .columns()
            .zip(model.coefficients())
            .enumerate()
            .filter(|(_, ((term, _), _))| is_name(term))
            .map(|(column, (_, coefficient))| (column, coefficient))
            .collect();
        let (mut largest, mut together, mut parts, mut count) = (0.0_f64, 0.0, 0.0, 0_usize);
        model.visit(inputs, true, |_, block| {
            for i in 0..block.len {
                let (mut sum, mut apart) = ([0.0; 3], 0.0);
                for (column, coefficient) in &named {
                    let part: [f64; 3] =
                        std::array::from_fn(|axis| block.columns[*column][axis][i] * coefficient);
                    apart += crate::lanes::dot(part, part).sqrt();
                    sum = std::array::from_fn(|axis| sum[axis] + part[axis]);
                }
                let square = crate::lanes::dot(sum, sum);
                if square.is_finite() {
                    largest = largest.max(square.sqrt());
                    together += square;
                    parts += apart * apart;
                    count += 1;
                }
            }
        });
        let rms = |sum: f64| (sum / count.max(1) as f64).sqrt();
        Self {
            largest_mm: largest,
            together_mm: rms(together),
            parts_mm: rms(parts),
        }
    }
}
