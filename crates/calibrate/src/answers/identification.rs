//! The types of an identification.

use std::collections::BTreeSet;

use crate::numeric::extent;
use nalgebra::DMatrix;

use crate::effects::term::setting_quantity;
use crate::effects::{Effect, Inputs, Setting, Unit, find, form_with};
use crate::kinematics::Range;
use crate::model::{Calibration, Conditions, Model, RegionalCorrection, ResidualStep, SetUp};
use crate::observations::figures::KindFigures;
use crate::sessions::Session;
use crate::steps::step_of;
use crate::text::{Template, Text};

use super::errors::{Expected, Level, Spread, UnusableReason};
use super::noise::Noise;

/// A parameter with its interval, in the user's units.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// The effect's name.
    pub effect: &'static str,
    /// Joint, counted from 1; `None` where the effect belongs to none.
    pub joint: Option<usize>,
    /// Name of the setup that a measuring frame belongs to.
    pub setup: Option<String>,
    /// Name of the target whose own place it is.
    pub target: Option<String>,
    /// Name of the anchor, station, plane or socket whose place it is.
    pub place: Option<String>,
    /// The parameter's name with its unit.
    pub name: &'static str,
    /// Its value, in the unit that ends its name.
    pub value: f64,
    /// 95 % interval from the lower to the upper end, the same unit; `None` where it is not determined.
    pub ci95: Option<[f64; 2]>,
}

/// Sizes above this part of what is implausible are not usual.
const USUAL_PART: f64 = 0.1;

/// Units that are taken for others, and how many of the smaller are one of the larger.
const TAKEN_FOR: [(&str, f64, &str); 8] = [
    ("mm", 1e3, "µm"),
    ("mrad", 1e3, "µrad"),
    ("°", 60.0, "′"),
    ("°", 3600.0, "″"),
    ("ppm", 1e3, "ppb"),
    ("ppm/°C", 1e3, "ppb/°C"),
    ("mm/kg", 1e3, "µm/kg"),
    ("µrad/(N·m)", 1e3, "nrad/(N·m)"),
];

impl Estimate {
    /// Whether it was chosen of a list and has no interval: an order of 2, a screw's lead of 10 mm.
    pub fn is_chosen(&self) -> bool {
        let Some(setting) = find(self.effect).map(|effect| effect.about().setting) else {
            return false;
        };
        let own = setting_quantity(setting).filter(|q| q.name == self.name);
        let counts = own.is_some_and(|q| q.unit.symbol.is_empty() && self.value.fract() == 0.0);
        let listed = own.is_some() && matches!(setting, Setting::Listed(_));
        self.ci95.is_none() && (counts || listed)
    }

    /// Whether it is a size beyond what its effect has on any machine, with the whole of its interval.
    pub fn is_implausible(&self) -> bool {
        self.implausible_above().is_some()
    }

    /// The message about a size that is implausible: with the unit in which the same number is usual, where there is
    /// one, as columns in another unit than in their heading give such sizes.
    pub fn implausible(&self) -> Option<Text> {
        let limit = self.implausible_above()?;
        let unit = Unit::of_name(self.name).1.symbol;
        let usual = |(of, many, _): &&(&str, f64, &str)| {
            *of == unit && self.value.abs() / many <= USUAL_PART * limit
        };
        Some(match TAKEN_FOR.iter().find(usual) {
            Some((_, _, smaller)) => text!(
                "implausibly large: more than ten times what is usual; {size} would be usual: check the units of the \
                 columns and of the robot",
                size = format!("{:.3} {smaller}", self.value),
            ),
            None => text!("implausibly large: more than ten times what is usual"),
        })
    }

    /// The limit that it is above.
    fn implausible_above(&self) -> Option<f64> {
        let has_it = |effect: &Effect| {
            let mut quantities = effect.about().form.quantities().iter();
            quantities.any(|q| q.name == self.name)
        };
        let effect = find(self.effect).map(|effect| form_with(effect, has_it))?;
        let about = effect.about();
        // A sliding joint has other units, and no limit is known for those.
        let is_size = has_it(effect);
        let limit = about.implausible_above.filter(|_| is_size);
        let least = self.ci95.map_or(self.value.abs(), |[low, high]| {
            f64::max(low, -high).max(0.0)
        });
        limit.filter(|limit| least > *limit)
    }
}

