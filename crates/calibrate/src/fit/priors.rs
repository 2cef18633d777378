//! Weak prior knowledge of a robot's geometry, as rows of the least-squares problem: `x/σ ~ N(0, 1)`.
//!
//! ```text
//! c(x) = Σ rᵀ W r + s² Σ (x_k/σ_k)²
//! ```
//!
//! with s² the variance of a coordinate of weight one. σ are weak expectations (half a link of 1 mm and 2 mrad is
//! usual), so that many poses determine everything and thirty do not diverge. They keep a poorly determined direction
//! near its nominal value; a parameter that is not identifiable at all is held at zero instead
//! ([`super::base_model`]), so no prior makes it look determined. The place of a target in the tool is knowledge of
//! another kind: the session states it (`targets_sigma_mm`), and it remains when the weak priors are switched off.
//!
//! Source: Tarantola, *Inverse Problem Theory*, 2005, ch. 3; for robots Hollerbach & Wampler, *The
//! calibration index and taxonomy for robot kinematic calibration methods*, 1996.

use crate::effects::{Role, Setting, TOOL_POSITION, Term};
use crate::kinematics::JointKind;
use crate::model::Model;

/// A prior that is missed by so many σ was wrong, and is dropped.
/// Priors of an arm: tool 50 mm, frame 20 mm and 20 mrad, links 1 mm and 2 mrad, zeros 50 mrad;
/// `--no-prior` leaves them out.
pub(crate) const MISSED: f64 = 4.0;

/// Weak priors on the geometry, as rows of the least-squares problem.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Priors {
    /// Whether the weak ones hold.
    pub weak: bool,
    /// Whether the instrument was aligned with the base.
    pub aligned: bool,
    /// σ of a target's own place, mm; `None`: not known.
    pub targets_mm: Option<f64>,
    /// Variance of a coordinate of weight one.
    pub variance: f64,
    /// The factors by which the weak ones of this robot's zero offsets, of its links, and of its set-up (tool, frame)
    /// are narrower, as logarithms ([`super::prior_scale`]).
    pub(super) ln_scale: [f64; 3],
    /// The size of everything, where no measurement shows it: a sum of coefficients that is held at zero
    /// ([`crate::observations::gauge`]).
    pub(super) size: Vec<(Key, f64)>,
    /// Those that were let go: effect, joint, setting, coefficient.
    pub(super) freed: Vec<Key>,
}

