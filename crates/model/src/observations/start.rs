//! Starting values of a fit: the frame of an instrument that was never aligned, unknown places, a tool that is mounted
//! turned. Everything is found from the target of the nominal robot, which is near enough.

use std::collections::BTreeMap;

use nalgebra::{
    DMatrix, DVector, Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3,
};

use crate::decompose;
use crate::effects::{Place, PlaceKind, Term, places};
use crate::kinematics::quaternion::log_of_matrix;
use crate::model::Model;
use crate::sessions::Session;
use crate::{budget, fewest, rounding};

use super::kinds::orientation::measured;
use super::{KINDS, Layer, Observable, Residual, Seen};
use crate::effects::place::MOST;
use crate::effects::places::stated;

/// The prediction of a model for one item: where its target is, and the orientation of the tool.
type Prediction = ([f64; 3], [[f64; 3]; 3]);

/// Every place that the items to be fitted refer to, with those items.
fn places_in_use(layer: &Layer) -> Vec<(Place, Vec<usize>)> {
    let mut all: BTreeMap<Place, Vec<usize>> = BTreeMap::new();
    for (index, item) in layer.items.iter().enumerate() {
        let Some(place) = KINDS[item.kind].place(layer.session, item.sample) else {
            continue;
        };
        if !layer.fit[index] {
            continue;
        }
        all.entry(place).or_default().push(index);
    }
    all.into_iter().collect()
}

/// At most so many of them, evenly.
fn thinned(items: &[usize]) -> Vec<usize> {
    let count = items.len().min(budget::OF_A_TRIAL);
    (0..count).map(|k| items[k * items.len() / count]).collect()
}

/// Terms of every place that is not wholly known, from where it seems to be by a model.
pub fn unknown_places(layer: &Layer, model: &Model) -> Vec<Term> {
    let seen = layer.seen(model);
    let references = &layer.session.instrument.references;
    let mut terms = Vec::new();
    for (place, items) in places_in_use(layer) {
        let known = stated(references, place);
        let size = place.kind.effect().about().form.coefficients();
        let attitude_only = attitude_only(layer, &items);
        let needed = if attitude_only { 3 } else { size };
        if known[..needed].iter().all(Option::is_some) {
            continue;
        }
        let start = located(layer, place, &items, &seen, &known);
        terms.push(places::term(references, place, &start, attitude_only));
    }
    terms
}

fn attitude_only(layer: &Layer, items: &[usize]) -> bool {
    let looks = |i: &usize| KINDS[layer.items[*i].kind].about().looks;
    items.iter().all(|i| looks(i) == Observable::AtAttitude)
}

/// Where a place is by its observations; what is `known` of it is kept.
fn located(
    layer: &Layer,
    place: Place,
    items: &[usize],
    seen: &[Prediction],
    values: &[Option<f64>; MOST],
) -> [f64; MOST] {
    let items = thinned(items);
    let guesses = match place.kind {
        PlaceKind::Anchor => anchor_guesses(layer, &items, seen),
        PlaceKind::Station => station_guesses(layer, &items, seen, values),
        PlaceKind::Plane => vec![plane_guess(&items, seen)],
        PlaceKind::Socket => {
            let centre = centre_of(&items, seen);
            vec![[centre.x, centre.y, centre.z, 0.0, 0.0, 0.0]]
        }
    };
    let free: Vec<usize> = (0..MOST).filter(|k| values[*k].is_none()).collect();
    let best = guesses
        .into_iter()
        .map(|guess| {
            let whole = std::array::from_fn(|k| values[k].unwrap_or(guess[k]));
            polished(layer, &items, seen, whole, &free)
        })
        .min_by(|a, b| a.1.total_cmp(&b.1));
    best.map_or([0.0; MOST], |best| best.0)
}

fn centre_of(items: &[usize], seen: &[Prediction]) -> Vector3<f64> {
    let sum: Vector3<f64> = items.iter().map(|i| Vector3::from(seen[*i].0)).sum();
    sum / items.len().max(1) as f64
}