/// One region's correction.
#[derive(Debug, Clone, PartialEq)]
pub struct RegionResult {
    /// The correction: what to add.
    pub correction: RegionalCorrection,
    /// 95 % interval of Δθ, rad; `None` with too few samples.
    pub theta_ci95: Option<[f64; 2]>,
    /// 95 % interval of Δl1, mm.
    pub l1_ci95: Option<[f64; 2]>,
    /// RMS error of the region's samples before the correction, in the plane of motion, mm.
    pub rms_before_mm: f64,
    /// The same after the correction, mm.
    pub rms_after_mm: f64,
}

/// Something that the samples do not determine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NotIdentifiable {
    /// What: a parameter, or a combination of several.
    pub combination: Text,
    /// Why.
    pub because: Text,
}

/// The RMS error before and after.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Gap {
    /// Of the nominal robot.
    pub before: Spread,
    /// Of the model.
    pub after: Spread,
    /// Number of samples it is taken over, suspected outliers included.
    pub samples: usize,
}

/// A sample that is suspected, counted from 0 in the order of the session.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outlier {
    /// Which sample.
    pub sample: usize,
    /// How far it is from the model, mm.
    pub deviation_mm: f64,
}

/// A sample that could not be used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LeftOut {
    /// Which sample, counted from 0.
    pub sample: usize,
    /// Why.
    pub because: UnusableReason,
}

/// How the solver fared.
#[derive(Debug, Clone, PartialEq)]
pub struct Quality {
    /// Why it stopped, in words.
    pub stopped: Template,
    /// Whether the result can be relied on.
    pub converged: bool,
    /// Passes over the samples.
    pub passes: usize,
    /// Number of coefficients solved for.
    pub coefficients: usize,
    /// Number of independent combinations that the samples determine.
    pub rank: usize,
    /// Condition number of the scaled Jacobian on what is determined.
    pub condition: f64,
}

/// A fit of the parameters that every calibration has: values, intervals, errors in mm, what was left out.
#[derive(Debug, Clone, PartialEq)]
pub struct Identification {
    /// Name of the session.
    pub session: String,
    /// `exact` or `regional`.
    pub method: &'static str,
    /// Number of samples in the session.
    pub samples: usize,
    /// The model; for `regional` the nominal robot.
    pub model: Model,
    /// Covariance of the model's coefficients, inner units.
    pub covariance: Option<DMatrix<f64>>,
    /// Parameters of an exact identification.
    pub parameters: Vec<Estimate>,
    /// Regions of a regional identification.
    pub regions: Vec<RegionResult>,
    /// What the samples do not determine.
    pub not_identifiable: Vec<NotIdentifiable>,
    /// The RMS error over the samples that were fitted.
    pub gap: Gap,
    /// The RMS error over the samples that the session holds out, if any.
    pub held_out: Option<Gap>,
    /// What each level of correction would bring; of a robot with several joints.
    pub levels: Vec<Level>,
    /// The error that the uncertainty of the parameters makes over the joint ranges; of a robot with
    /// several joints.
    pub expected: Option<Expected>,
    /// Suspected outliers, largest first.
    pub outliers: Vec<Outlier>,
    /// Samples that could not be used.
    pub left_out: Vec<LeftOut>,
    /// Noise of the x, y and z coordinates as the residuals show it, mm; `None` with too few samples.
    pub noise_mm: Option<[f64; 3]>,
    /// The noise that values and intervals allow for; `None` where none was estimated.
    pub noise: Option<Noise>,
    /// Errors of every kind of measurement; empty where plain points are all there is.
    pub kinds: Vec<KindFigures>,
    /// How the solver fared.
    pub quality: Quality,
    /// Other notes.
    pub notes: Vec<Text>,
}

/// The step of a calibration's history that is an identification with the full model.
pub const FULL_MODEL: &str = "full model";

impl Identification {
    /// What identified the robot, as a step: the full model, or regions.
    pub fn identified_by(&self) -> String {
        match self.method {
            "exact" => FULL_MODEL.to_owned(),
            method => format!("{method} identification"),
        }
    }

    /// Samples that a person took out, counted from 0: they count in no fit and no figure.
    pub fn excluded(&self) -> Vec<usize> {
        let by_hand = self
            .left_out
            .iter()
            .filter(|l| l.because == UnusableReason::Excluded);
        by_hand.map(|l| l.sample).collect()
    }

    /// The same in words, in the language of this thread; `None` where there is none.
    pub fn excluded_in_words(&self) -> Option<String> {
        const MOST: usize = 20;
        let excluded = self.excluded();
        let numbers = excluded.iter().take(MOST).map(|i| (i + 1).to_string());
        let numbers = numbers.collect::<Vec<_>>().join(", ");
        let more = if excluded.len() > MOST { ", …" } else { "" };
        let n = excluded.len();
        (n > 0).then(|| {
            say!(
                one "{count} sample excluded, in no figure: {numbers}",
                "{count} samples excluded, in no figure: {numbers}",
                count = n,
                numbers = format!("{numbers}{more}")
            )
        })
    }