/// Which coefficient: effect, joint, setting, coefficient.
pub(super) type Key = (&'static str, usize, u64, usize);

impl Priors {
    /// Of a robot that was not measured, by an instrument that was not aligned.
    pub(crate) fn unmeasured(targets_mm: Option<f64>) -> Self {
        Self {
            weak: true,
            targets_mm,
            variance: 1.0,
            ..Self::default()
        }
    }

    /// Standard deviation of a coefficient's prior, inner units; `None` without a prior.
    pub fn sigma(&self, model: &Model, term: &Term, coefficient: usize) -> Option<f64> {
        if !self.holds(term, coefficient) {
            return None;
        }
        let about = term.effect.about();
        if of_one_target(term) {
            return self.targets_mm;
        }
        if !self.weak {
            return None;
        }
        let prior = about.priors.get(coefficient)?;
        let holds = self.aligned || !prior.if_aligned;
        let scale = group(term).map_or(1.0, |own| self.ln_scale[own].exp());
        holds.then(|| match model.robot.joints[term.joint].kind {
            JointKind::Revolute => scale * prior.sigma,
            JointKind::Prismatic => scale * prior.sigma_on_slide,
        })
    }

    /// The number of a model's coefficients with a prior of this robot's own width.
    pub(super) fn of_its_own(&self, model: &Model) -> usize {
        let is_own = |(term, k): &(&Term, usize)| {
            let own = group(term);
            let narrowed = own.is_some_and(|own| self.ln_scale[own] < 0.0);
            narrowed && !term.held.contains(*k) && self.sigma(model, term, *k).is_some()
        };
        model.columns().filter(is_own).count()
    }

    /// The same priors for any robot.
    pub(crate) fn of_any_robot(&self) -> Self {
        Self {
            ln_scale: [0.0; 3],
            ..self.clone()
        }
    }

    /// The same priors, as wide as others are.
    pub(crate) fn as_wide_as(&self, other: &Self) -> Self {
        Self {
            ln_scale: other.ln_scale,
            ..self.clone()
        }
    }

    /// Whether no prior of a coefficient was dropped.
    pub(super) fn holds(&self, term: &Term, coefficient: usize) -> bool {
        !self.freed.contains(&key(term, coefficient))
    }

    /// The same of the place of this target, counted from 0.
    pub(super) fn holds_target(&self, target: usize) -> bool {
        let own = (
            TOOL_POSITION.about().id,
            0,
            (target as f64 + 1.0).to_bits(),
            0,
        );
        !self.freed.contains(&own)
    }

    /// Lets go of what the session states of the place of this target, counted from 0.
    pub(super) fn free_target(&mut self, target: usize) {
        let setting = (target as f64 + 1.0).to_bits();
        let own = (0..3).map(|k| (TOOL_POSITION.about().id, 0, setting, k));
        self.freed.extend(own);
    }

    /// The weights of the size for the coefficients of a model; zero for what is held.
    pub(super) fn size_row(&self, model: &Model) -> Vec<f64> {
        let mut row = Vec::new();
        for term in model.terms() {
            for k in 0..term.coefficients.len() {
                let own = self.size.iter().find(|(of, _)| *of == key(term, k));
                let free = !term.held.contains(k);
                row.push(own.filter(|_| free).map_or(0.0, |own| own.1));
            }
        }
        row
    }

    /// The usual size of each coefficient of a model, whether or not the weak priors hold; of a frame only where it is
    /// `aligned`.
    pub(super) fn usual(&self, model: &Model, aligned: bool) -> Vec<Option<f64>> {
        let all = Self {
            weak: true,
            aligned,
            targets_mm: self.targets_mm,
            ..Self::default()
        };
        model
            .columns()
            .map(|(term, k)| {
                let placed = !of_one_target(term) || self.holds(term, k);
                let free = placed && !term.held.contains(k);
                all.sigma(model, term, k).filter(|_| free)
            })
            .collect()
    }

    /// Those that a fit has missed by many σ.
    pub(super) fn missed(&self, model: &Model) -> Vec<(Term, usize)> {
        let mut missed = Vec::new();
        let usual = self.of_any_robot();
        for term in model.terms() {
            for (k, value) in term.coefficients.iter().enumerate() {
                let beyond = |sigma: f64| value.abs() > MISSED * sigma;
                if !term.held.contains(k) && usual.sigma(model, term, k).is_some_and(beyond) {
                    missed.push((term.clone(), k));
                }
            }
        }
        missed
    }

    /// Lets go of priors.
    pub(super) fn free(&mut self, missed: &[(Term, usize)]) {
        self.freed
            .extend(missed.iter().map(|(term, k)| key(term, *k)));
    }
}

/// Whose factor of [`Priors::ln_scale`] a prior has.
pub(super) fn group(term: &Term) -> Option<usize> {
    match term.effect.about().role {
        Role::JointZero => Some(0),
        Role::JointAxis => Some(1),
        Role::ToolPlace | Role::ToolTurn | Role::FreeFrame if !of_one_target(term) => Some(2),
        _ => None,
    }
}

/// Whether a term is the own part of one target.
pub(super) fn of_one_target(term: &Term) -> bool {
    term.effect.about().setting == Setting::Target && term.setting > 0.0
}

pub(super) fn key(term: &Term, coefficient: usize) -> Key {
    let id = term.effect.about().id;
    (id, term.joint, term.setting.to_bits(), coefficient)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::CATALOGUE;
    use crate::fit::normal::Normal;
    use crate::simulation::parse_scenario;

    /// Every effect of which something is known beforehand, on both joints, with these coefficients in turn.
    fn model(values: &[f64]) -> Model {
        let scenario = br#"{"format":"truepose-scenario/1","name":"p","robot":{"name":"r","joints":[
            {"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0]},
            {"name":"slide","kind":"prismatic","axis":[1,0,0],"point_mm":[0,0,0]}],
            "tool":{"position_mm":[300,0,200],"quaternion_wxyz":[1,0,0,0]}},"targets":{"T1":[0,0,0]},
            "instrument":{"name":"tracker","sigma_mm":0.03},"poses":{"list":[{"q_deg":[0,0]}]},"effects":[],
            "noise":{"sigma_mm":0.03,"kind":"gauss"},"seed":1}"#;
        let robot = parse_scenario(scenario).unwrap().scenario.robot;
        let mut value = values.iter().cycle();
        let known = CATALOGUE.iter().filter(|e| !e.about().priors.is_empty());
        let terms = known.flat_map(|effect| [0, 1].map(|joint| Term::absent(effect, joint, 0.0)));
        terms.fold(Model::nominal(robot), |model, mut term| {
            for (coefficient, value) in term.coefficients.iter_mut().zip(&mut value) {
                *coefficient = *value;
            }
            model.with_term(term)
        })
    }

    /// Cost, its gradient and its curvature: of a quadratic function differences give all three exactly.
    #[test]
    fn the_rows_of_the_priors_are_the_derivatives_of_their_cost() {
        let values = [0.3, -0.2, 0.07, 0.5, -0.9];
        let at = model(&values);
        let coefficients = at.coefficients();
        let mut size = Vec::new();
        for (term, k) in at.columns().take(3) {
            size.push((key(term, k), 0.4 + size.len() as f64));
        }
        let weak = Priors {
            variance: 4.0,
            aligned: true,
            ..Priors::unmeasured(Some(0.1))
        };
        let held = Priors {
            size,
            ..weak.clone()
        };
        for priors in [weak.clone(), held] {
            let of = |model: &Model| {
                let mut normal = Normal::new(coefficients.len());
                priors.add(model, &mut normal);
                normal
            };
            let cost = |k: usize, step: f64| {
                let mut step_of = vec![0.0; coefficients.len()];
                step_of[k] = step;
                of(&at.stepped(&step_of)).cost
            };
            let normal = of(&at);
            let close = |a: f64, b: f64| (a - b).abs() <= 1e-5 * (1.0 + a.abs().max(b.abs()));
            for k in 0..coefficients.len() {
                let h = 0.01;
                let (up, down) = (cost(k, h), cost(k, -h));
                let slope = -(up - down) / (4.0 * h);
                let curvature = (up + down - 2.0 * normal.cost) / (2.0 * h * h);
                assert!(close(normal.gradient[k], slope), "{k}: {slope}");
                assert!(close(normal.gram[(k, k)], curvature), "{k}: {curvature}");
            }
            assert!(normal.gram.diagonal().iter().any(|w| *w > 0.0));
        }
        // Weight: the variance of a coordinate over that of the prior.
        let (term, k) = at.columns().next().expect("one");
        let sigma = weak.sigma(&at, term, k).expect("known");
        let mut normal = Normal::new(coefficients.len());
        weak.add(&at, &mut normal);
        assert!((normal.gram[(0, 0)] - 4.0 / (sigma * sigma)).abs() < 1e-9 * normal.gram[(0, 0)]);
    }

    #[test]
    fn a_prior_that_is_missed_by_far_is_let_go() {
        let at = model(&[0.0]);
        let (term, k) = at.columns().next().expect("one");
        let mut priors = Priors {
            aligned: true,
            ..Priors::unmeasured(None)
        };
        let sigma = priors.sigma(&at, term, k).expect("known");
        let with = |value: f64| {
            let mut step = vec![0.0; at.coefficients().len()];
            step[0] = value;
            at.stepped(&step)
        };
        assert!(priors.missed(&with(3.9 * sigma)).is_empty());
        let missed = priors.missed(&with(-4.1 * sigma));
        assert_eq!(missed.len(), 1);
        priors.free(&missed);
        assert_eq!(priors.sigma(&at, term, k), None);
        assert!(priors.missed(&with(-4.1 * sigma)).is_empty());
    }
}
