//! A least-squares problem: the samples of a session, which of them count, and how much each
//! axis weighs.

use std::sync::Arc;

pub(crate) use crate::answers::errors::UnusableReason;
use crate::effects::block::Block;
use crate::effects::{Inputs, JointValues};
use crate::lanes::{LANES, Lanes};
use crate::model::Model;
use crate::observations::Layer;
use crate::sessions::measuring_order::falls_of_the_clock;
use crate::sessions::resolution::{is_rounded_to, resolution_mm};
use crate::sessions::{Session, Sigma};

use super::levers::Levers;
use super::noise::Noise;
use super::priors::Priors;
use super::spread::spread;

/// The rows of a least-squares problem: which samples count, and with what weight.
#[derive(Debug, Clone)]
pub struct Problem<'a> {
    /// The session.
    pub session: &'a Session,
    /// Its samples as the effects take them.
    pub inputs: Inputs<'a>,
    /// Which samples can be used at all.
    pub usable: Vec<bool>,
    /// Which samples are there to be fitted: usable, and not held out.
    pub fit: Vec<bool>,
    /// Which samples count: those to be fitted, without suspected outliers.
    pub used: Vec<bool>,
    /// 1/σ² of each axis, or 1; 0 for an axis that was not measured.
    pub axis_weights: [f64; 3],
    /// Extra columns that are fitted with the model: what no name explains. One value for each sample along x, y, z,
    /// mm per unit.
    pub extra_columns: Vec<[Vec<f64>; 3]>,
    /// Whether the session has times, and not the same for every sample.
    has_clock: bool,
    /// Whether the rows of the file are not in the order of that clock.
    out_of_time_order: bool,
    /// The noise of each axis by the rounding of the coordinates, mm: d/√12.
    pub(super) digits_mm: [f64; 3],
    /// The noise, where it is known; its white part is in `axis_weights` as well.
    pub noise: Option<Noise>,
    /// The derivatives of samples with respect to the joints, where the noise includes their repeatability.
    pub(super) levers: Option<Arc<Levers>>,
    /// The priors of the coefficients; none for a robot with a single joint.
    pub priors: Priors,
    /// Whether anybody still wants the answer.
    pub watch: Watch<'a>,
    /// What was measured, where it is more than plain points: then its rows are fitted, in units of its `unit_mm`, and
    /// the axes of the samples are not used.
    pub observed: Option<Layer<'a>>,
}

/// Asked before every pass over the samples whether to go on.
#[derive(Clone, Copy, Default)]
pub struct Watch<'a>(Option<&'a dyn Fn() -> bool>);

impl<'a> Watch<'a> {
    /// Goes on while `go_on` returns true.
    pub fn by(go_on: &'a dyn Fn() -> bool) -> Self {
        Self(Some(go_on))
    }

    /// Whether to go on.
    pub fn goes_on(self) -> bool {
        self.0.is_none_or(|go_on| go_on())
    }
}

impl std::fmt::Debug for Watch<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(if self.0.is_some() {
            "Watch"
        } else {
            "Unwatched"
        })
    }
}

/// A coordinate that rounding has made the same in all samples of a target has no information below its digit, and its
/// noise cannot be estimated: it has no weight.
fn without_constant(session: &Session, digits_mm: &[f64; 3], weights: [f64; 3]) -> [f64; 3] {
    let samples = &session.samples;
    let stated = match session.instrument.sigma_mm {
        Some(Sigma::Overall(sigma)) => [sigma; 3],
        Some(Sigma::PerAxis(sigma)) => sigma,
        None => return weights,
    };
    let columns = [
        Some(&samples.x_mm),
        Some(&samples.y_mm),
        samples.z_mm.as_ref(),
    ];
    let constant = |column: &Vec<f64>| {
        let mut of_target: Vec<Option<f64>> = vec![None; session.targets.len()];
        column.iter().enumerate().all(|(row, value)| {
            let target = samples.target.as_ref().map_or(0, |t| t[row] as usize);
            match of_target.get_mut(target) {
                Some(own) => (*own.get_or_insert(*value)).to_bits() == value.to_bits(),
                None => false,
            }
        })
    };
    let coarse = |axis: usize| digits_mm[axis] > COARSE * stated[axis];
    let without = |axis: usize| coarse(axis) && columns[axis].is_some_and(constant);
    std::array::from_fn(|axis| if without(axis) { 0.0 } else { weights[axis] })
}