/// All directions of the edges and corners of a cube.
fn around() -> impl Iterator<Item = Vector3<f64>> {
    let steps = [-1.0, 0.0, 1.0];
    let all = steps
        .into_iter()
        .flat_map(move |x| steps.into_iter().map(move |y| (x, y)))
        .flat_map(move |(x, y)| steps.into_iter().map(move |z| Vector3::new(x, y, z)));
    all.filter(|v| *v != Vector3::zeros())
        .map(|v| v.normalize())
}

/// One observation at a place, unweighed.
fn residual(layer: &Layer, item: usize, seen: &[Prediction], place: &[f64; MOST]) -> Residual {
    let own = layer.items[item];
    let (point, attitude) = seen[item];
    let seen = Seen {
        point,
        attitude,
        place,
    };
    KINDS[own.kind].residual(layer.session, own.sample, &seen)
}

/// A place after a search for the least squares of its own observations, and their sum.
fn polished(
    layer: &Layer,
    items: &[usize],
    seen: &[Prediction],
    start: [f64; MOST],
    free: &[usize],
) -> ([f64; MOST], f64) {
    let sums = |at: &[f64; MOST]| {
        let mut gram: DMatrix<f64> = DMatrix::zeros(free.len(), free.len());
        let mut gradient: DVector<f64> = DVector::zeros(free.len());
        let mut cost = 0.0;
        for item in items {
            let own = residual(layer, *item, seen, at);
            let weight = 1.0 / layer.sigma[layer.items[*item].kind].powi(2);
            for row in 0..own.rows {
                cost += weight * own.left[row].powi(2);
                for (i, a) in free.iter().enumerate() {
                    gradient[i] += weight * own.by_place[row][*a] * own.left[row];
                    for (j, b) in free.iter().enumerate() {
                        gram[(i, j)] += weight * own.by_place[row][*a] * own.by_place[row][*b];
                    }
                }
            }
        }
        (gram, gradient, cost)
    };
    let (mut at, mut damping) = (start, 1e-4);
    let (mut gram, mut gradient, mut cost) = sums(&at);
    for _ in 0..budget::STEPS {
        let mut damped = gram.clone();
        for k in 0..free.len() {
            damped[(k, k)] += damping * gram[(k, k)] + f64::MIN_POSITIVE;
        }
        let Some(step) = damped.cholesky().map(|c| c.solve(&gradient)) else {
            damping = f64::max(10.0 * damping, 1e-8);
            if damping * rounding::LAST_BITS > 1.0 {
                break;
            }
            continue;
        };
        let mut trial = at;
        for (k, own) in free.iter().enumerate() {
            trial[*own] += step[k];
        }
        let next = sums(&trial);
        if next.2.is_finite() && next.2 < cost {
            let settled = cost - next.2 < rounding::COMPUTED * cost;
            at = trial;
            (gram, gradient, cost) = next;
            damping /= 10.0;
            if settled {
                break;
            }
        } else {
            damping *= 10.0;
            if damping * rounding::LAST_BITS > 1.0 {
                break;
            }
        }
    }
    (at, cost)
}

/// From the linear equations |p|² − m² = 2 p·a − 2 m o − (|a|² − o²), and from all around.
fn anchor_guesses(layer: &Layer, items: &[usize], seen: &[Prediction]) -> Vec<[f64; MOST]> {
    let centre = centre_of(items, seen);
    // At no distance and without offset the residual is the measured value.
    let measured = |item: usize| {
        let (x, y, z) = seen[item].0.into();
        let here = [x, y, z, 0.0, 0.0, 0.0];
        residual(layer, item, seen, &here).left[0]
    };
    let mean = items.iter().map(|i| measured(*i)).sum::<f64>() / items.len().max(1) as f64;
    let mut guesses: Vec<[f64; MOST]> = around()
        .map(|way| {
            let at = centre + way * mean;
            [at.x, at.y, at.z, 0.0, 0.0, 0.0]
        })
        .collect();
    let rows = items.len();
    if rows >= 5 {
        let matrix = DMatrix::from_fn(rows, 5, |row, k| {
            let p = Vector3::from(seen[items[row]].0) - centre;
            match k {
                0..3 => 2.0 * p[k],
                3 => -2.0 * measured(items[row]),
                _ => -1.0,
            }
        });
        let right = DVector::from_fn(rows, |row, _| {
            let p = Vector3::from(seen[items[row]].0) - centre;
            p.norm_squared() - measured(items[row]).powi(2)
        });
        if let Some(Ok(x)) = decompose::svd(matrix).map(|svd| svd.solve(&right, 1e-9)) {
            let at = centre + Vector3::new(x[0], x[1], x[2]);
            guesses.push([at.x, at.y, at.z, x[3], 0.0, 0.0]);
            guesses.push([at.x, at.y, at.z, 0.0, 0.0, 0.0]);
        }
    }
    guesses
}

