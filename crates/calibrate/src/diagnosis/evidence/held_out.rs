//! Cross-validation: the samples are cut into blocks, and each block is predicted by a fit without it, its settings
//! scanned again (cross-fitting, Stone 1974).
//!
//! Blocks are ranges of the joint angles where the joints move at random, and otherwise stretches of time; several
//! small ones make one fold, so that no fold has to be extrapolated. All rows of a pose are in one fold, and of an arm
//! all that were measured when it came back: they do not test another pose.

use nalgebra::DVector;

use crate::fit::regression::Rows;
use crate::model::Model;
use crate::text::Text;
use crate::{budget, fewest};

use super::fit::Fit;
use super::regression::Regression;
use super::rescanned::Rescanned;
use crate::sessions::cells::{cells, folds_of_groups};
use crate::sessions::poses::ByPose;

/// Which fold each sample of the rows is in.
#[derive(Debug, Clone)]
pub(crate) struct Folds {
    fold: Vec<usize>,
    /// Number of poses.
    poses: usize,
    /// Whether unseen poses are predicted; else it is other visits to the same few.
    pub(crate) predict_poses: bool,
    count: usize,
    /// In words.
    pub(crate) how: Text,
}

/// Residuals of samples that a fit has not seen.
pub(crate) struct HeldOutResiduals {
    /// Root mean square length, in the unit of the rows.
    pub(crate) rms: f64,
    /// The same in mm.
    pub(crate) rms_mm: f64,
    pub(crate) rows: DVector<f64>,
}

const _: () = assert!(budget::FOLDS == 5, "the answer speaks of fifths");
/// With fewer poses no error on unseen ones is reported.
pub(crate) const FEWEST: usize = 6;

fn each_fifth(joint: usize) -> Text {
    text!(
        "each fifth of the positions of joint {joint} (spread over its range) predicted by a fit that has not seen it",
        joint
    )
}

/// The samples of rows by their poses.
fn poses_of(rows: &Rows) -> ByPose {
    ByPose::of(rows.inputs.pose.as_deref(), rows.samples.len())
}

