//! The samples as they are uploaded: where each was measured and how far off it was; and with
//! an answer what it leaves, and how sure its model is.
//!
//! Lengths are mm of the measuring frame, in single precision from the middle of the workspace:
//! 0.03 µm at half a metre. Samples stand in an order whose every beginning is spread evenly over
//! the session (steps of the golden ratio), so that the first of them show the whole. Every nth
//! sample would not: where reflectors or directions alternate it is always the same of them.

use std::sync::Arc;

use nalgebra::DMatrix;

use crate::effects::JointValues;
use crate::fit::expected::uncertainties_mm;
use crate::fit::problem::Problem;
use crate::fit::ranges::{along_joint, over_the_ranges};
use crate::model::Model;
use crate::numeric::single;

use crate::gui::core::answer::Answer;
use crate::gui::core::loaded_session::LoadedSession;

/// Measured point, and deviation before.
pub(crate) type Place = [f32; 6];

/// A row of the [`Remainder`].
pub(crate) type RemainderRow = [f32; 5];

#[derive(Debug, Clone, Default)]
pub(crate) struct Cloud {
    /// What is known of each sample that can be used.
    pub(crate) places: Vec<Place>,
    pub(crate) samples: Vec<u32>,
    /// The middle of the workspace, mm of the measuring frame.
    pub(crate) centre_mm: [f64; 3],
}

/// What an answer leaves of the deviations, mm, 1 where the sample is suspected, and the uncertainty of
/// the model there from 0 to 1, below 0 where it is not shown; in the order of the [`Cloud`].
#[derive(Debug, Clone, Default)]
pub(crate) struct Remainder {
    /// One for each sample of the cloud.
    pub(crate) rows: Vec<RemainderRow>,
}

impl Cloud {
    /// That of a session: made when it is first wanted, in the background if possible.
    pub(crate) fn of(loaded_session: &LoadedSession) -> Arc<Self> {
        loaded_session
            .drawn
            .get_or_make(|| Self::new(loaded_session))
    }

    /// The usable samples of a session.
    fn new(loaded_session: &LoadedSession) -> Self {
        let usable = &loaded_session.overview.usable;
        let samples: Vec<u32> = spread(usable.len()).map(|k| usable[k]).collect();
        let [low, high] = loaded_session.overview.measured_mm;
        let centre_mm = std::array::from_fn(|k| {
            let middle = 0.5 * (low[k] + high[k]);
            if middle.is_finite() { middle } else { 0.0 }
        });
        let place = |sample: &u32| {
            let sample = *sample as usize;
            let at = loaded_session.measured(sample);
            let before = loaded_session.deviation_before(sample);
            let mut place = [0.0; 6];
            for k in 0..3 {
                place[k] = single(at[k] - centre_mm[k]);
                place[3 + k] = single(before[k]);
            }
            place
        };
        Self {
            places: samples.iter().map(place).collect(),
            samples,
            centre_mm,
        }
    }

    /// What an answer leaves, of each sample here.
    pub(crate) fn remainder(&self, after_mm: &[Vec<f64>; 3], suspected: &[bool]) -> Remainder {
        let row = |sample: &u32| {
            let sample = *sample as usize;
            let mark = if suspected[sample] { 1.0 } else { 0.0 };
            let [x, y, z] = [0, 1, 2].map(|k| single(after_mm[k][sample]));
            [x, y, z, mark, -1.0]
        };
        Remainder {
            rows: self.samples.iter().map(row).collect(),
        }
    }
}