/// The measured direction of an item, of unit length, in the station's axes.
fn sight(layer: &Layer, item: usize) -> Vector3<f64> {
    let sample = layer.items[item].sample;
    let observed = &layer.session.samples.observed;
    let angle = |c: &Option<Vec<f64>>| c.as_ref().map_or(0.0, |c| c[sample]);
    let station = observed.station.as_ref().and_then(|c| c[sample]);
    let stations = &layer.session.instrument.references.stations;
    let sign = station.map_or(1.0, |i| stations[i as usize].azimuth.sign());
    let (azimuth, elevation) = (sign * angle(&observed.azimuth), angle(&observed.elevation));
    let flat = elevation.cos();
    Vector3::new(flat * azimuth.cos(), flat * azimuth.sin(), elevation.sin())
}

/// The direction that is seen, measuring frame: of the target from `from`, or where the tool points.
fn line(layer: &Layer, item: usize, seen: &[Prediction], from: Vector3<f64>) -> Vector3<f64> {
    let (point, attitude) = seen[item];
    let pointing = layer.session.instrument.references.pointing.as_ref();
    let looks = KINDS[layer.items[item].kind].about().looks;
    if let (Observable::AtAttitude, Some(pointing)) = (looks, pointing) {
        return Matrix3::from_fn(|r, c| attitude[r][c]) * pointing.axis.into_inner();
    }
    let arm = Vector3::from(point) - from;
    arm / arm.norm().max(rounding::COMPUTED)
}

/// The rotation that brings one set of directions closest to another.
fn turned_onto(pairs: &[(Vector3<f64>, Vector3<f64>)]) -> Option<Rotation3<f64>> {
    let moment: Matrix3<f64> = pairs.iter().map(|(from, to)| to * from.transpose()).sum();
    let svd = decompose::svd(moment)?;
    let (mut u, v_t) = (svd.u?, svd.v_t?);
    if (u * v_t).determinant() < 0.0 {
        let values = svd.singular_values;
        let smallest = (0..3).min_by(|a, b| values[*a].total_cmp(&values[*b]))?;
        u.column_mut(smallest).neg_mut();
    }
    Some(Rotation3::from_matrix_unchecked(u * v_t))
}

fn station_guesses(
    layer: &Layer,
    items: &[usize],
    seen: &[Prediction],
    values: &[Option<f64>; MOST],
) -> Vec<[f64; MOST]> {
    let centre = centre_of(items, seen);
    let from = |at: Vector3<f64>| {
        let pairs: Vec<_> = items
            .iter()
            .map(|i| (sight(layer, *i), line(layer, *i, seen, at)))
            .collect();
        let turn = turned_onto(&pairs).map_or(Vector3::zeros(), |r| log_of_matrix(&r));
        [turn.x, turn.y, turn.z, at.x, at.y, at.z]
    };
    let here = |k: usize| values[k].unwrap_or(0.0);
    let position = Vector3::new(here(3), here(4), here(5));
    if values[3].is_some() || attitude_only(layer, items) {
        return vec![from(position)];
    }
    // As far away as the spread of the targets and that of the directions make it.
    let sights: Vec<Vector3<f64>> = items.iter().map(|i| sight(layer, *i)).collect();
    let mean: Vector3<f64> = sights.iter().sum::<Vector3<f64>>() / sights.len().max(1) as f64;
    let of_sights: f64 = sights.iter().map(|s| (s - mean).norm_squared()).sum();
    let of_points: f64 = items
        .iter()
        .map(|i| (Vector3::from(seen[*i].0) - centre).norm_squared())
        .sum();
    let far = (of_points / of_sights.max(f64::MIN_POSITIVE)).sqrt();
    let mut guesses = Vec::new();
    for way in around() {
        for factor in [0.6, 1.2] {
            guesses.push(from(centre + way * far * factor));
        }
    }
    guesses
}

