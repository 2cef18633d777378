//! The uncertainty of the answer: `C = s² (Jᵀ W J)⁻¹`, `s² = rᵀ W r / (m − rank)`, and 95 % intervals from Student's t
//! with m − rank degrees of freedom, m the number of measured coordinates.
//!
//! An amplitude and a phase follow from their two coefficients a = A cos φ, b = A sin φ by the
//! first derivatives of `A = √(a² + b²)` and `φ = atan2(b, a)`.

use nalgebra::DMatrix;

use crate::distributions::t_quantile;
use crate::effects::term::setting_quantity;
use crate::effects::{Form, Setting, Term};
use crate::kinematics::JointKind;
use crate::model::Calibration;
use crate::units::{HALF_TURN_DEG, deg_from_rad};

use crate::answers::identification::Estimate;

/// The factor by which a standard error becomes half of a 95 % interval.
pub(crate) fn half_width_factor(degrees_of_freedom: usize) -> f64 {
    if degrees_of_freedom == 0 {
        return f64::INFINITY;
    }
    t_quantile(0.975, degrees_of_freedom as f64)
}

/// The factor by which a standard error becomes half of a 95 % interval where the number of samples
/// behind it is not known: a model keeps its covariance only.
pub fn normal_95() -> f64 {
    t_quantile(0.975, f64::INFINITY)
}

/// The estimates of all parameters of a calibration, with intervals by its covariance and `factor`; without a
/// covariance there are none.
pub fn all_estimates(calibration: &Calibration, factor: f64) -> Vec<Estimate> {
    let mut all = Vec::new();
    let mut first = 0;
    for term in calibration.model.terms() {
        let size = term.coefficients.len();
        let fits = calibration.covariance.as_ref();
        let fits = fits.filter(|covariance| covariance.nrows() >= first + size);
        let own = fits.map(|covariance| covariance.view((first, first), (size, size)).into_owned());
        let kind = calibration.model.robot.joints[term.joint].kind;
        // What is held has no variance at all; its file states nothing else of it.
        let has_none = |k: usize| own.as_ref().is_none_or(|own| own[(k, k)] == 0.0);
        let open: Vec<bool> = (0..size).map(has_none).collect();
        all.extend(estimates(term, own.as_ref(), factor, &open, kind));
        first += size;
    }
    all
}

/// The estimates of a term's parameters. `covariance` is that of its own coefficients, `factor` turns a standard error
/// into half an interval, and `undetermined` states of each coefficient whether the samples leave it undetermined.
pub(crate) fn estimates(
    term: &Term,
    covariance: Option<&DMatrix<f64>>,
    factor: f64,
    undetermined: &[bool],
    kind: JointKind,
) -> Vec<Estimate> {
    let about = term.effect.about();
    let values = term.parameters_on(kind);
    let half_widths = half_widths(term, covariance, factor, undetermined, kind);
    // A fade is shown first and solved for last, as a logarithm; other settings are chosen, not estimated, and their
    // uncertainty comes from the scan.
    let fading = matches!(about.form, Form::Fading(_));
    let settings = usize::from(!fading && setting_quantity(about.setting).is_some());
    let matters = |name: &str| {
        let mut quantities = about.form.quantities().iter();
        quantities.all(|q| q.name != name || q.matters_on(kind))
    };
    let label = |of: Setting| {
        let label = term.label.as_deref().filter(|_| about.setting == of);
        label.map(str::to_owned)
    };
    values
        .into_iter()
        .enumerate()
        .filter(|(_, parameter)| matters(parameter.name))
        .map(|(k, parameter)| {
            let half = k.checked_sub(settings).map(|k| half_widths[k]);
            let value = parameter.value;
            let ci95 = match half {
                // Chosen, not estimated.
                None => None,
                Some(half) => half
                    .filter(|h| h.is_finite())
                    .map(|h| [value - h, value + h]),
            };
            Estimate {
                effect: about.id,
                joint: about.per_joint.then_some(term.joint + 1),
                setup: label(Setting::Setup),
                target: label(Setting::Target),
                place: label(Setting::Place),
                name: parameter.name,
                value,
                ci95: match (parameter.name, ci95) {
                    (name, Some([low, high]))
                        if name.starts_with("amplitude") || about.non_negative && k == settings =>
                    {
                        Some([low.max(0.0), high])
                    }
                    (_, ci95) => ci95,
                },
            }
        })
        .collect()
}