/// 0 … count in an order whose every beginning is spread evenly: multiples, modulo the count, of
/// a step that has no divisor with it and is nearly its golden section.
fn spread(count: usize) -> impl Iterator<Item = usize> {
    let common = |mut a: usize, mut b: usize| {
        while b != 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    // 0.618034 of any count that memory holds, without rounding.
    let mut step = (count / 1_000_000 * 618_034 + count % 1_000_000 * 618_034 / 1_000_000).max(1);
    while common(step, count) > 1 {
        step += 1;
    }
    let next = move |k: &usize| Some((k + step) % count);
    std::iter::successors((count > 0).then_some(0), next).take(count)
}

/// How sure the model is of what it predicts at each measured pose: one standard uncertainty, mm,
///
/// ```text
/// u(q) = √ tr( J(q) Σ J(q)ᵀ )
/// ```
///
/// with Σ the covariance of the fit; of a single joint that turns also along the way of each reflector, of
/// several joints at poses over their ranges, at rest and without a load. Made in the background, and only where colour shows it.
#[derive(Debug, Clone)]
pub(crate) struct Uncertain {
    /// Of each sample of the session, mm; NaN for samples that cannot be used.
    pub(crate) mm: Vec<f64>,
    /// Of each reflector at the values of [`LoadedSession::over_travel`], mm; none of other robots.
    pub(crate) along_mm: Vec<Vec<f64>>,
    /// At poses over the ranges of several joints: where the model says that the reflector is, in the
    /// measuring frame, mm, and how sure it is of that, mm.
    pub(crate) over: Vec<([f64; 3], f64)>,
    /// The largest, mm.
    pub(crate) most_mm: f64,
    /// What is left of the deviations, with the uncertainty, as it is uploaded.
    pub(crate) remainder: Arc<Remainder>,
}

impl Uncertain {
    /// Whether an answer says how sure it is: its fit has a covariance.
    pub(crate) fn is_known(answer: &Answer) -> bool {
        let found = &answer.identification;
        let count = found.model.coefficient_count();
        count > 0
            && found
                .covariance
                .as_ref()
                .is_some_and(|c| c.nrows() == count)
    }

    /// That of an answer; `None` where it does not say. Takes its time with many samples.
    pub(crate) fn of(loaded_session: &LoadedSession, answer: &Answer) -> Option<Self> {
        let found = &answer.identification;
        let covariance = found
            .covariance
            .as_ref()
            .filter(|_| Self::is_known(answer))?;
        let problem = Problem::new(&loaded_session.session, JointValues::Commanded);
        let mut mm = uncertainties_mm(&found.model, &problem.inputs, covariance)?;
        for (value, usable) in mm.iter_mut().zip(&loaded_session.usable) {
            if !usable {
                *value = f64::NAN;
            }
        }
        let values = loaded_session.over_travel();
        let along = (!values.is_empty())
            .then(|| uncertainties_mm(&found.model, &along_joint(&problem, &values), covariance));
        let along = along.flatten().unwrap_or_default();
        let along = along.chunks(values.len().max(1)).map(<[f64]>::to_vec);
        let along_mm: Vec<Vec<f64>> = along.collect();
        let over = if loaded_session.session.robot.joint_count() > 1 {
            over_the_workspace(&found.model, &problem, covariance)
        } else {
            Vec::new()
        };
        let most_mm = mm
            .iter()
            .chain(along_mm.iter().flatten())
            .chain(over.iter().map(|(_, mm)| mm))
            .copied()
            .filter(|v| v.is_finite())
            .fold(0.0, f64::max);
        let cloud = Cloud::of(loaded_session);
        let mut remainder = cloud.remainder(&answer.after_mm, &answer.suspected);
        for (row, sample) in remainder.rows.iter_mut().zip(&cloud.samples) {
            #[allow(clippy::cast_possible_truncation, reason = "a part of a scale")]
            let part = (mm[*sample as usize] / most_mm) as f32;
            row[4] = if part.is_finite() { part } else { -1.0 };
        }
        (most_mm > 0.0).then(|| Self {
            mm,
            along_mm,
            over,
            most_mm,
            remainder: Arc::new(remainder),
        })
    }
}

/// See [`Uncertain::over`].
fn over_the_workspace(
    model: &Model,
    problem: &Problem,
    covariance: &DMatrix<f64>,
) -> Vec<([f64; 3], f64)> {
    let inputs = over_the_ranges(problem);
    let sure = uncertainties_mm(model, &inputs, covariance).unwrap_or_default();
    let at = model.predict(&inputs);
    let all = sure.into_iter().enumerate();
    let all = all.map(|(k, mm)| ([at.x_mm[k], at.y_mm[k], at.z_mm[k]], mm));
    all.filter(|(at, mm)| mm.is_finite() && at.iter().all(|v| v.is_finite()))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::testing::workbench;
    use crate::gui::view::Colouring;

    #[test]
    fn every_beginning_of_the_order_is_spread_evenly() {
        for count in [0_usize, 1, 2, 3, 100, 1000, 4097] {
            let order: Vec<usize> = spread(count).collect();
            let mut sorted = order.clone();
            sorted.sort_unstable();
            assert!(sorted.iter().copied().eq(0..count), "{count}");
        }
        // No gap is much wider than the mean one; the step is whole, the golden section is not.
        for (count, first) in [(100_000, 500), (1_000_008, 6_000), (36_000, 1_000)] {
            let mut some: Vec<usize> = spread(count).take(first).collect();
            some.sort_unstable();
            let widest = some.windows(2).map(|pair| pair[1] - pair[0]).max();
            assert!(widest <= Some(4 * count / first), "{count} {widest:?}");
        }
        // Whatever alternates is met in all its forms.
        for period in [2, 3, 4, 16] {
            let mut met: Vec<usize> = spread(1_000_000).take(64).map(|k| k % period).collect();
            met.sort_unstable();
            met.dedup();
            assert_eq!(met.len(), period);
        }
    }

    #[test]
    fn the_cloud_holds_what_the_session_holds() {
        let workbench = workbench();
        let loaded_session = workbench.loaded_session();
        let cloud = Cloud::of(loaded_session);
        assert_eq!(cloud.places.len(), loaded_session.overview.usable.len());
        for (place, sample) in cloud.places.iter().zip(&cloud.samples) {
            let measured = loaded_session.measured(*sample as usize);
            let before = loaded_session.deviation_before(*sample as usize);
            for k in 0..3 {
                let at = f64::from(place[k]) + cloud.centre_mm[k];
                assert!((at - measured[k]).abs() < 1e-4);
                assert!((f64::from(place[3 + k]) - before[k]).abs() < 1e-5);
            }
        }
    }

    /// Difference of a coefficient, in its own unit.
    const STEP: f64 = 1e-6;

    /// The same by differences of predictions, for one pose.
    fn by_differences(answer: &Answer, loaded_session: &LoadedSession, sample: usize) -> f64 {
        let found = &answer.identification;
        let inputs = Problem::new(&loaded_session.session, JointValues::Commanded).inputs;
        let predicted = |shift: &dyn Fn(usize) -> f64| {
            let mut k = 0;
            let terms = found.model.terms().iter().cloned().map(|mut term| {
                for coefficient in &mut term.coefficients {
                    *coefficient += shift(k);
                    k += 1;
                }
                term
            });
            let model = Model::new(found.model.robot.clone(), terms.collect());
            let at = model.predict(&inputs);
            [at.x_mm[sample], at.y_mm[sample], at.z_mm[sample]]
        };
        let count = found.model.coefficient_count();
        let columns: Vec<[f64; 3]> = (0..count)
            .map(|c| {
                let side = |sign: f64| predicted(&|k| if k == c { sign * STEP } else { 0.0 });
                let (above, below) = (side(1.0), side(-1.0));
                [0, 1, 2].map(|k| (above[k] - below[k]) / (2.0 * STEP))
            })
            .collect();
        let covariance = found.covariance.as_ref().expect("a covariance");
        let mut trace: f64 = 0.0;
        for (a, of_a) in columns.iter().enumerate() {
            for (b, of_b) in columns.iter().enumerate() {
                let both: f64 = (0..3).map(|k| of_a[k] * of_b[k]).sum();
                trace += both * covariance[(a, b)];
            }
        }
        trace.sqrt()
    }

    #[test]
    fn it_is_what_the_covariance_makes_of_the_prediction() {
        let mut workbench = workbench();
        workbench.execute(|bench| bench.identify(None));
        workbench.execute(|bench| bench.view.colouring = Colouring::Uncertainty);
        workbench.receive();
        let uncertain = workbench.uncertain().expect("it is known");
        let answer = workbench.answer().expect("an answer");
        let loaded_session = workbench.loaded_session();
        for sample in [0, 7, loaded_session.len() - 1] {
            let expected = by_differences(answer, loaded_session, sample);
            let found = uncertain.mm[sample];
            assert!((found / expected - 1.0).abs() < 1e-4, "{found} {expected}");
        }
        let cloud = Cloud::of(loaded_session);
        for (row, sample) in uncertain.remainder.rows.iter().zip(&cloud.samples) {
            let part = uncertain.mm[*sample as usize] / uncertain.most_mm;
            assert!((f64::from(row[4]) - part).abs() < 1e-6);
        }
    }

    #[test]
    fn between_the_samples_it_is_known_along_the_way_of_each_reflector() {
        let mut workbench = workbench();
        workbench.execute(|bench| bench.identify(None));
        workbench.execute(|bench| bench.view.colouring = Colouring::Uncertainty);
        workbench.receive();
        let uncertain = workbench.uncertain().expect("it is known");
        let loaded_session = workbench.loaded_session();
        let values = loaded_session.over_travel();
        assert_eq!(
            uncertain.along_mm.len(),
            loaded_session.session.targets.len()
        );
        assert!(
            uncertain
                .along_mm
                .iter()
                .all(|way| way.len() == values.len())
        );
        // Zero and length turn with the joint: where a sample lies, it is that of the sample.
        let of = |sample: usize| {
            let q = loaded_session.q(sample);
            let near = |k: &usize| (values[*k] - q).abs();
            let at = (0..values.len()).min_by(|a, b| near(a).total_cmp(&near(b)));
            let target = loaded_session.session.samples.target.as_ref();
            let way = target.map_or(0, |t| t[sample] as usize);
            uncertain.along_mm[way][at.expect("values")]
        };
        for sample in [0, 7, loaded_session.len() - 1] {
            let (way, own) = (of(sample), uncertain.mm[sample]);
            assert!((way / own - 1.0).abs() < 0.02, "{way} {own}");
        }
    }

    #[test]
    fn of_several_joints_it_is_known_over_their_ranges_as_the_answer_says() {
        let mut workbench = workbench();
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/arms");
        workbench.execute(|bench| bench.open_file(folder.join("six-60.json")));
        workbench.receive();
        workbench.execute(|bench| bench.identify(None));
        workbench.execute(|bench| bench.view.colouring = Colouring::Uncertainty);
        workbench.receive();
        let uncertain = workbench.uncertain().expect("it is known");
        let said = workbench
            .answer()
            .expect("an answer")
            .identification
            .expected
            .as_ref();
        let squares: f64 = uncertain.over.iter().map(|(_, mm)| mm * mm).sum();
        let rms_mm = (squares / uncertain.over.len() as f64).sqrt();
        let most_mm = uncertain.over.iter().map(|(_, mm)| *mm).fold(0.0, f64::max);
        let said = said.expect("it says so");
        assert!((rms_mm / said.rms_mm - 1.0).abs() < 1e-9);
        assert!((most_mm / said.max_mm - 1.0).abs() < 1e-9);
        assert!(uncertain.most_mm >= most_mm);
    }
}
