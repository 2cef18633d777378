//! What is said of noise: of a slow part, and of the white part beside what is stated.

use crate::sessions::Sigma;

/// A part of the noise that wanders slowly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slow {
    /// Root mean square along x, y, z, mm.
    pub rms_mm: [f64; 3],
    /// Time over which it forgets where it was, s (samples, where the session has no clock).
    pub time_constant_s: f64,
}

impl Slow {
    /// In words, where everything that has a name is in the model.
    pub fn says(&self) -> String {
        format!("the measuring frame wanders by {}", self.extent())
    }

    /// In words, where the model may lack what changes with time as the poses do.
    pub fn says_of_remaining_error(&self) -> String {
        format!(
            "a part of the remaining error goes on from sample to sample, {}: a diagnosis looks \
             for effects in it",
            self.extent()
        )
    }

    fn extent(&self) -> String {
        let length = self.rms_mm.iter().map(|s| s * s).sum::<f64>().sqrt();
        format!(
            "{length:.4} mm (root mean square) within {:.1} min",
            self.time_constant_s / 60.0
        )
    }
}

/// The size of the white noise as it is stated for the instrument, and as it was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StatedNoise {
    /// As stated, root mean square over the axes, mm.
    pub stated_mm: f64,
    /// As found, mm.
    pub found_mm: f64,
}

/// Stated and found noise that differ by more than this factor are told.
const WORTH_TELLING: f64 = 1.15;

impl StatedNoise {
    /// Stated and found noise of the measured axes.
    pub fn of(stated: Sigma, found_mm: [f64; 3], axes: &[usize]) -> Self {
        let stated_mm = match stated {
            Sigma::Overall(sigma) => sigma,
            Sigma::PerAxis(sigma) => over(sigma, axes),
        };
        Self {
            stated_mm,
            found_mm: over(found_mm, axes),
        }
    }

    /// Whether the two differ by more than 15 %.
    pub fn differs(&self) -> bool {
        let ratio = self.found_mm / self.stated_mm;
        !(WORTH_TELLING.recip()..=WORTH_TELLING).contains(&ratio)
    }

    /// In words.
    pub fn says(&self) -> String {
        let Self {
            stated_mm,
            found_mm,
        } = self;
        format!(
            "σ = {found_mm:.4} mm as found, {stated_mm:.4} mm as stated for the instrument \
             ({:.2} times)",
            found_mm / stated_mm
        )
    }
}

/// Root mean square over some axes.
pub(super) fn over(sigma: [f64; 3], axes: &[usize]) -> f64 {
    let sum: f64 = axes.iter().map(|a| sigma[*a].powi(2)).sum();
    (sum / axes.len().max(1) as f64).sqrt()
}
