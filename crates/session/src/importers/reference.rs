//! Brings measured points into the base frame by points that are known there.
//!
//! `p_base = s R p_measured + t`: the best rigid motion in closed form (Arun, Huang & Blostein 1987),
//! on request with a scale (Umeyama 1991). A point that was measured wrongly must not pull the
//! others along: the motion is first sought that fits a majority best (least trimmed squares over
//! motions through three points, Rousseeuw 1984), then points join as long as their distance is what
//! the noise of those inside allows, by F with a chance of 1 in 10 000 per point.

use nalgebra::{Isometry3, Matrix3, Point3, Vector3};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use crate::importers::clock::FARTHEST_MM;
use crate::kinematics::rigid_motion::rigid_motion;
use crate::refusal::Refusal;

/// Up to so many points every triple is tried.
const ALL_TRIPLES: usize = 24;
/// Triples that are tried with more points.
const TRIPLES: usize = 2000;
/// How rarely a good point is taken for an outlier.
const CHANCE: f64 = 1e-4;
/// Points whose second extent is this part of the first, or less, lie on a line.
const LINE: f64 = 1e-3;

/// A point that is known in the base frame, and where it was measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Landmark {
    /// Its name.
    pub name: String,
    /// Where it was measured, mm.
    pub measured: Point3<f64>,
    /// Where it is in the base frame, mm.
    pub in_base: Point3<f64>,
}

/// How far a point is off after the alignment.
#[derive(Debug, Clone, PartialEq)]
pub struct Residual {
    /// Its name.
    pub name: String,
    /// Aligned less known, base frame, mm.
    pub vector_mm: Vector3<f64>,
    /// Whether it was left out.
    pub is_outlier: bool,
}

/// The motion that brings measured points into the base frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Alignment {
    /// Rotation and shift; the shift in mm.
    pub base_from_instrument: Isometry3<f64>,
    /// The scale that was fitted; 1 unless it was asked for.
    pub scale: f64,
    /// The scale that would fit best, also where it was not asked for.
    pub best_scale: f64,
    /// One for each landmark, in their order.
    pub residuals: Vec<Residual>,
    /// Root mean square of the residuals that were kept, mm.
    pub rms_mm: f64,
}

impl Alignment {
    /// A measured point in the base frame, mm.
    pub fn to_base(&self, measured: &Point3<f64>) -> Point3<f64> {
        self.base_from_instrument * Point3::from(measured.coords * self.scale)
    }

    /// Points that were left out.
    pub fn outliers(&self) -> impl Iterator<Item = &Residual> {
        self.residuals.iter().filter(|residual| residual.is_outlier)
    }
}

/// Finds the motion from measured to known points, and the points that do not fit.
///
/// # Errors
/// Fewer than three points, or points on one line.
pub fn align(landmarks: &[Landmark], with_scale: bool) -> Result<Alignment, Refusal> {
    if landmarks.len() < 3 {
        return Err(Refusal(text!(
            one "{count} point with a name that is known in the base frame; a place and an orientation take 3",
            "{count} points with a name that is known in the base frame; a place and an orientation take 3",
            count = landmarks.len()
        )));
    }
    let on_one_line = || {
        Refusal(text!(
            "the points lie on one line: nothing fixes the turn about it"
        ))
    };
    let no_majority = || {
        Refusal(text!(
            "the points contradict each other: no majority of them fits"
        ))
    };
    let near = |point: &Point3<f64>| point.coords.amax() < FARTHEST_MM;
    if !landmarks
        .iter()
        .all(|l| near(&l.in_base) && near(&l.measured))
    {
        return Err(Refusal(text!(
            "a reference point is more than a million kilometres away"
        )));
    }
    if on_a_line(landmarks.iter().map(|l| l.in_base))
        || on_a_line(landmarks.iter().map(|l| l.measured))
    {
        return Err(on_one_line());
    }
    let inside = majority(landmarks, with_scale).ok_or_else(no_majority)?;
    let inside = grown(landmarks, inside, with_scale).ok_or_else(no_majority)?;
    let chosen: Vec<&Landmark> = chosen(landmarks, &inside);
    if on_a_line(chosen.iter().map(|l| l.in_base)) {
        return Err(on_one_line());
    }
    let fit = Fit::of(&chosen, with_scale).ok_or_else(no_majority)?;
    let residuals: Vec<Residual> = landmarks
        .iter()
        .zip(&inside)
        .map(|(landmark, inside)| Residual {
            name: landmark.name.clone(),
            vector_mm: fit.residual(landmark),
            is_outlier: !inside,
        })
        .collect();
    let kept: Vec<f64> = residuals
        .iter()
        .filter(|residual| !residual.is_outlier)
        .map(|residual| residual.vector_mm.norm_squared())
        .collect();
    Ok(Alignment {
        base_from_instrument: fit.motion,
        scale: fit.scale,
        best_scale: Fit::of(&chosen, true).map_or(1.0, |fit| fit.scale),
        rms_mm: (kept.iter().sum::<f64>() / kept.len() as f64).sqrt(),
        residuals,
    })
}