fn half_widths(
    term: &Term,
    covariance: Option<&DMatrix<f64>>,
    factor: f64,
    undetermined: &[bool],
    kind: JointKind,
) -> Vec<Option<f64>> {
    let Some(covariance) = covariance else {
        return vec![None; term.coefficients.len()];
    };
    if covariance.nrows().min(covariance.ncols()) < term.effect.about().form.coefficients() {
        return vec![None; term.coefficients.len()];
    }
    match term.effect.about().form {
        Form::Plain(quantities) => quantities
            .iter()
            .enumerate()
            .map(|(k, quantity)| {
                (!undetermined[k])
                    .then(|| factor * covariance[(k, k)].sqrt() / quantity.on(kind).unit.scale)
            })
            .collect(),
        Form::Fading(quantity) => {
            let quantity = quantity.on(kind);
            let fade = setting_quantity(term.effect.about().setting).map_or(1.0, |setting| {
                term.settled().setting / setting.on(kind).unit.scale
            });
            let deviation = |k: usize| factor * covariance[(k, k)].sqrt();
            // An uncertainty beyond a factor of e has no meaningful interval.
            let of_fade = (!undetermined[1] && deviation(1) < 1.0).then(|| fade * deviation(1));
            let of_size = (!undetermined[0]).then(|| deviation(0) / quantity.unit.scale);
            vec![of_fade, of_size]
        }
        Form::Harmonic(quantity) => {
            if undetermined.contains(&true) {
                return vec![None, None];
            }
            let (a, b) = (term.coefficients[0], term.coefficients[1]);
            let amplitude = a.hypot(b);
            let variance = |da: f64, db: f64| {
                da * da * covariance[(0, 0)]
                    + 2.0 * da * db * covariance[(0, 1)]
                    + db * db * covariance[(1, 1)]
            };
            if amplitude == 0.0 {
                let largest = covariance[(0, 0)].max(covariance[(1, 1)]);
                return vec![Some(factor * largest.sqrt() / quantity.unit.scale), None];
            }
            let radial = variance(a / amplitude, b / amplitude).sqrt();
            let around = variance(-b / amplitude, a / amplitude).sqrt() / amplitude;
            let phase = deg_from_rad(factor * around);
            vec![
                Some(factor * radial / quantity.unit.scale),
                (phase < HALF_TURN_DEG).then_some(phase),
            ]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::CATALOGUE;

    /// Amplitude and phase are functions of the two coefficients: what their covariance makes of them, with
    /// derivatives by differences.
    #[test]
    fn intervals_of_amplitude_and_phase_follow_from_the_covariance() {
        let harmonic = CATALOGUE
            .iter()
            .find_map(|effect| match effect.about().form {
                Form::Harmonic(quantity) => Some((*effect, quantity)),
                _ => None,
            });
        let (effect, quantity) = harmonic.expect("there is one");
        let mut term = Term::absent(effect, 0, 2.0);
        term.coefficients = vec![3e-3, -4e-3];
        let covariance = DMatrix::from_row_slice(2, 2, &[4e-8, 1.5e-8, 1.5e-8, 2e-8]);
        let deviation = |of: &dyn Fn(f64, f64) -> f64| {
            let (a, b, h) = (3e-3, -4e-3, 1e-8);
            let da = (of(a + h, b) - of(a - h, b)) / (2.0 * h);
            let db = (of(a, b + h) - of(a, b - h)) / (2.0 * h);
            let decayed = DMatrix::from_row_slice(1, 2, &[da, db]);
            (&decayed * &covariance * decayed.transpose())[0].sqrt()
        };
        let of = |undetermined: [bool; 2]| {
            half_widths(
                &term,
                Some(&covariance),
                2.0,
                &undetermined,
                JointKind::Revolute,
            )
        };
        let [Some(amplitude), Some(phase)] = of([false; 2])[..] else {
            panic!("both are known");
        };
        let expected = 2.0 * deviation(&f64::hypot) / quantity.unit.scale;
        assert!(
            (amplitude / expected - 1.0).abs() < 1e-6,
            "{amplitude} {expected}"
        );
        let expected = deg_from_rad(2.0 * deviation(&|a, b| b.atan2(a)));
        assert!((phase / expected - 1.0).abs() < 1e-6, "{phase} {expected}");
        assert_eq!(of([false, true]), [None, None]);
    }
}