/// The plane closest to the points.
fn plane_guess(items: &[usize], seen: &[Prediction]) -> [f64; MOST] {
    let centre = centre_of(items, seen);
    let scatter: Matrix3<f64> = items
        .iter()
        .map(|i| {
            let arm = Vector3::from(seen[*i].0) - centre;
            arm * arm.transpose()
        })
        .sum();
    let eigen = decompose::eigen(scatter);
    let values = eigen.eigenvalues;
    let least = (0..3).fold(0, |a, b| if values[b] < values[a] { b } else { a });
    let mut normal: Vector3<f64> = eigen.eigenvectors.column(least).into();
    let largest = normal.iamax();
    if normal[largest] < 0.0 {
        normal = -normal;
    }
    let distance = normal.dot(&centre);
    [normal.x, normal.y, normal.z, distance, 0.0, 0.0]
}

/// The motion from the robot's base to the measuring frame that points, places that the session
/// states, and orientations show; `None` where they do not.
pub fn frame(
    layer: &Layer,
    nominal: &Model,
    inside: impl Fn(usize) -> bool,
) -> Option<Isometry3<f64>> {
    let session = layer.session;
    let seen = layer.seen(nominal);
    let mut points = Vec::new();
    let mut turns = Vec::new();
    for (index, item) in layer.items.iter().enumerate() {
        if !layer.used[index] || !inside(item.sample) {
            continue;
        }
        match KINDS[item.kind].about().name {
            "point" if item.rows == 3 => {
                let samples = &session.samples;
                let z = samples.z_mm.as_ref().map_or(0.0, |z| z[item.sample]);
                let at = Vector3::new(samples.x_mm[item.sample], samples.y_mm[item.sample], z);
                points.push((Vector3::from(seen[index].0), at));
            }
            "orientation" => {
                if let Some(measured) = measured(session, item.sample) {
                    let predicted = Matrix3::from_fn(|r, c| seen[index].1[r][c]);
                    for axis in 0..3 {
                        let to = measured.to_rotation_matrix().matrix().column(axis).into();
                        turns.push((predicted.column(axis).into(), to));
                    }
                }
            }
            _ => {}
        }
    }
    known_places(layer, &seen, &inside, &mut points, &mut turns);
    if spread_in_two(&points) {
        return crate::kinematics::rigid_motion::rigid_motion(&points);
    }
    if turns.len() < fewest::OF_A_BODY {
        return None;
    }
    let rotation = turned_onto(&turns)?;
    let shift = if points.is_empty() {
        Vector3::zeros()
    } else {
        let all: Vector3<f64> = points.iter().map(|(from, to)| to - rotation * from).sum();
        all / points.len() as f64
    };
    let turn = UnitQuaternion::from_rotation_matrix(&rotation);
    Some(Isometry3::from_parts(Translation3::from(shift), turn))
}

/// Whether pairs of points are at least three that lie on no line.
fn spread_in_two(pairs: &[(Vector3<f64>, Vector3<f64>)]) -> bool {
    if pairs.len() < fewest::OF_A_BODY {
        return false;
    }
    let centre = pairs.iter().map(|p| p.0).sum::<Vector3<f64>>() / pairs.len() as f64;
    let scatter: Matrix3<f64> = pairs
        .iter()
        .map(|p| (p.0 - centre) * (p.0 - centre).transpose())
        .sum();
    let mut values: Vec<f64> = decompose::eigen(scatter)
        .eigenvalues
        .iter()
        .copied()
        .collect();
    values.sort_by(f64::total_cmp);
    values[1] > 1e-4 * values[2]
}