impl Folds {
    /// Folds over the samples of a regression, by the angle of the first joint that moves most.
    pub(crate) fn new(regression: &Regression) -> Self {
        if regression.base.robot.joints.len() > 1 {
            return Self::over_cells(&regression.rows, &regression.base);
        }
        let q = &regression.rows.inputs.q;
        let range = |column: &[f64]| {
            let values = column.iter().copied();
            let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| {
                (a.min(v), b.max(v))
            });
            high - low
        };
        let widest = (0..q.len()).max_by(|a, b| range(&q[*a]).total_cmp(&range(&q[*b])));
        let column = widest.map_or(&[][..], |j| &*q[j]);
        let poses = poses_of(&regression.rows);
        let n = poses.first.len();
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|a, b| {
            let value = |k: usize| column.get(poses.first[k]).copied().unwrap_or(0.0);
            value(*a).total_cmp(&value(*b)).then(a.cmp(b))
        });
        let (count, sectors) = if n < fewest::TO_SCAN {
            let sectors = (n / 3).clamp(2, 10);
            (sectors, sectors)
        } else {
            (budget::FOLDS, 4 * budget::FOLDS)
        };
        let mut fold = vec![0; n];
        for (rank, pose) in order.iter().enumerate() {
            fold[*pose] = (rank * sectors / n.max(1)) % count;
        }
        let joint = widest.map_or(1, |j| j + 1);
        let how = if n < fewest::TO_SCAN {
            text!(
                "each of {sectors} parts of the range of joint {joint} predicted by a fit that has not seen it",
                sectors,
                joint
            )
        } else {
            each_fifth(joint)
        };
        Self::of_poses(&poses, &fold, count, how)
    }

    /// Folds over the values of a single joint, each fifth in turn: what is smooth over it is predicted by its neighbours.
    pub(crate) fn over_values(rows: &Rows) -> Self {
        let places = ByPose::of_places(&rows.inputs.q, rows.samples.len());
        let value = |place: usize| rows.inputs.q[0][places.first[place]];
        let mut order: Vec<usize> = (0..places.first.len()).collect();
        order.sort_by(|a, b| value(*a).total_cmp(&value(*b)));
        let mut fold = vec![0; order.len()];
        for (rank, place) in order.into_iter().enumerate() {
            fold[place] = rank % budget::FOLDS;
        }
        Self::of_poses(&places, &fold, budget::FOLDS, each_fifth(1))
    }

    /// The folds of samples by those of their poses: rows of a pose share the error of repeatability.
    fn of_poses(poses: &ByPose, fold: &[usize], count: usize, how: Text) -> Self {
        Self {
            fold: poses.to_samples(fold),
            poses: poses.first.len(),
            predict_poses: poses.first.len() >= FEWEST,
            count,
            how,
        }
    }

    /// Folds over cells of the workspace, for a robot with several joints.
    pub(crate) fn over_cells(rows: &Rows, model: &Model) -> Self {
        let points = rows.points(model);
        let places = ByPose::of_places(&rows.inputs.q, rows.samples.len());
        if places.first.len() < FEWEST {
            let visits = Self::over_cells_of(rows, &points, &poses_of(rows));
            return Self {
                predict_poses: false,
                ..visits
            };
        }
        Self::over_cells_of(rows, &points, &places)
    }

    fn over_cells_of(rows: &Rows, points: &[[f64; 3]], poses: &ByPose) -> Self {
        let points: Vec<[f64; 3]> = poses.first.iter().map(|k| points[*k]).collect();
        let n = points.len();
        if let Some(rows) = rows.observed() {
            let references = rows.layer().references();
            let references: Vec<usize> = poses.first.iter().map(|k| references[*k]).collect();
            let fold = folds_of_groups(&points, &references, budget::FOLDS);
            let how = text!(
                "each fifth of the measurements, of every reference its own, predicted by a fit that has not seen it"
            );
            return Self::of_poses(poses, &fold, budget::FOLDS, how);
        }
        let few = n < fewest::TO_SCAN;
        let wanted = if few {
            (n / 3).clamp(2, 10)
        } else {
            4 * budget::FOLDS
        };
        let cell = cells(&points, wanted);
        let made = cell.iter().max().map_or(1, |c| c + 1);
        let count = if few { made } else { budget::FOLDS };
        let fold: Vec<usize> = cell.into_iter().map(|c| c % count).collect();
        let how = if few {
            text!(
                "each of {count} cells of the workspace predicted by a fit that has not seen it",
                count = made
            )
        } else {
            text!(
                "each fifth of the cells of the workspace predicted by a fit that has not seen it"
            )
        };
        Self::of_poses(poses, &fold, count, how)
    }

    /// Number of samples.
    pub(crate) fn samples(&self) -> usize {
        self.fold.len()
    }

    /// Number of folds.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// The fold that a sample is in.
    pub(crate) fn of(&self, sample: usize) -> usize {
        self.fold[sample]
    }

    /// Whether there are enough poses to report an error.
    pub(crate) fn are_enough(&self) -> bool {
        self.poses >= FEWEST
    }

    /// Root mean square length of the deviations of samples that the fit has not seen, mm; of other
    /// measurements than plain points in units of their noise, each by its own.
    pub(crate) fn rms(&self, regression: &Regression, fit: &Fit) -> f64 {
        self.known(regression, fit)[0]
    }

    /// The same in mm whatever was measured.
    pub(crate) fn rms_mm(&self, regression: &Regression, fit: &Fit) -> f64 {
        self.known(regression, fit)[1]
    }

    fn known(&self, regression: &Regression, fit: &Fit) -> [f64; 2] {
        regression.unseen.of(fit, || {
            let unseen = self.unseen(regression, fit);
            [unseen.rms, unseen.rms_mm]
        })
    }

    /// As [`Self::rms_mm`], of the fit's model alone: its shapes are fitted with it and predict nothing.
    pub(crate) fn rms_mm_of_the_model(&self, regression: &Regression, fit: &Fit) -> f64 {
        let columns = fit.model.coefficient_count();
        self.predicted_by(regression, fit, columns).rms_mm
    }

    /// The residuals of samples that the fit has not seen.
    pub(crate) fn unseen(&self, regression: &Regression, fit: &Fit) -> HeldOutResiduals {
        self.predicted_by(regression, fit, usize::MAX)
    }

    /// The same where the first so many columns of the fit predict.
    fn predicted_by(&self, regression: &Regression, fit: &Fit, columns: usize) -> HeldOutResiduals {
        if !self.are_enough() {
            // Too few samples to hold any out: the fit's own residual, so that the comparison always passes.
            return HeldOutResiduals {
                rms: fit.rss.sqrt(),
                rms_mm: fit.rss.sqrt(),
                rows: DVector::zeros(regression.rows.len()),
            };
        }
        let rescanned = Rescanned::new(regression, fit);
        let n = self.fold.len();
        let (mut sum, mut sum_mm) = (0.0, 0.0);
        let mut residuals = DVector::zeros(regression.rows.len());
        let rows = regression.rows.len();
        let unseen = (0..self.count).map(|fold| -> Vec<usize> {
            (0..rows).filter(|row| self.fold[row % n] == fold).collect()
        });
        let unseen: Vec<Vec<usize>> = unseen.collect();
        let folds = rescanned.residuals(&unseen, columns);
        for (unseen, of_fold) in unseen.into_iter().zip(folds) {
            for (row, e) in unseen.into_iter().zip(of_fold) {
                let mm = regression.rows.mm(row) * e;
                residuals[row] = e;
                sum += e * e;
                sum_mm += mm * mm;
            }
        }
        let lengths = regression.rows.lengths();
        HeldOutResiduals {
            rms: (sum / n as f64).sqrt(),
            rms_mm: (sum_mm / lengths as f64).sqrt(),
            rows: residuals,
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnosis::Options;
    use crate::diagnosis::search::prepare::PreparedSearch;
    use crate::fit::example::unrepeated;

    #[test]
    fn rows_of_a_pose_are_in_one_fold() {
        let session = unrepeated(0.0, 1);
        let options = Options {
            held_out: Some(0.2),
            ..Options::default()
        };
        let prepared = PreparedSearch::new(&session, &options).unwrap();
        let samples = &prepared.regression.rows.samples;
        let mut of_pose = vec![None; 60];
        for (k, sample) in samples.iter().enumerate() {
            let fold = of_pose[sample / 3].get_or_insert(prepared.folds.of(k));
            assert_eq!(*fold, prepared.folds.of(k), "{sample}");
        }
        for fold in 0..prepared.folds.count() {
            assert!(of_pose.contains(&Some(fold)));
        }
        // What is locked away is so by poses too.
        assert!(prepared.locked.contains(&true));
        assert!(
            prepared
                .locked
                .chunks(3)
                .all(|pose| pose.iter().all(|l| *l == pose[0]))
        );
    }
}