    /// Samples that were set aside as suspected outliers, in the order of the session.
    fn set_aside(&self) -> Vec<usize> {
        let mut samples: Vec<usize> = self.outliers.iter().map(|o| o.sample).collect();
        samples.sort_unstable();
        samples
    }

    /// The calibration that goes with this answer, to be saved and exported.
    pub fn calibration(&self, session: &Session, inputs: &Inputs) -> Calibration {
        let step = |what: &str, pick: fn(&Gap) -> Spread| ResidualStep {
            what: what.to_owned(),
            gap_mm: pick(&self.gap).rms_mm,
            held_out_mm: self.held_out.as_ref().map(|g| pick(g).rms_mm),
            runs_held_out_mm: None,
            values_held_out_mm: None,
        };
        Calibration {
            session: self.session.clone(),
            model: self.model.clone(),
            covariance: self.covariance.clone(),
            regions: self.regions.iter().map(|r| r.correction.clone()).collect(),
            targets: session.targets.clone(),
            measured_targets: measured_targets(session, inputs),
            measured: measured_ranges(inputs),
            measured_steps: measured_steps(inputs),
            load_kg: inputs.load_kg.as_deref().map(extent),
            tolerance_mm: session.tolerance_mm,
            compensated_by: session.compensated_by.clone(),
            set_up: SetUp::new(session.samples.corrected.iter().flat_map(|c| c.by.clone())),
            conditions: conditions_of(session),
            set_aside: Some(self.set_aside()),
            history: vec![
                step("nominal robot", |g| g.before),
                step(&self.identified_by(), |g| g.after),
            ],
            samples_hash: crate::sessions::hash_of_samples(session),
            program_version: env!("CARGO_PKG_VERSION").to_owned(),
        }
    }
}

/// The targets that samples show, where some have none.
fn measured_targets(session: &Session, inputs: &Inputs) -> Option<Vec<usize>> {
    let shown: BTreeSet<usize> = match &inputs.target {
        Some(targets) => targets.iter().map(|target| *target as usize).collect(),
        None => BTreeSet::from([0]),
    };
    (shown.len() < session.targets.len()).then(|| shown.into_iter().collect())
}

/// The conditions that a session's samples cover.
fn conditions_of(session: &Session) -> Conditions {
    let range = |column: &Option<Vec<f64>>| {
        let [from, to] = extent(column.iter().flatten());
        (from <= to).then_some(Range { from, to })
    };
    Conditions {
        load_kg: range(&session.samples.load_kg),
        temperature_c: range(&session.samples.temperature_c),
    }
}

/// The range of every joint in the samples.
pub fn measured_ranges(inputs: &Inputs) -> Vec<Range> {
    let range = |q: &[f64]| {
        let [from, to] = extent(q);
        Range { from, to }
    };
    inputs.q.iter().map(|q| range(q)).collect()
}

/// The steps in which joints were measured, where any are equal.
fn measured_steps(inputs: &Inputs) -> Option<Vec<f64>> {
    let steps = inputs.q.iter().map(|q| step_of(q).unwrap_or(0.0));
    let steps: Vec<f64> = steps.collect();
    steps.iter().any(|step| *step > 0.0).then_some(steps)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(effect: &'static str, name: &'static str, value: f64) -> Option<String> {
        let estimate = Estimate {
            effect,
            joint: Some(0),
            setup: None,
            target: None,
            place: None,
            name,
            value,
            ci95: Some([0.95 * value, 1.05 * value]),
        };
        estimate.implausible().map(|says| says.to_string())
    }

    #[test]
    fn sizes_that_no_machine_has_are_said_with_the_unit_that_is_usual() {
        let runout = of("bearing-runout", "amplitude_mm", 0.71).expect("implausible");
        assert!(runout.contains("0.710 µm would be usual"), "{runout}");
        let wobble = of("axis-wobble", "amplitude_mrad", 31.0).expect("implausible");
        assert!(wobble.contains("31.000 µrad would be usual"), "{wobble}");
        let scale = of("joint-scale", "scale_ppm", 8000.0).expect("implausible");
        assert!(scale.contains("8000.000 ppb would be usual"), "{scale}");
        assert_eq!(of("bearing-runout", "amplitude_mm", 0.02), None);
        // No unit makes sense of so much.
        let far = of("bearing-runout", "amplitude_mm", 710.0).expect("implausible");
        assert!(far.ends_with("what is usual"), "{far}");
    }
}
