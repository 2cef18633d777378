//! The observations of a session compared with a model: rows of residuals and derivatives.
//!
//! An [`Item`] is one observation of one sample; a sample with a pose has two, its point and its
//! orientation. Items flow through the model in two streams of blocks ([`super::streams`]).
//!
//! Rows are in units of their noise times that of the layer (`unit_mm`), so that a number of mm of an estimator of
//! points is one here too.

use std::borrow::Cow;
use std::collections::BTreeSet;

use crate::effects::base_offset::AXES;
use crate::effects::block::Block;
use crate::effects::{FixedMask, Inputs, JointValues, Place, PlaceKind};
use crate::lanes::{LANES, Lanes3, dot, minus, scaled};
use crate::model::Model;
use crate::sessions::{Session, SocketDistance};

use super::block::RowBlock;
use super::follows::Follows;
use super::streams::{Item, POINTS, Stream, attitude, stream, turn};
use super::{KINDS, Kind, Observable, Residual, Seen, Unit};
use crate::effects::place::MOST;
use crate::effects::places::stated;

/// All observations of a session: residuals and derivatives for a model.
#[derive(Debug, Clone)]
pub struct Layer<'a> {
    /// The session.
    pub session: &'a Session,
    /// Every observation of a sample whose joint values are complete, sample by sample.
    pub items: Vec<Item>,
    /// Which of them are there to be fitted.
    pub fit: Vec<bool>,
    /// Which of them count: those to be fitted without suspected outliers.
    pub used: Vec<bool>,
    /// Which are suspected, held-out ones among them.
    pub suspected: Vec<bool>,
    /// Noise of each kind, inner units.
    pub sigma: Vec<f64>,
    /// What a row of a residual of one σ is, mm.
    pub unit_mm: f64,
    /// Held-out samples at places that are not known, or in setups, where nothing that is fitted was measured: no
    /// model determines where they should be, and they are no observations.
    pub unplaced: Vec<usize>,
    /// Known distances between sockets that are both stated or fitted.
    distances: Vec<SocketDistance>,
    points: Stream,
    attitudes: Stream,
}

/// σ of a known distance between two sockets, mm: what a calliper gives.
const SOCKET_DISTANCE_MM: f64 = 0.02;

/// The places and setups of which a fit learns where they are: those where something to be fitted was measured.
struct Places<'a> {
    session: &'a Session,
    measured: BTreeSet<Place>,
    setups: Vec<bool>,
}

impl<'a> Places<'a> {
    fn of<'b>(session: &'a Session, fitted: impl Iterator<Item = &'b Item> + Clone) -> Self {
        let place = |item: &Item| KINDS[item.kind].place(session, item.sample);
        let samples = fitted.clone().map(|item| item.sample);
        let setups = session.samples.setups.as_ref();
        Self {
            session,
            measured: fitted.filter_map(place).collect(),
            setups: setups.map_or(Vec::new(), |setups| setups.seen_in(samples)),
        }
    }

    /// Whether the frame of a sample is known, or found with the fit.
    fn frames(&self, sample: usize) -> bool {
        let setups = self.session.samples.setups.as_ref();
        setups.is_none_or(|setups| setups.is_seen(&self.setups, sample))
    }

    /// Whether a place is stated, or found with the fit.
    fn has(&self, place: Place) -> bool {
        let size = place.kind.effect().about().form.coefficients();
        let stated = || {
            stated(&self.session.instrument.references, place)[..size]
                .iter()
                .all(Option::is_some)
        };
        self.measured.contains(&place) || stated()
    }
}

/// Where a model has the coefficients of every place.
struct Placing {
    own: Vec<(Place, [f64; MOST], Option<usize>, FixedMask)>,
}

impl Placing {
    fn of(model: &Model, session: &Session, items: &[Item]) -> Self {
        let references = &session.instrument.references;
        let mut places: Vec<Place> = items
            .iter()
            .filter_map(|item| KINDS[item.kind].place(session, item.sample))
            .collect();
        let all = 0..references.sockets.len();
        let kind = PlaceKind::Socket;
        places.extend(all.map(|index| Place { kind, index }));
        places.sort_unstable();
        places.dedup();
        let own = places.into_iter().map(|place| {
            let mut first = 0;
            for term in model.terms() {
                let here = PlaceKind::of(term) == Some(place.kind);
                if here && term.setting == place.index as f64 {
                    let mut values = [0.0; MOST];
                    values[..term.coefficients.len()].copy_from_slice(&term.coefficients);
                    return (place, values, Some(first), term.held);
                }
                first += term.coefficients.len();
            }
            let known = stated(references, place).map(|v| v.unwrap_or(0.0));
            (place, known, None, FixedMask::default())
        });
        Self { own: own.collect() }
    }