fn chosen<'l>(landmarks: &'l [Landmark], inside: &[bool]) -> Vec<&'l Landmark> {
    let with = landmarks.iter().zip(inside);
    with.filter(|(_, inside)| **inside)
        .map(|(landmark, _)| landmark)
        .collect()
}

/// Whether points lie on one line.
fn on_a_line(points: impl Iterator<Item = Point3<f64>> + Clone) -> bool {
    let count = points.clone().count().max(1) as f64;
    let centre = points.clone().map(|p| p.coords).sum::<Vector3<f64>>() / count;
    let scatter: Matrix3<f64> = points
        .map(|p| (p.coords - centre) * (p.coords - centre).transpose())
        .sum();
    let mut extents: Vec<f64> = crate::decompose::eigen(scatter)
        .eigenvalues
        .iter()
        .map(|v| v.max(0.0).sqrt())
        .collect();
    extents.sort_by(f64::total_cmp);
    // Written so that what is not a number lies on a line too.
    let spread = extents[1] > LINE * extents[2];
    !spread
}

/// A motion, perhaps with a scale.
struct Fit {
    motion: Isometry3<f64>,
    scale: f64,
}

impl Fit {
    fn of(landmarks: &[&Landmark], with_scale: bool) -> Option<Self> {
        let pairs = |scale: f64| -> Vec<(Vector3<f64>, Vector3<f64>)> {
            let pairs = landmarks.iter();
            let pairs = pairs.map(|l| (l.measured.coords * scale, l.in_base.coords));
            pairs.collect()
        };
        let mut scale = 1.0;
        if with_scale {
            // The scale is that of the extents along the best rotation, which it does not change.
            let pairs = pairs(1.0);
            let motion = rigid_motion(&pairs)?;
            let count = landmarks.len() as f64;
            let from = pairs.iter().map(|p| p.0).sum::<Vector3<f64>>() / count;
            let to = pairs.iter().map(|p| p.1).sum::<Vector3<f64>>() / count;
            let along: f64 = pairs
                .iter()
                .map(|p| (p.1 - to).dot(&(motion.rotation * (p.0 - from))))
                .sum();
            let squares: f64 = pairs.iter().map(|p| (p.0 - from).norm_squared()).sum();
            scale = along / squares;
            let sound = scale > 0.0 && scale.is_finite();
            if !sound {
                return None;
            }
        }
        let motion = rigid_motion(&pairs(scale))?;
        Some(Self { motion, scale })
    }

    fn residual(&self, landmark: &Landmark) -> Vector3<f64> {
        let measured = Point3::from(landmark.measured.coords * self.scale);
        self.motion * measured - landmark.in_base
    }
}

/// The points that the best motion through three of them fits best: a majority.
fn majority(landmarks: &[Landmark], with_scale: bool) -> Option<Vec<bool>> {
    let n = landmarks.len();
    // A little more than half, but at least three.
    let most = n.div_ceil(2).max(3).min(n);
    let most = (n + 3).div_euclid(2).clamp(most, n);
    let mut best: Option<(f64, Vec<bool>)> = None;
    let mut try_triple = |triple: [usize; 3]| {
        let three = triple.map(|index| &landmarks[index]);
        if on_a_line(three.iter().map(|l| l.in_base)) || on_a_line(three.iter().map(|l| l.measured))
        {
            return;
        }
        let Some(fit) = Fit::of(&three, with_scale) else {
            return;
        };
        let mut distances: Vec<(f64, usize)> = landmarks
            .iter()
            .enumerate()
            .map(|(index, landmark)| (fit.residual(landmark).norm_squared(), index))
            .collect();
        distances.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let sum: f64 = distances[..most].iter().map(|d| d.0).sum();
        if best.as_ref().is_none_or(|(other, _)| sum < *other) {
            let mut inside = vec![false; n];
            for (_, index) in &distances[..most] {
                inside[*index] = true;
            }
            best = Some((sum, inside));
        }
    };
    if n <= ALL_TRIPLES {
        for a in 0..n {
            for b in a + 1..n {
                for c in b + 1..n {
                    try_triple([a, b, c]);
                }
            }
        }
    } else {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for _ in 0..TRIPLES {
            // The same point twice makes no triple: it lies on a line.
            try_triple([0; 3].map(|_: usize| index(&mut rng, n)));
        }
    }
    best.map(|best| best.1)
}

/// One of so many, nearly all alike likely.
fn index(rng: &mut ChaCha8Rng, count: usize) -> usize {
    usize::try_from(rng.next_u64() % count as u64).unwrap_or(0)
}