/// A digit adds to the noise that is stated from this share of it on.
pub const COARSE: f64 = 1.0 / 3.0;

/// Standard deviation of what rounding to the digit of each coordinate adds, mm. A coordinate of few
/// different values has the digit of the others where it agrees with that.
pub(crate) fn digits_mm(session: &Session) -> [f64; 3] {
    let samples = &session.samples;
    let z = samples.z_mm.as_deref().unwrap_or(&[]);
    let columns = [&samples.x_mm[..], &samples.y_mm[..], z];
    let own = columns.map(resolution_mm);
    let of_others = own.iter().flatten().copied().fold(0.0, f64::max);
    std::array::from_fn(|axis| {
        let same = || is_rounded_to(columns[axis], of_others).then_some(of_others);
        own[axis].or_else(same).unwrap_or(0.0) / 12.0_f64.sqrt()
    })
}

impl<'a> Problem<'a> {
    /// All usable samples of a session that are not held out.
    pub fn new(session: &'a Session, values: JointValues) -> Self {
        let inputs = Inputs::new(session, values);
        let held_out = session.samples.held_out.as_deref();
        let mut usable: Vec<bool> = (0..session.samples.len())
            .map(|i| unusable(session, i).is_none())
            .collect();
        let kept = |i: usize| !held_out.is_some_and(|held_out| held_out[i]);
        let fit: Vec<bool> = (0..usable.len()).map(|i| usable[i] && kept(i)).collect();
        if let (Some(_), Some(setups)) = (held_out, &session.samples.setups) {
            // Of a setup that is held out as a whole nothing determines where the instrument was.
            let seen = setups.seen_in((0..fit.len()).filter(|i| fit[*i]));
            for (sample, usable) in usable.iter_mut().enumerate() {
                *usable &= setups.is_seen(&seen, sample);
            }
        }
        let clock = inputs.time_s.as_deref();
        let out_of_time_order = clock.is_some_and(|t| falls_of_the_clock(t).is_some());
        let has_clock = clock.is_some_and(|t| t.iter().any(|v| *v != t[0]));
        let spatial = f64::from(u8::from(session.samples.z_mm.is_some()));
        let axis_weights = match session.instrument.sigma_mm {
            Some(Sigma::PerAxis(sigma)) => {
                let weight = |s: f64| 1.0 / (s * s);
                [
                    weight(sigma[0]),
                    weight(sigma[1]),
                    weight(sigma[2]) * spatial,
                ]
            }
            _ => [1.0, 1.0, spatial],
        };
        let digits_mm = digits_mm(session);
        let axis_weights = without_constant(session, &digits_mm, axis_weights);
        Self {
            used: fit.clone(),
            fit,
            usable,
            session,
            inputs,
            axis_weights,
            extra_columns: Vec::new(),
            has_clock,
            out_of_time_order,
            digits_mm,
            noise: None,
            levers: None,
            priors: Priors::default(),
            watch: Watch::default(),
            observed: None,
        }
    }

    /// The same with every kind of measurement that the session has. Of plain points it is
    /// [`new`](Self::new).
    pub fn observing(session: &'a Session, values: JointValues) -> Self {
        let mut problem = Self::new(session, values);
        if session.has_plain_points() {
            return problem;
        }
        let layer = Layer::at(session, &Inputs::new(session, values));
        problem.usable = layer.samples_with(&vec![true; layer.items.len()]);
        problem.fit = layer.samples_with(&layer.fit);
        problem.used = problem.fit.clone();
        problem.axis_weights = [1.0; 3];
        problem.observed = Some(layer);
        problem
    }