    fn get(&self, place: Place) -> Option<(&[f64; MOST], Option<usize>, FixedMask)> {
        let at = self.own.binary_search_by(|own| own.0.cmp(&place)).ok()?;
        let (_, values, first, held) = &self.own[at];
        Some((values, *first, *held))
    }
}

impl<'a> Layer<'a> {
    /// The observations of a session. Joint values are those of `values`. A session that cannot be computed with (see
    /// [`Session::checked`]) has none.
    pub fn new(session: &'a Session, values: JointValues) -> Self {
        let inputs = Inputs::new(session, values);
        let whole = session.whole().is_ok();
        Self::of_samples(
            session,
            &inputs,
            if whole { session.samples.len() } else { 0 },
        )
    }

    /// The observations of a session whose joints were where `inputs` has them, sample by sample.
    #[doc(hidden)]
    pub fn at(session: &'a Session, inputs: &Inputs) -> Self {
        Self::of_samples(session, inputs, session.samples.len())
    }

    /// The observations of its first samples.
    fn of_samples(session: &'a Session, inputs: &Inputs, count: usize) -> Self {
        let held_out = session.samples.held_out.as_deref();
        let complete = |i: usize| {
            let known = |q: &Vec<f64>| q.get(i).is_some_and(|q| !q.is_nan());
            !session.samples.is_excluded(i) && session.samples.q.iter().all(known)
        };
        let mut items = Vec::new();
        for sample in (0..count).filter(|i| complete(*i)) {
            for (kind, own) in KINDS.iter().enumerate() {
                if own.measured(session, sample) {
                    let rows = rows_of(*own, session, sample);
                    items.push(Item { kind, sample, rows });
                }
            }
        }
        let is_held_out = |h: &[bool], sample: usize| h.get(sample).copied().unwrap_or(false);
        let kept = |item: &Item| !held_out.is_some_and(|h| is_held_out(h, item.sample));
        let places = Places::of(session, items.iter().filter(|item| kept(item)));
        let mut unplaced = Vec::new();
        items.retain(|item| {
            let place = KINDS[item.kind].place(session, item.sample);
            let known = place.is_none_or(|place| places.has(place)) && places.frames(item.sample);
            if !known {
                unplaced.push(item.sample);
            }
            known
        });
        let fit: Vec<bool> = items.iter().map(kept).collect();
        let socket = |index: usize| Place {
            kind: PlaceKind::Socket,
            index,
        };
        let all = session.instrument.references.socket_distances.iter();
        let sockets = session.instrument.references.sockets.len();
        let known = |own: &usize| *own < sockets && places.has(socket(*own));
        let both = all.filter(|d| d.between.iter().all(known));
        let distances = both.copied().collect();
        let instrument = &session.instrument;
        let sigma: Vec<f64> = KINDS
            .iter()
            .map(|kind| kind.sigma(instrument).unwrap_or(kind.about().usual_sigma))
            .collect();
        let points = stream(session, inputs, &items, Observable::AtPoint);
        let attitudes = stream(session, inputs, &items, Observable::AtAttitude);
        Self {
            session,
            unit_mm: sigma[0],
            suspected: vec![false; fit.len()],
            used: fit.clone(),
            fit,
            sigma,
            unplaced,
            distances,
            points,
            attitudes,
            items,
        }
    }

    /// Whether a distance between two sockets is known that the fit can follow.
    pub(super) fn has_distances(&self) -> bool {
        !self.distances.is_empty()
    }

    /// Whether there is anything to fit.
    pub fn is_empty(&self) -> bool {
        !self.fit.contains(&true)
    }

    /// Whether any orientation of the tool was measured, or where it points.
    pub fn shows_attitude(&self) -> bool {
        !self.attitudes.items.is_empty()
    }

    /// Whether the session states the noise of everything that was measured.
    pub fn is_stated(&self) -> bool {
        let instrument = &self.session.instrument;
        let mut items = self.items.iter();
        items.all(|item| KINDS[item.kind].sigma(instrument).is_some())
    }

