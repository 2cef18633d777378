//! Coordinates that were rounded: their digit, where it matters compared with the noise.
//!
//! Rounding to a digit d adds d²/12 to the variance of a coordinate, whatever the instrument is capable
//! of; what is stated for the instrument is widened by that ([`SessionCorrection::WidenNoise`]).

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::fit::problem::COARSE;
use crate::fit::problem::digits_mm;
use crate::fit::usual_noise::USUAL_NOISE_MM;
use crate::sessions::{Session, SessionCorrection, Sigma};
use crate::text::Text;

pub(crate) fn coarse(session: &Session, _: JointValues) -> Vec<DataProblem> {
    let added_mm = digits_mm(session);
    let stated = session.instrument.sigma_mm;
    let expected = |axis: usize| match stated {
        Some(Sigma::Overall(sigma)) => sigma,
        Some(Sigma::PerAxis(sigma)) => sigma[axis],
        None => USUAL_NOISE_MM,
    };
    let coarse: Vec<usize> = (0..3)
        .filter(|axis| added_mm[*axis] > COARSE * expected(*axis))
        .collect();
    if coarse.is_empty() {
        return Vec::new();
    }
    // Axes of one digit together.
    let digit = |axis: &usize| trimmed(added_mm[*axis] * 12.0_f64.sqrt());
    let of = coarse.chunk_by(|a, b| digit(a) == digit(b)).map(|alike| {
        let axes: Vec<&str> = alike.iter().map(|axis| ["x", "y", "z"][*axis]).collect();
        text!(
            "{size} mm in {axes}",
            size = digit(&alike[0]),
            axes = axes.join(", ")
        )
    });
    let of = Text::listed(of, ", ");
    let largest = coarse
        .iter()
        .map(|axis| added_mm[*axis])
        .fold(0.0, f64::max);
    let added = format!("{largest:.4}");
    let evidence = match stated {
        Some(_) => text!(
            "every value is a multiple of it; rounding adds {added} mm to the noise of a coordinate, which is more than a third of the noise stated for the instrument",
            added
        ),
        None => text!(
            "every value is a multiple of it; rounding adds {added} mm to the noise of a coordinate, which is more than a third of what an instrument usually has",
            added
        ),
    };
    vec![DataProblem::of_all(
        text!(
            "resolution: the coordinates are rounded to {digits}",
            digits = of
        ),
        evidence,
        text!("the digit counts as noise, and nothing below it can be told; record more digits"),
        stated.map(|_| SessionCorrection::WidenNoise(added_mm)),
    )]
}

/// A length without the zeros behind.
fn trimmed(mm: f64) -> String {
    let text = format!("{mm:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::row_checks::tests::axis;

    fn rounded(session: &mut Session, step: f64) {
        let samples = &mut session.samples;
        for column in [&mut samples.x_mm, &mut samples.y_mm] {
            for v in column.iter_mut() {
                *v = (*v / step).round() * step;
            }
        }
    }

    #[test]
    fn a_digit_that_matters_is_said_and_widens_what_is_stated() {
        let mut session = axis(80);
        session.instrument.sigma_mm = Some(Sigma::Overall(0.02));
        assert!(coarse(&session, JointValues::Commanded).is_empty());
        rounded(&mut session, 0.1);
        let problems = coarse(&session, JointValues::Commanded);
        assert_eq!(problems.len(), 1);
        assert!(
            problems[0].what.contains("resolution") && problems[0].what.contains("0.1 mm in x, y")
        );
        problems[0]
            .mend
            .as_ref()
            .expect("stated")
            .apply(&mut session);
        // Two of three axes are rounded; the ratio between them is estimated from the residuals. (The
        // heights, all but constant, are not whole tenths.)
        let Some(Sigma::Overall(sigma)) = session.instrument.sigma_mm else {
            panic!("{:?}", session.instrument.sigma_mm)
        };
        let added = 0.01 / 12.0 * 2.0 / 3.0;
        assert!((sigma - (0.02_f64.powi(2) + added).sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_digit_that_is_far_below_the_noise_is_not_worth_a_word() {
        let mut session = axis(80);
        session.instrument.sigma_mm = Some(Sigma::Overall(0.02));
        rounded(&mut session, 0.01);
        assert!(coarse(&session, JointValues::Commanded).is_empty());
    }
}