    /// The units that count: every sample of plain points, else every observation.
    pub fn counted(&self) -> &[bool] {
        self.observed.as_ref().map_or(&self.used, |l| &l.used)
    }

    /// Which of them are there to be fitted.
    pub fn to_fit(&self) -> &[bool] {
        self.observed.as_ref().map_or(&self.fit, |l| &l.fit)
    }

    /// The sample of one of them.
    pub fn sample_of(&self, index: usize) -> usize {
        let layer = self.observed.as_ref();
        layer.map_or(index, |l| l.items[index].sample)
    }

    /// The same where at most so many count of those that do, spread evenly.
    pub(crate) fn thinned(&self, most: usize) -> Self {
        let mut few = self.clone();
        few.thin(most);
        few
    }

    /// Lets at most so many count of those that do, spread evenly.
    pub(crate) fn thin(&mut self, most: usize) {
        let counted = self.counted();
        if counted.iter().filter(|c| **c).count() > most {
            let mut kept = vec![false; counted.len()];
            for k in spread(counted, most) {
                kept[k] = true;
            }
            self.set_counted(kept);
        }
    }

    /// Those that count at ascending places among all that do.
    pub(super) fn counted_at(&self, places: impl Iterator<Item = usize>) -> Vec<usize> {
        let counted = self.counted();
        let mut those = (0..counted.len()).filter(|i| counted[*i]);
        let mut next = 0;
        let at = |place: usize| {
            let found = those.nth(place - next);
            next = place + 1;
            found
        };
        places.map_while(at).collect()
    }