    /// One number for each item: the same for those of a kind that refer to the same place.
    pub fn references(&self) -> Vec<usize> {
        let of = |item: &Item| (item.kind, KINDS[item.kind].place(self.session, item.sample));
        let mut all: Vec<_> = self.items.iter().map(of).collect();
        all.sort_unstable();
        all.dedup();
        let items = self.items.iter();
        items
            .map(|item| all.partition_point(|one| *one < of(item)))
            .collect()
    }

    /// Number of rows of the items that `counts` picks.
    pub fn rows(&self, counts: &[bool]) -> usize {
        let counting = self.items.iter().zip(counts).filter(|(_, counts)| **counts);
        counting.map(|(item, _)| item.rows).sum()
    }

    /// Number of rows that a fit follows: of the items that count, and of known distances.
    pub fn used_rows(&self) -> usize {
        self.rows(&self.used) + self.distances.len()
    }

    /// The items of each sample that are marked.
    pub fn samples_with(&self, marked: &[bool]) -> Vec<bool> {
        let mut samples = vec![false; self.session.samples.len()];
        for (item, marked) in self.items.iter().zip(marked) {
            samples[item.sample] |= marked;
        }
        samples
    }

    /// Sends every item through a model. `differentiate` asks for the columns.
    pub fn visit(&self, model: &Model, differentiate: bool, mut see: impl FnMut(&mut RowBlock)) {
        let placing = Placing::of(model, self.session, &self.items);
        let mut rows = RowBlock::new(if differentiate {
            model.coefficient_count()
        } else {
            0
        });
        let mut held = vec![false; rows.columns.len()];
        for column in model.held_columns() {
            if let Some(held) = held.get_mut(column) {
                *held = true;
            }
        }
        rows.live.retain(|column| !held[*column]);
        let mut follows = Follows::new(model.robot.joints.len(), self.unit_mm);
        send(model, &self.points.inputs, differentiate, |start, block| {
            rows.clear();
            follows.clear();
            for lane in 0..block.len {
                let item = self.points.items[start + lane];
                let point = [0, 1, 2].map(|axis| block.point[axis][lane]);
                self.put(&mut rows, &mut follows, item, &placing, (point, AXES));
            }
            follows.put_all(&mut rows, block, 1, Cow::Borrowed);
            see(&mut rows);
        });
        send(
            model,
            &self.attitudes.inputs,
            differentiate,
            |start, block| {
                rows.clear();
                follows.clear();
                let count = block.len / POINTS;
                let mut edges = [[[0.0; 3]; 3]; LANES / POINTS];
                for own in 0..count {
                    let item = self.attitudes.items[start / POINTS + own];
                    let (attitude, of_own) = attitude(block, own * POINTS);
                    edges[own] = of_own;
                    self.put(
                        &mut rows,
                        &mut follows,
                        item,
                        &placing,
                        ([0.0; 3], attitude),
                    );
                }
                let turns = |column: &Lanes3| {
                    let mut turns = [[0.0; LANES]; 3];
                    for (own, edges) in edges[..count].iter().enumerate() {
                        let turn = turn(column, own * POINTS, edges);
                        for (lanes, turn) in turns.iter_mut().zip(turn) {
                            lanes[own] = turn;
                        }
                    }
                    Cow::Owned(turns)
                };
                follows.put_all(&mut rows, block, POINTS, turns);
                see(&mut rows);
            },
        );
        self.known_distances(&placing, &mut rows);
        if !rows.items.is_empty() {
            see(&mut rows);
        }
    }

    /// The targets of all items that look at one, where a model has them, and how each coefficient
    /// moves them, mm.
    pub fn visit_points(&self, model: &Model, mut see: impl FnMut(usize, [f64; 3], &[[f64; 3]])) {
        let mut columns = vec![[0.0; 3]; model.coefficient_count()];
        model.visit(&self.points.inputs, true, |start, block| {
            for lane in 0..block.len {
                for (to, column) in columns.iter_mut().zip(&block.columns) {
                    *to = [column[0][lane], column[1][lane], column[2][lane]];
                }
                let point = [0, 1, 2].map(|axis| block.point[axis][lane]);
                see(self.points.items[start + lane], point, &columns);
            }
        });
    }

