//! What is known of the samples before anything is identified: which part of the joint's range
//! they cover, under which conditions, and the noise that the instrument's maker admits. Worked
//! out once, when a session is opened or changed.

use crate::effects::{Inputs, Survey};
use crate::gui::units::whole;
use crate::sessions::{Session, Sigma};

/// Equal parts of the range of joint 1 in which samples are counted.
pub(crate) const PARTS: usize = 24;

/// See the module.
#[derive(Debug, Clone)]
pub(crate) struct Known {
    /// Conditions: which vary, and how far.
    pub(crate) survey: Survey,
    /// Smallest and largest value that joint 1 was measured at, rad or mm; `None` without samples.
    pub(crate) measured: Option<[f64; 2]>,
    /// Samples in each part of the range that the joint can reach.
    pub(crate) cover: Vec<u32>,
    /// The widest part within what was measured in which there is no sample, rad or mm.
    pub(crate) hole: Option<[f64; 2]>,
    /// Smallest and largest load, kg.
    pub(crate) load_kg: Option<[f64; 2]>,
    /// Smallest and largest temperature, °C.
    pub(crate) temperature_c: Option<[f64; 2]>,
    /// The gap that the instrument's own noise makes, mm.
    pub(crate) floor_mm: Option<f64>,
}

impl Known {
    /// Looks at every sample. `travel` is the range of joint 1 that can be reached or was measured.
    pub(crate) fn new(session: &Session, inputs: &Inputs, travel: (f64, f64)) -> Self {
        let samples = &session.samples;
        let q = &samples.q[0];
        let measured = extent(q);
        let cover = counted(q, travel);
        Self {
            survey: Survey::new(session, inputs),
            hole: measured.and_then(|measured| hole(&cover, measured, travel)),
            measured,
            cover,
            load_kg: samples.load_kg.as_deref().and_then(extent),
            temperature_c: samples.temperature_c.as_deref().and_then(extent),
            floor_mm: floor_mm(session),
        }
    }
}

/// Smallest and largest of the finite values.
fn extent(values: &[f64]) -> Option<[f64; 2]> {
    let finite = values.iter().filter(|v| v.is_finite());
    finite.fold(None, |all, v| match all {
        None => Some([*v, *v]),
        Some([low, high]) => Some([low.min(*v), high.max(*v)]),
    })
}

fn counted(q: &[f64], (from, to): (f64, f64)) -> Vec<u32> {
    let mut cover = vec![0; PARTS];
    let width = (to - from) / PARTS as f64;
    if width.is_nan() || width <= 0.0 {
        return cover;
    }
    for q in q.iter().filter(|q| q.is_finite()) {
        let part = whole((q - from) / width).min(PARTS - 1);
        cover[part] += 1;
    }
    cover
}

/// The widest run of empty parts within what was measured, if it is out of the ordinary: wider
/// than three times the middle one.
fn hole(cover: &[u32], measured: [f64; 2], (from, to): (f64, f64)) -> Option<[f64; 2]> {
    let width = (to - from) / PARTS as f64;
    let part = |q: f64| whole((q - from) / width).min(PARTS - 1);
    let within = part(measured[0])..=part(measured[1]);
    let filled: Vec<usize> = within.filter(|k| cover[*k] > 0).collect();
    let mut steps: Vec<usize> = filled.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let widest = filled.windows(2).max_by_key(|pair| pair[1] - pair[0])?;
    let (first, last) = (widest[0], widest[1]);
    steps.sort_unstable();
    let usual = steps[steps.len() / 2];
    let end = |k: usize| from + k as f64 * width;
    (last - first > 3 * usual).then(|| [end(first + 1), end(last)])
}

/// As the diagnosis reckons it where no pose was reached again.
fn floor_mm(session: &Session) -> Option<f64> {
    let spatial = session.samples.z_mm.is_some();
    let axes: usize = if spatial { 3 } else { 2 };
    match session.instrument.sigma_mm? {
        Sigma::Overall(sigma) => Some(sigma * (axes as f64).sqrt()),
        Sigma::PerAxis(sigma) => {
            let squares = sigma.iter().take(axes).map(|s| s * s);
            Some(squares.sum::<f64>().sqrt())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sample_is_counted_once_where_it_is() {
        let q = [0.0, 0.01, 59.99, 60.0, f64::NAN];
        let cover = counted(&q, (0.0, 60.0));
        assert_eq!((cover[0], cover[PARTS - 1]), (2, 2));
        assert_eq!(cover.iter().sum::<u32>(), 4);
        assert_eq!(counted(&[1.0], (1.0, 1.0)).iter().sum::<u32>(), 0);
    }

    #[test]
    fn a_hole_is_what_is_wider_than_the_rest_and_even_steps_have_none() {
        let even: Vec<f64> = (0..=20).map(|k| 3.0 * f64::from(k)).collect();
        let range = (0.0, 60.0);
        let found = |q: &[f64]| hole(&counted(q, range), [q[0], q[q.len() - 1]], range);
        assert_eq!(found(&even), None);
        let torn: Vec<f64> = even
            .into_iter()
            .filter(|q| !(20.0..40.0).contains(q))
            .collect();
        let [from, to] = found(&torn).expect("nothing between 18 and 42");
        assert!(
            (18.0..=21.0).contains(&from) && (40.0..=42.5).contains(&to),
            "{from} {to}"
        );
        assert_eq!(found(&[7.0]), None);
    }
}