    /// A problem of plain points with some of its samples only, which are the rows of this session.
    /// Their noise is not known: without a clock it would go by other places.
    pub(crate) fn of_rows<'b>(&self, session: &'b Session, rows: &[usize]) -> Problem<'b>
    where
        'a: 'b,
    {
        let marks = |all: &[bool]| rows.iter().map(|row| all[*row]).collect();
        let selected = |column: &[Vec<f64>; 3]| {
            column
                .each_ref()
                .map(|axis| rows.iter().map(|row| axis[*row]).collect())
        };
        Problem {
            session,
            inputs: self.inputs.select(rows),
            usable: marks(&self.usable),
            fit: marks(&self.fit),
            used: marks(&self.used),
            axis_weights: self.axis_weights,
            extra_columns: self.extra_columns.iter().map(selected).collect(),
            has_clock: self.has_clock,
            out_of_time_order: self.out_of_time_order,
            digits_mm: self.digits_mm,
            noise: None,
            levers: None,
            priors: self.priors.clone(),
            watch: self.watch,
            observed: None,
        }
    }

    /// Lets those count that are marked.
    pub fn set_counted(&mut self, counted: Vec<bool>) {
        let Some(layer) = &mut self.observed else {
            self.used = counted;
            return;
        };
        self.used = layer.samples_with(&counted);
        layer.used = counted;
        for (k, suspected) in layer.suspected.iter_mut().enumerate() {
            if layer.fit[k] {
                *suspected = !layer.used[k];
            }
        }
    }

    /// Leaves samples out of every fit.
    pub fn leave_out(&mut self, samples: &[bool]) {
        for (i, _) in samples.iter().enumerate().filter(|own| *own.1) {
            self.fit[i] = false;
            self.used[i] = false;
        }
        if let Some(layer) = &mut self.observed {
            for (k, item) in layer.items.iter().enumerate() {
                layer.fit[k] &= !samples[item.sample];
                layer.used[k] &= layer.fit[k];
            }
        }
    }

    /// Uses samples in the fit again, except outliers in the largest deviation.
    pub fn take_in(&mut self, samples: &[bool], apart: impl Fn(&Self) -> Vec<bool>) {
        for (fit, taken) in self.fit.iter_mut().zip(samples) {
            *fit |= taken;
        }
        if let Some(layer) = &mut self.observed {
            for (k, item) in layer.items.iter().enumerate() {
                layer.fit[k] |= samples[item.sample];
            }
        }
        let apart = apart(self);
        let counted = self.counted().iter().enumerate();
        let counted = counted.map(|(k, c)| *c || samples[self.sample_of(k)] && !apart[k]);
        let counted = counted.collect();
        self.set_counted(counted);
    }

    /// Number of rows that a fit follows.
    pub fn rows(&self) -> usize {
        match &self.observed {
            Some(layer) => layer.used_rows(),
            None => self.samples() * self.axes(),
        }
    }

    /// Number of samples that count.
    pub fn samples(&self) -> usize {
        self.used.iter().filter(|u| **u).count()
    }

    /// When samples were measured, s; where the session has no clock, their places in the file.
    pub fn times(&self, samples: &[usize]) -> Vec<f64> {
        samples.iter().map(|i| self.time(*i)).collect()
    }

    /// Puts samples into the order in which they were measured.
    pub(super) fn in_measuring_order(&self, samples: &mut [usize]) {
        if self.out_of_time_order {
            samples.sort_by(|a, b| self.time(*a).total_cmp(&self.time(*b)).then(a.cmp(b)));
        }
    }

    /// Whether the order of the samples can be taken for time: poses of several joints without a clock
    /// are listed in any order, and what the model lacks along a path is no frame that wanders.
    pub fn shows_time(&self) -> bool {
        self.has_clock || self.session.robot.joints.len() < 2
    }

    /// When a sample was measured, as [`times`](Self::times) has it.
    #[inline]
    pub fn time(&self, sample: usize) -> f64 {
        match self.inputs.time_s.as_deref() {
            Some(times) if self.has_clock => times[sample],
            _ => sample as f64,
        }
    }

    /// Takes the noise as known; the derivatives of the rows with respect to the joints are those of a model.
    pub fn set_noise(&mut self, noise: &Noise, model: &Model) {
        if noise.joints_rad > 0.0 && self.levers.is_none() {
            self.levers = Some(Arc::new(Levers::new(&self.inputs, model)));
        }
        for (axis, weight) in self.axis_weights.iter_mut().enumerate() {
            if *weight > 0.0 {
                *weight = noise.sigma_mm[axis].powi(-2);
            }
        }
        // Rows are in units of the noise from here on.
        self.priors.variance = 1.0;
        self.noise = Some(noise.clone());
    }

    /// Number of measured coordinates of a sample.
    pub fn axes(&self) -> usize {
        self.axis_weights.iter().filter(|w| **w > 0.0).count()
    }

    /// 1 for the lanes of a block that count, 0 for the others.
    #[inline]
    pub fn mask(&self, start: usize, len: usize) -> Lanes {
        let mut mask = [0.0; LANES];
        for (lane, used) in mask.iter_mut().zip(&self.used[start..start + len]) {
            *lane = f64::from(u8::from(*used));
        }
        mask
    }

    /// Measured − predicted along one axis; zero where the mask is.
    #[inline]
    pub fn residual(&self, axis: usize, start: usize, block: &Block, mask: &Lanes) -> Lanes {
        let samples = &self.session.samples;
        let measured = match axis {
            0 => Some(&samples.x_mm),
            1 => Some(&samples.y_mm),
            _ => samples.z_mm.as_ref(),
        };
        let mut residual = [0.0; LANES];
        if let Some(measured) = measured {
            let measured = &measured[start..start + block.len];
            for i in 0..block.len {
                if mask[i] != 0.0 {
                    residual[i] = measured[i] - block.point[axis][i];
                }
            }
        }
        residual
    }
}

