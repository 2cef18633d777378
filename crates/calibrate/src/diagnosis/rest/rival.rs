//! Names over a joint and a curve over it beside the same base, each a group of columns: how likely the samples are with
//! some of the names, with or without the curve, is said in one currency, the restricted likelihood of groups
//! ([`groups`](super::groups)).

use nalgebra::DMatrix;

use crate::effects::Term;
use crate::fit::noise::Noise;
use crate::fit::problem::Problem;
use crate::model::Model;

use super::MOST_KNOTS;
use super::columns::Columns;
use super::groups::Remaining;
use super::kernels::Kernels;

/// With fewer different values of a joint no curve is more than a name.
const FEWEST_VALUES: usize = 3;

/// Names over a joint, and a curve over it.
pub(crate) struct Contest {
    /// Columns of the names, then of the curve's values at its knots.
    remaining: Remaining,
    /// Of each column of a name, which.
    of_name: Vec<usize>,
    kernels: Option<Kernels>,
}

/// How likely the samples are, as logarithms.
pub(crate) struct Standing {
    /// With the names alone.
    pub(crate) ln_evidence: f64,
    /// The curve beside them.
    pub(crate) curve: Option<FreeCurve>,
}

/// A curve, common to both sides.
pub(crate) struct FreeCurve {
    /// How much likelier the samples are with it, as a logarithm.
    pub(crate) ln_odds: f64,
    /// Pieces of a polygon that says as much.
    pub(crate) pieces: usize,
    /// In which direction it is largest: along the motion, the radius, the axis.
    pub(crate) direction: usize,
}

impl Contest {
    /// Of names of a model over a joint, beside its other terms and a noise.
    pub(crate) fn new(
        problem: &Problem,
        noise: &Noise,
        model: &Model,
        joint: usize,
        names: &[Term],
    ) -> Option<Self> {
        let (columns, own) = Columns::together(problem, noise, model, (joint, names));
        let values = columns.values.len();
        let knots = columns.knots(values.clamp(4, MOST_KNOTS));
        // What pulls at the ends of one of several joints is the geometry's as much.
        let is_single = model.robot.joints.len() == 1;
        let kernels =
            (values >= FEWEST_VALUES).then(|| Kernels::new(knots.count, false, is_single));
        let block = &columns.blocks[0];
        let first = own.ncols();
        let both = match kernels {
            Some(_) => {
                let curve = block.curve(&columns, &knots, 1);
                let mut both = own.resize_horizontally(first + curve.ncols(), 0.0);
                both.columns_mut(first, curve.ncols()).copy_from(&curve);
                both
            }
            None => own,
        };
        let whitened = block.whitened(&both);
        let is = |term: &Term| names.iter().position(|name| name.same_column(term));
        Some(Self {
            remaining: Remaining::of(&whitened.products(&block.measured))?,
            of_name: model.columns().filter_map(|(term, _)| is(term)).collect(),
            kernels: kernels.flatten(),
        })
    }

    /// With those of the names that are kept.
    pub(crate) fn standing(&self, is_kept: impl Fn(usize) -> bool) -> Option<Standing> {
        let names = self.of_name.len();
        let own: Vec<usize> = (0..names).filter(|k| is_kept(self.of_name[*k])).collect();
        let (ln_evidence, rest) = self.remaining.beside(&own, names)?;
        let kernels = self.kernels.as_ref();
        let curve = kernels.and_then(|kernels| FreeCurve::likeliest(kernels, &rest));
        Some(Standing { ln_evidence, curve })
    }
}

impl FreeCurve {
    fn likeliest(kernels: &Kernels, rest: &Remaining) -> Option<Self> {
        let (prior, ln_odds) = kernels.likeliest(rest)?;
        let values = kernels.fit(rest, &prior)?.values();
        let by_part = DMatrix::from_vec(kernels.knots(), prior.len(), values.data.into());
        let size = |direction: &usize| by_part.column(*direction).norm();
        let largest = (0..prior.len()).max_by(|a, b| size(a).total_cmp(&size(b)));
        Some(Self {
            ln_odds,
            pieces: Kernels::pieces(&prior).ceil() as usize,
            direction: largest.unwrap_or(0),
        })
    }
}