    /// Of every sample the item of figures in mm, in the order of samples; none of a sample without.
    ///
    /// Lengths and angles are never in one figure. Where targets were measured, the orientation of the tool is no
    /// length. Of targets measured by lengths in some samples and by directions alone in others, that of which there
    /// are more is the figure: a direction is as long as the distance across which it is seen, a single length among
    /// directions has little information on them. Every kind has its own figures besides these.
    pub(crate) fn length_items(&self) -> Vec<usize> {
        let about = |i: usize| KINDS[self.items[i].kind].about();
        let count = |of: &dyn Fn(usize) -> bool| {
            let mut samples: Vec<usize> = (0..self.items.len())
                .filter(|i| of(*i))
                .map(|i| self.items[i].sample)
                .collect();
            samples.dedup();
            samples.len()
        };
        let at_point = |i: usize| about(i).looks == Observable::AtPoint;
        let is_length = |i: usize| at_point(i) && about(i).unit == Unit::Millimetre;
        let is_direction = |i: usize| at_point(i) && about(i).unit == Unit::Radian;
        let (lengths, directions) = (count(&is_length), count(&is_direction));
        let counts = |i: usize| match (lengths, directions) {
            (0, 0) => true,
            (lengths, directions) if lengths >= directions => is_length(i),
            _ => is_direction(i),
        };
        let mut items: Vec<usize> = (0..self.items.len()).filter(|i| counts(*i)).collect();
        items.dedup_by_key(|i| self.items[*i].sample);
        items
    }

    /// The predictions of a model for every item: where its target is, and the orientation of the tool.
    pub fn seen(&self, model: &Model) -> Vec<([f64; 3], [[f64; 3]; 3])> {
        let mut seen = vec![([0.0; 3], AXES); self.items.len()];
        model.visit(&self.points.inputs, false, |start, block| {
            for lane in 0..block.len {
                let item = self.points.items[start + lane];
                seen[item].0 = [0, 1, 2].map(|axis| block.point[axis][lane]);
            }
        });
        model.visit(&self.attitudes.inputs, false, |start, block| {
            for own in 0..block.len / POINTS {
                let item = self.attitudes.items[start / POINTS + own];
                seen[item].1 = attitude(block, own * POINTS).0;
            }
        });
        seen
    }

    /// The rows of one item, and how they follow its point, or how the tool is turned.
    fn put(
        &self,
        rows: &mut RowBlock,
        follows: &mut Follows,
        item: usize,
        placement: &Placing,
        (point, attitude): ([f64; 3], [[f64; 3]; 3]),
    ) {
        let Item { kind, sample, .. } = self.items[item];
        let own = KINDS[kind];
        let (raw, weighed, lever_mm) = self.residual_of(item, placement, point, attitude);
        let lane = rows.items.len();
        rows.items.push(Some(item));
        rows.length[lane] = raw.length();
        rows.length_mm[lane] = raw.length() * lever_mm;
        let whole = kind == 0 && raw.rows == self.session.samples.axes();
        for axis in 0..3 {
            let zero_beyond = if axis < raw.rows { raw.left[axis] } else { 0.0 };
            rows.along[axis][lane] = if whole { zero_beyond } else { f64::NAN };
        }
        let by_moves = match own.about().looks {
            Observable::AtPoint => &weighed.by_point,
            Observable::AtAttitude => &weighed.by_turn,
        };
        for row in 0..weighed.rows {
            rows.rows[row][lane] = true;
            rows.left[row][lane] = weighed.left[row] * self.unit_mm;
            for axis in 0..3 {
                follows.by[row][axis][lane] = by_moves[row][axis];
            }
        }
        let at = own.place(self.session, sample);
        if let Some((_, Some(first), held)) = at.and_then(|place| placement.get(place)) {
            follows.places.push((lane, first, held, weighed));
        }
    }

    /// How the rows of every observation follow its target, per mm along x, y, z.
    pub(super) fn by_point(&self, model: &Model) -> Vec<[[f64; 3]; 3]> {
        let placing = Placing::of(model, self.session, &self.items);
        let mut all = vec![[[0.0; 3]; 3]; self.items.len()];
        model.visit(&self.points.inputs, false, |start, block| {
            for lane in 0..block.len {
                let item = self.points.items[start + lane];
                let point = [0, 1, 2].map(|axis| block.point[axis][lane]);
                let (_, weighed, _) = self.residual_of(item, &placing, point, AXES);
                all[item] = weighed.by_point.map(|row| scaled(row, self.unit_mm));
            }
        });
        all
    }

    /// The residual of every item in units of its noise, with its derivatives.
    pub(super) fn weighed(&self, model: &Model) -> Vec<Residual> {
        let placing = Placing::of(model, self.session, &self.items);
        let seen = self.seen(model).into_iter().enumerate();
        let own = |(item, (point, attitude))| self.residual_of(item, &placing, point, attitude).1;
        seen.map(own).collect()
    }