/// Whether a sample cannot be used, and why; as a point, of whose coordinates none may be missing.
pub(crate) fn unusable(session: &Session, sample: usize) -> Option<UnusableReason> {
    let samples = &session.samples;
    if samples.is_excluded(sample) {
        return Some(UnusableReason::Excluded);
    }
    let x = samples.x_mm[sample];
    let y = samples.y_mm[sample];
    let z = samples.z_mm.as_ref().map(|z| z[sample]);
    let missing = x.is_nan()
        || y.is_nan()
        || z.is_some_and(f64::is_nan)
        || samples.q.iter().any(|q| q[sample].is_nan());
    if missing {
        return Some(UnusableReason::MissingCell);
    }
    (x == 0.0 && y == 0.0 && z.is_none_or(|z| z == 0.0)).then_some(UnusableReason::LostReflector)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{Term, joint_zero};
    use crate::fit::example::sweep;
    use crate::fit::solver::solve;

    #[test]
    fn a_reflector_is_lost_where_all_coordinates_are_zero_and_nowhere_else() {
        let mut session = sweep([0.0, 0.0, 1.0]);
        let points = [
            ([0.0, 0.0, 0.0], Some(UnusableReason::LostReflector)),
            ([1.0, 0.0, 0.0], None),
            ([0.0, 1.0, 0.0], None),
            ([0.0, 0.0, 1.0], None),
            ([f64::NAN, 1.0, 1.0], Some(UnusableReason::MissingCell)),
            ([1.0, f64::NAN, 1.0], Some(UnusableReason::MissingCell)),
            ([1.0, 1.0, f64::NAN], Some(UnusableReason::MissingCell)),
        ];
        for (sample, ([x, y, z], expected)) in points.into_iter().enumerate() {
            session.samples.x_mm[sample] = x;
            session.samples.y_mm[sample] = y;
            session.samples.z_mm.as_mut().unwrap()[sample] = z;
            assert_eq!(unusable(&session, sample), expected, "{sample}");
        }
        // In the plane the third coordinate is not used.
        session.samples.z_mm = None;
        assert_eq!(unusable(&session, 3), Some(UnusableReason::LostReflector));
        session.samples.q[0][1] = f64::NAN;
        assert_eq!(unusable(&session, 1), Some(UnusableReason::MissingCell));
    }

    #[test]
    fn a_column_beside_the_model_takes_all_of_the_residual_that_it_can() {
        const SIZE: f64 = 0.5;
        let mut session = sweep([0.36, -0.48, 0.8]);
        let n = session.samples.len();
        let wave = |axis: usize| {
            (0..n)
                .map(|i| (0.9 * i as f64 + axis as f64).sin())
                .collect()
        };
        let wave: [Vec<f64>; 3] = std::array::from_fn(wave);
        let samples = &mut session.samples;
        let z = samples.z_mm.as_mut().unwrap();
        for (measured, wave) in [&mut samples.x_mm, &mut samples.y_mm, z]
            .into_iter()
            .zip(&wave)
        {
            for (measured, wave) in measured.iter_mut().zip(wave) {
                *measured += SIZE * wave;
            }
        }
        let mut problem = Problem::new(&session, JointValues::Commanded);
        problem.extra_columns = vec![wave.clone()];
        let zero = Term::absent(joint_zero(), 0, 0.0);
        let start = Model::new(session.robot.clone(), vec![zero]);
        let found = solve(&problem, &start);
        let predicted = found.model.predict(&problem.inputs);
        let (mut along, mut square) = (0.0, 0.0);
        for i in 0..n {
            let z = session.samples.z_mm.as_ref().unwrap()[i];
            let measured = [session.samples.x_mm[i], session.samples.y_mm[i], z];
            for axis in 0..3 {
                let residual = measured[axis]
                    - predicted.get(i)[axis]
                    - found.extra_coefficients[0] * wave[axis][i];
                along += residual * wave[axis][i];
                square += wave[axis][i].powi(2);
            }
        }
        assert!(along.abs() < 1e-6 * square, "{along}");
        // Noise of 0.03 mm.
        let off = (found.extra_coefficients[0] - SIZE).abs();
        assert!(off < 4.0 * 0.03 / square.sqrt(), "{off}");
    }
}