/// Places that the session states, as pairs with where the nominal robot has them.
fn known_places(
    layer: &Layer,
    seen: &[Prediction],
    inside: &impl Fn(usize) -> bool,
    points: &mut Vec<(Vector3<f64>, Vector3<f64>)>,
    turns: &mut Vec<(Vector3<f64>, Vector3<f64>)>,
) {
    let references = &layer.session.instrument.references;
    for (place, mut items) in places_in_use(layer) {
        items.retain(|i| inside(layer.items[*i].sample));
        let known = stated(references, place);
        let few = items.len() < fewest::OF_A_PART;
        if few && place.kind != PlaceKind::Socket || items.is_empty() {
            continue;
        }
        let at = |first: usize| {
            let v = [known[first]?, known[first + 1]?, known[first + 2]?];
            Some(Vector3::from(v))
        };
        let nothing = match place.kind {
            // An offset that is known stays so.
            PlaceKind::Anchor => [None, None, None, known[3], None, None],
            _ => [None; MOST],
        };
        let pair = |first: usize, to: Option<Vector3<f64>>| {
            let own = located(layer, place, &items, seen, &nothing);
            to.map(|to| (Vector3::new(own[first], own[first + 1], own[first + 2]), to))
        };
        match place.kind {
            PlaceKind::Anchor | PlaceKind::Socket => {
                points.extend(at(0).and_then(|_| pair(0, at(0))));
            }
            PlaceKind::Station => {
                if let Some(omega) = at(0) {
                    let own = located(layer, place, &items, seen, &nothing);
                    let here = Rotation3::new(Vector3::new(own[0], own[1], own[2]));
                    let there = Rotation3::new(omega);
                    for axis in 0..3 {
                        let from = here.matrix().column(axis).into();
                        turns.push((from, there.matrix().column(axis).into()));
                    }
                }
                if !attitude_only(layer, &items) {
                    points.extend(at(3).and_then(|_| pair(3, at(3))));
                }
            }
            PlaceKind::Plane => {}
        }
    }
    pointing_without_station(layer, seen, inside, turns);
}

/// Directions of the tool in the measuring frame's own axes.
fn pointing_without_station(
    layer: &Layer,
    seen: &[Prediction],
    inside: &impl Fn(usize) -> bool,
    turns: &mut Vec<(Vector3<f64>, Vector3<f64>)>,
) {
    for (index, item) in layer.items.iter().enumerate() {
        let points = KINDS[item.kind].about().name == "pointing";
        let free = KINDS[item.kind].place(layer.session, item.sample).is_none();
        if points && free && layer.used[index] && inside(item.sample) {
            let predicted = line(layer, index, seen, Vector3::zeros());
            turns.push((predicted, sight(layer, index)));
        }
    }
}

/// The turn of the tool against the session, as a rotation vector in the tool's axes: the mean over the orientations
/// given a model whose frame is right.
pub fn tool_turn(layer: &Layer, model: &Model) -> [f64; 3] {
    let session: &Session = layer.session;
    let seen = layer.seen(model);
    let mut pairs = Vec::new();
    for (index, item) in layer.items.iter().enumerate() {
        let is_one = KINDS[item.kind].about().name == "orientation";
        if let (true, true, Some(measured)) =
            (is_one, layer.used[index], measured(session, item.sample))
        {
            let predicted = Matrix3::from_fn(|r, c| seen[index].1[r][c]);
            let own = predicted.transpose() * measured.to_rotation_matrix().matrix();
            for axis in 0..3 {
                pairs.push((
                    Matrix3::identity().column(axis).into(),
                    own.column(axis).into(),
                ));
            }
        }
    }
    let turn = (!pairs.is_empty()).then(|| turned_onto(&pairs)).flatten();
    turn.map_or([0.0; 3], |turn| log_of_matrix(&turn).into())
}