    /// mm of an inner unit of every item.
    pub(super) fn levers_mm(&self, model: &Model) -> Vec<f64> {
        let placing = Placing::of(model, self.session, &self.items);
        let seen = self.seen(model).into_iter().enumerate();
        let lever = |(item, (point, attitude))| self.residual_of(item, &placing, point, attitude).2;
        seen.map(lever).collect()
    }

    /// The residual of one item, the same in units of its noise, and mm of an inner unit.
    fn residual_of(
        &self,
        item: usize,
        placement: &Placing,
        point: [f64; 3],
        attitude: [[f64; 3]; 3],
    ) -> (Residual, Residual, f64) {
        let Item { kind, sample, .. } = self.items[item];
        let own = KINDS[kind];
        let at = own.place(self.session, sample);
        let place = at.and_then(|place| placement.get(place));
        let seen = Seen {
            point,
            attitude,
            place: place.map_or(&[0.0; MOST], |own| own.0),
        };
        let raw = own.residual(self.session, sample, &seen);
        let weighed = own.weighed(self.session, sample, self.sigma[kind], &raw);
        (raw, weighed, own.lever_mm(&seen))
    }

    /// The priors of the distances between sockets, in separate rows.
    pub(super) fn distances(&self, model: &Model) -> RowBlock {
        let mut rows = RowBlock::new(model.coefficient_count());
        let placing = Placing::of(model, self.session, &self.items);
        self.known_distances(&placing, &mut rows);
        rows
    }

    /// The same with some of its items only, all of which count.
    pub(super) fn only(&self, kept: &[bool]) -> Self {
        let chosen: Vec<usize> = (0..self.items.len()).filter(|i| kept[*i]).collect();
        let mut place = vec![usize::MAX; self.items.len()];
        for (new, old) in chosen.iter().enumerate() {
            place[*old] = new;
        }
        Self {
            points: self.points.only(kept, &place, 1),
            attitudes: self.attitudes.only(kept, &place, POINTS),
            items: chosen.iter().map(|i| self.items[*i]).collect(),
            fit: vec![true; chosen.len()],
            used: vec![true; chosen.len()],
            suspected: vec![false; chosen.len()],
            sigma: self.sigma.clone(),
            session: self.session,
            unit_mm: self.unit_mm,
            unplaced: self.unplaced.clone(),
            distances: self.distances.clone(),
        }
    }

    /// The priors of the distances between sockets.
    fn known_distances(&self, placing: &Placing, rows: &mut RowBlock) {
        rows.clear();
        let weight = self.unit_mm / SOCKET_DISTANCE_MM;
        for known in self.distances.iter().take(LANES) {
            let socket = |index: usize| {
                let kind = PlaceKind::Socket;
                placing.get(Place { kind, index })
            };
            let (Some(a), Some(b)) = (socket(known.between[0]), socket(known.between[1])) else {
                continue;
            };
            let arm = minus([b.0[0], b.0[1], b.0[2]], [a.0[0], a.0[1], a.0[2]]);
            let length = dot(arm, arm).sqrt().max(f64::MIN_POSITIVE);
            let lane = rows.items.len();
            rows.items.push(None);
            rows.rows[0][lane] = true;
            rows.left[0][lane] = (known.distance_mm - length) * weight;
            for ((_, first, held), sign) in [(a, -1.0), (b, 1.0)] {
                let mut own = Residual::new(1);
                own.by_place[0][..3].copy_from_slice(&scaled(arm, sign / length));
                if let (Some(first), false) = (first, rows.columns.is_empty()) {
                    rows.add_place(lane, first, held, &own, weight);
                }
            }
        }
    }
}

/// Sends inputs through a model, with the columns of every coefficient where they are asked for.
fn send(model: &Model, inputs: &Inputs, differentiate: bool, see: impl FnMut(usize, &Block)) {
    if differentiate {
        model.visit_apart(inputs, see);
    } else {
        model.visit(inputs, false, see);
    }
}

/// A kind's number of rows in a sample.
fn rows_of(kind: &dyn Kind, session: &Session, sample: usize) -> usize {
    let seen = Seen {
        point: [1.0; 3],
        attitude: AXES,
        place: &[1.0; MOST],
    };
    kind.residual(session, sample, &seen).rows
}