/// Lets points join whose distance the noise of those inside allows, until nothing changes.
fn grown(landmarks: &[Landmark], mut inside: Vec<bool>, with_scale: bool) -> Option<Vec<bool>> {
    const ROUNDS: usize = 100;
    let parameters = if with_scale { 7.0 } else { 6.0 };
    let size = landmarks
        .iter()
        .map(|l| l.in_base.coords.amax())
        .fold(0.0, f64::max);
    // Files are rounded: a millionth of the extent is no outlier.
    let rounding = 1e-6 * size;
    for _ in 0..ROUNDS {
        let kept = chosen(landmarks, &inside);
        let fit = Fit::of(&kept, with_scale)?;
        let freedom = 3.0 * kept.len() as f64 - parameters;
        let sum: f64 = kept.iter().map(|l| fit.residual(l).norm_squared()).sum();
        let variance = sum / freedom + rounding * rounding;
        let limit = 3.0
            * variance
            * FisherSnedecor::new(3.0, freedom)
                .ok()?
                .inverse_cdf(1.0 - CHANCE);
        let next: Vec<bool> = landmarks
            .iter()
            .zip(&inside)
            .map(|(l, inside)| *inside || fit.residual(l).norm_squared() <= limit)
            .collect();
        if next == inside {
            break;
        }
        // One at a time, the nearest: it may show that the noise is larger than it seemed.
        let nearest = (0..landmarks.len())
            .filter(|&i| next[i] && !inside[i])
            .min_by(|&a, &b| {
                let distance = |i: usize| fit.residual(&landmarks[i]).norm_squared();
                distance(a).total_cmp(&distance(b))
            });
        match nearest {
            // With many points one at a time would take long, and changes little.
            Some(index) if landmarks.len() <= 1000 => inside[index] = true,
            _ => inside = next,
        }
    }
    Some(inside)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn landmarks(count: usize, noise_mm: f64, scale: f64) -> Vec<Landmark> {
        let motion = Isometry3::new(
            Vector3::new(1500.0, -300.0, 200.0),
            Vector3::new(0.2, 0.4, -1.9),
        );
        (0..count)
            .map(|i| {
                let wave = |k: f64| (k * (i as f64 + 1.0)).sin();
                let known = Point3::new(900.0 * wave(1.3), 700.0 * wave(2.1), 400.0 * wave(0.7));
                let noise = Vector3::new(wave(17.3), wave(29.1), wave(41.9)) * noise_mm;
                let measured = motion.inverse_transform_point(&known).coords * scale + noise;
                Landmark {
                    name: format!("R{i}"),
                    measured: measured.into(),
                    in_base: known,
                }
            })
            .collect()
    }

    #[test]
    fn the_motion_is_found_whatever_the_instrument_stands_like() {
        for count in [3, 4, 7, 200] {
            let found = align(&landmarks(count, 0.02, 1.0), false).expect("points in space");
            assert!(found.rms_mm < 0.04, "{count}: {}", found.rms_mm);
            assert_eq!(found.outliers().count(), 0, "{count}");
            assert!(
                (found.best_scale - 1.0).abs() < 1e-4,
                "{}",
                found.best_scale
            );
        }
    }

    #[test]
    fn a_scale_is_fitted_only_on_request_and_shown_always() {
        let points = landmarks(8, 0.01, 1.001);
        let rigid = align(&points, false).expect("points in space");
        assert_eq!(rigid.scale, 1.0);
        assert!(
            (rigid.best_scale * 1.001 - 1.0).abs() < 3e-5,
            "{}",
            rigid.best_scale
        );
        let scaled = align(&points, true).expect("points in space");
        assert_eq!(scaled.scale, scaled.best_scale);
        assert!(scaled.rms_mm < 0.03 && rigid.rms_mm > 0.3);
    }

    #[test]
    fn a_point_that_was_measured_wrongly_is_found_and_does_not_pull() {
        for count in [5, 6, 8, 40] {
            let mut points = landmarks(count, 0.02, 1.0);
            points[2].measured.x += 15.0;
            let found = align(&points, false).expect("points in space");
            let out: Vec<&str> = found.outliers().map(|r| r.name.as_str()).collect();
            assert_eq!(out, ["R2"], "{count}");
            assert!(found.rms_mm < 0.04, "{count}: {}", found.rms_mm);
            let off = found.residuals[2].vector_mm.norm();
            assert!((off - 15.0).abs() < 0.5, "{count}: {off}");
        }
    }

    #[test]
    fn points_that_fix_nothing_are_refused() {
        let mut points = landmarks(5, 0.0, 1.0);
        assert!(align(&points[..2], false).is_err());
        for (i, point) in points.iter_mut().enumerate() {
            point.in_base = Point3::new(100.0 * i as f64, 20.0 * i as f64, 0.0);
        }
        assert!(align(&points, false).is_err());
        for point in &mut points {
            point.in_base = Point3::origin();
        }
        assert!(align(&points, false).is_err());
    }
}
