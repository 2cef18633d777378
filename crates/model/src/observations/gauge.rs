//! The gauge of the measurements: what none of them can determine, by their kinds alone.
//!
//! Distances from unknown anchors, bearings from unknown stations, touches on unknown planes and
//! targets in unknown sockets all stay as they are when the robot and the places are moved together: the
//! base is open (6). All but the distances stay so when everything grows alike: the size is open too
//! (7). A known length closes it: a joint that slides, targets of known arrangement, a distance
//! between two sockets, two known places.
//!
//! The base is held where it is; the places absorb it. The size is held where the priors alone would have it: for the
//! direction v in which everything grows and prior precisions Λ,
//!
//! ```text
//! wᵀ x = 0,   w = Λ v / (vᵀ Λ v)
//! ```
//!
//! is the minimum of xᵀ Λ x along v. It has to be held, as residuals of touches and sockets are
//! lengths themselves: a robot that shrinks would always seem to fit better.

use nalgebra::{DMatrix, DVector};

use crate::kinematics::JointKind;
use crate::lanes::cross;
use crate::model::Model;
use crate::rounding;

use super::{KINDS, Layer, Observable};
use crate::effects::places::stated;
use crate::effects::{Place, PlaceKind};

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Open {
    /// The place of the base.
    pub base: bool,
    /// How large everything is.
    pub size: bool,
}

/// What the kinds and places that are to be fitted do not determine.
pub fn open(layer: &Layer) -> Open {
    let session = layer.session;
    let references = &session.instrument.references;
    let mut base = session.samples.setups.is_none();
    let mut size = true;
    let mut known_places: Vec<Place> = Vec::new();
    let mut any_point = false;
    for (item, fit) in layer.items.iter().zip(&layer.fit) {
        if !fit {
            continue;
        }
        let kind = KINDS[item.kind];
        let about = kind.about();
        let place = kind.place(session, item.sample);
        let attitude_only = about.looks == Observable::AtAttitude;
        any_point |= !attitude_only;
        let known = place.map(|place| stated(references, place));
        let unknown = match (place.map(|p| p.kind), known) {
            (Some(PlaceKind::Station), Some(known)) => {
                known[0].is_none() && (attitude_only || known[3].is_none())
            }
            (Some(_), Some(known)) => known[0].is_none(),
            _ => false,
        };
        base &= unknown;
        size &= !about.shows_length;
        let placed = match (place.map(|p| p.kind), known) {
            (Some(PlaceKind::Station), Some(known)) => !attitude_only && known[3].is_some(),
            (Some(_), Some(known)) => known[0].is_some(),
            _ => false,
        };
        if let (true, Some(place)) = (placed, place)
            && !known_places.contains(&place)
        {
            known_places.push(place);
        }
    }
    let slides = session
        .robot
        .joints
        .iter()
        .any(|j| j.kind == JointKind::Prismatic);
    let mut targets: Vec<u32> = session.samples.target.clone().unwrap_or_default();
    targets.sort_unstable();
    targets.dedup();
    targets.retain(|target| session.has_placed(*target as usize));
    let arranged = targets.len() > 1;
    let lengths = layer.has_distances() || known_places.len() > 1;
    Open {
        base,
        size: size && any_point && !slides && !arranged && !lengths,
    }
}

/// Parts of the size: the weight of each coefficient in wᵀ x, and how well the priors know it.
#[derive(Debug, Clone, PartialEq)]
pub struct Size {
    /// w, one for each coefficient of the model.
    pub weights: Vec<f64>,
    /// Standard deviation of the size under the priors, as a ratio.
    pub sigma: f64,
}

/// The size of a model by its coefficients; `sigma` states the standard deviation of each from zero. `None` where no
/// coefficient makes anything larger.
pub fn size(layer: &Layer, model: &Model, sigma: &[Option<f64>]) -> Option<Size> {
    let count = model.coefficient_count();
    // Growth about any point, however the whole is turned and moved besides.
    let all = count + 6;
    let mut gram: DMatrix<f64> = DMatrix::zeros(all, all);
    let mut grown: DVector<f64> = DVector::zeros(all);
    let mut samples = 0_usize;
    layer.visit_points(model, |_, point, columns| {
        samples += 1;
        let mut row = vec![[0.0; 3]; all];
        for (to, column) in row.iter_mut().zip(columns) {
            *to = *column;
        }
        for k in 0..3 {
            row[count + k][k] = 1.0;
            let mut axis = [0.0; 3];
            axis[k] = 1e-3;
            row[count + 3 + k] = cross(axis, point);
        }
        for i in 0..all {
            for axis in 0..3 {
                if row[i][axis] == 0.0 {
                    continue;
                }
                grown[i] += row[i][axis] * point[axis];
                for j in 0..all {
                    gram[(i, j)] += row[i][axis] * row[j][axis];
                }
            }
        }
    });
    let ridge = rounding::WRITTEN * samples as f64;
    for (k, sigma) in sigma.iter().enumerate() {
        gram[(k, k)] += sigma.map_or(ridge, |s| ridge / (s * s));
    }
    for k in count..all {
        gram[(k, k)] += 1e-9 * samples as f64;
    }
    let direction = gram.cholesky()?.solve(&grown);
    let precision = |k: usize| sigma[k].map_or(0.0, |s| 1.0 / (s * s));
    let total: f64 = (0..count)
        .map(|k| precision(k) * direction[k].powi(2))
        .sum();
    if total <= 0.0 || !total.is_finite() {
        return None;
    }
    Some(Size {
        weights: (0..count)
            .map(|k| precision(k) * direction[k] / total)
            .collect(),
        sigma: 1.0 / total.sqrt(),
    })
}
