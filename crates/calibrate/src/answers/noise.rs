//! The estimated noise: its sizes, and its description. The equations are in [`crate::fit::noise`].

use crate::sessions::{Session, Sigma};
use crate::text::Text;
use crate::text::length;
use crate::thresholds;

/// Share of the probability (a log-likelihood while they are compared), time constant in seconds, and
/// variances of the slow part in units of the white one's.
pub(crate) type Trial = (f64, f64, [f64; 3]);

/// Noise of a session: a white part for each axis and, where the residuals show one, a part that wanders.
#[derive(Debug, Clone, PartialEq)]
pub struct Noise {
    /// Standard deviation of the white part along x, y, z, mm.
    pub sigma_mm: [f64; 3],
    /// The slow part, where the residuals show one.
    pub slow: Option<Slow>,
    /// Repeatability of every revolute joint, drawn anew at every pose, rad (of a prismatic one in units of the
    /// robot's reach); 0 where the samples show none of it.
    pub joints_rad: f64,
    /// RMS length of the error of repeatability of a pose, mm; `None` where the samples do not determine it.
    pub robot_mm: Option<f64>,
    /// Whether the axes were found, or stated, to differ.
    pub unequal: bool,
    /// Twice the logarithm by which the slow part makes the residuals likelier.
    pub slow_evidence: f64,
    /// What else it may be, with its share of the probability: a time constant and the variances
    /// of the slow part in units of the white one's (all zero: white). Intervals average over it.
    pub(crate) alternatives: Vec<Trial>,
}

impl Noise {
    /// White noise of one size on all axes.
    pub fn white(sigma_mm: f64) -> Self {
        Self {
            sigma_mm: [sigma_mm; 3],
            slow: None,
            joints_rad: 0.0,
            robot_mm: None,
            unequal: false,
            slow_evidence: 0.0,
            alternatives: Vec::new(),
        }
    }

    /// Noise of the same size that is known to be white.
    #[must_use]
    pub fn made_white(&self) -> Self {
        let slow = self.slow.map_or([0.0; 3], |s| s.rms_mm);
        let total = |axis: usize| self.sigma_mm[axis].hypot(slow[axis]);
        Self {
            sigma_mm: [total(0), total(1), total(2)],
            slow: None,
            alternatives: Vec::new(),
            ..self.clone()
        }
    }

    /// Its white part alone.
    #[must_use]
    pub fn without_slow(&self) -> Self {
        Self {
            slow: None,
            alternatives: Vec::new(),
            ..self.clone()
        }
    }

    /// The same noise so many times as large.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let mut noise = self.clone();
        noise.sigma_mm = noise.sigma_mm.map(|s| s * factor);
        noise.joints_rad *= factor;
        if let Some(slow) = &mut noise.slow {
            slow.rms_mm = slow.rms_mm.map(|s| s * factor);
        }
        noise
    }

    /// The same with a white part of at least this along x, y, z, mm.
    #[must_use]
    pub(crate) fn at_least(mut self, least_mm: [f64; 3]) -> Self {
        for (sigma, least) in self.sigma_mm.iter_mut().zip(least_mm) {
            *sigma = sigma.max(least);
        }
        self
    }

    /// What the robot does not repeat, in words.
    pub fn describe_robot(&self) -> Option<Text> {
        let robot_mm = self.robot_mm?;
        Some(text!(
            "the robot repeats to {size} (root mean square of a pose's own error)",
            size = length(robot_mm, 4)
        ))
    }

    /// Whether rows are independent of one another.
    pub(crate) fn is_white(&self) -> bool {
        self.slow.is_none() && self.joints_rad == 0.0
    }

    /// Root mean square of both parts over some axes, mm.
    pub fn total_mm(&self, axes: &[usize]) -> f64 {
        let one = |a: &usize| {
            let slow = self.slow.map_or(0.0, |s| along(s.rms_mm, *a));
            along(self.sigma_mm, *a).powi(2) + slow * slow
        };
        (axes.iter().map(one).sum::<f64>() / axes.len().max(1) as f64).sqrt()
    }

    /// Correlation of the noise from one sample to the next, `step_s` apart.
    pub fn correlation(&self, step_s: f64) -> f64 {
        self.slow.map_or(0.0, |slow| {
            let (mut all, mut own) = (0.0, 0.0);
            for axis in 0..3 {
                let s2 = slow.rms_mm[axis].powi(2);
                own += s2;
                all += s2 + self.sigma_mm[axis].powi(2);
            }
            own / f64::max(all, f64::MIN_POSITIVE) * (-step_s / slow.time_constant_s).exp()
        })
    }

    /// This noise compared with the one that is stated for the instrument, where one is.
    pub fn against_stated(&self, session: &Session) -> Option<StatedNoise> {
        let stated = session.instrument.sigma_mm?;
        let planar = session.samples.z_mm.is_none();
        let axes = if planar { &[0, 1][..] } else { &[0, 1, 2] };
        Some(StatedNoise::of(stated, self.sigma_mm, axes))
    }
}

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
    pub fn describe(&self) -> Text {
        let (wanders_mm, time) = self.extent();
        text!(
            "the measuring frame wanders by {size} (root mean square) within {time} min",
            size = length(wanders_mm, 4),
            time
        )
    }

    /// In words, where the model may lack what changes with time as the poses do, with this residual, mm: of a drift
    /// that takes longer than the session the fit has absorbed a part, and the residual is the rest.
    pub fn says_of_remaining_error(&self, residual_mm: f64) -> Text {
        let (wanders_mm, time) = self.extent();
        let size = length(wanders_mm.min(residual_mm), 4);
        text!(
            "a part of the remaining error goes on from sample to sample, {size} (root mean square) within {time} min: a diagnosis looks for effects in it",
            size,
            time
        )
    }

    /// How far it wanders, mm, and in which time, min.
    fn extent(&self) -> (f64, String) {
        let wanders_mm = self.rms_mm.iter().map(|s| s * s).sum::<f64>().sqrt();
        let minutes = self.time_constant_s / 60.0;
        (wanders_mm, format!("{minutes:.1}"))
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
        !(thresholds::NOTICEABLE.recip()..=thresholds::NOTICEABLE).contains(&ratio)
    }

    /// In words.
    pub fn describe(&self) -> Text {
        let times = self.found_mm / self.stated_mm;
        text!(
            "σ = {found} as found, {stated} as stated for the instrument ({times} times)",
            found = length(self.found_mm, 4),
            stated = length(self.stated_mm, 4),
            times = format!("{times:.2}")
        )
    }
}

/// What belongs to an axis, 0 to 2; no number for any other.
fn along(each: [f64; 3], axis: usize) -> f64 {
    each.get(axis).copied().unwrap_or(f64::NAN)
}

/// Root mean square over some axes.
fn over(sigma: [f64; 3], axes: &[usize]) -> f64 {
    let sum: f64 = axes.iter().map(|a| along(sigma, *a).powi(2)).sum();
    (sum / axes.len().max(1) as f64).sqrt()
}

#[cfg(test)]
#[test]
fn slow_noise_is_no_more_than_the_error_that_it_is_a_part_of() {
    let slow = Slow {
        rms_mm: [0.6, 0.6, 0.2],
        time_constant_s: 90.0,
    };
    assert!(slow.describe().to_string().contains("0.8718 mm"));
    let left = slow.says_of_remaining_error(0.5);
    assert!(left.to_string().contains("0.5000 mm"), "{left}");
    let of_more = slow.says_of_remaining_error(2.0);
    assert!(of_more.to_string().contains("0.8718 mm"), "{of_more}");
}
