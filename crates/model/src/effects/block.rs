//! A block of samples on its way from joint commands to measured points.
//!
//! The point of every sample flows from the tool to the measuring frame, and with it its derivatives with respect to
//! every coefficient of the model (the *columns*): forward-mode differentiation, by blocks. An effect changes the
//! points and adds the columns of its own coefficients; later effects transform them. So an effect does not depend on
//! the others, and the Jacobian is exact at any model, not only at zero.
//!
//! All points are in the base frame, at home behind the joints that have not acted yet, mm.

use crate::kinematics::Robot;
use crate::lanes::{LANES, Lanes, Lanes3};
use crate::wide::{Loop, wide};

use super::inputs::Inputs;
use super::placed::Placed;

mod carrying;
pub(super) mod moving;

use carrying::Carrying;

/// What one sample brings with it, as the joint of the effect sees it.
#[derive(Debug, Clone, Copy)]
pub struct Lane {
    /// Commanded value of the effect's joint, rad or mm.
    pub q: f64,
    /// Side from which the joint came: +1, −1, or 0 where it is unknown.
    pub dir: f64,
    /// Signed joint speed, rad/s or mm/s.
    pub speed: f64,
    /// Travel of the joint since it last reversed, rad or mm; infinite where it is unknown.
    pub travel: f64,
    /// Load at the tool's origin, kg.
    pub load_kg: f64,
    /// Temperature over 20 °C, of the joint where it was measured, else of the machine.
    pub above_20_c: f64,
    /// Time of the sample, s.
    pub time_s: f64,
    /// Index of the measuring frame, a whole number.
    pub setup: f64,
    /// Index of the target, a whole number.
    pub target: f64,
    /// Place of the sample in its block.
    pub lane: usize,
}

/// A joint's value after an effect, and its derivatives.
#[derive(Debug, Clone, Copy)]
pub struct Turned<const N: usize> {
    /// The value after the effect, rad or mm.
    pub value: f64,
    /// Derivative with respect to the value before it.
    pub by_input: f64,
    /// Derivatives with respect to the effect's coefficients.
    pub by_coefficient: [f64; N],
}

/// [`Turned`] for every sample of a block.
pub(super) struct TurnedLanes<const N: usize> {
    pub(super) value: Lanes,
    pub(super) by_input: Lanes,
    pub(super) by_coefficient: [Lanes; N],
}

impl<const N: usize> TurnedLanes<N> {
    /// Nothing yet.
    pub(super) fn zero() -> Self {
        Self {
            value: [0.0; LANES],
            by_input: [0.0; LANES],
            by_coefficient: [[0.0; LANES]; N],
        }
    }
}

/// The loop of [`Block::turn`].
struct EachTurned<'b, 'a, const N: usize, F> {
    block: &'b Block<'a>,
    joint: usize,
    f: F,
    lanes: &'b mut TurnedLanes<N>,
}

impl<const N: usize, F: Fn(f64, Lane) -> Turned<N>> Loop for EachTurned<'_, '_, N, F> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) {
        let Self {
            block,
            joint,
            f,
            lanes,
        } = self;
        for i in 0..LANES {
            let turned = f(block.theta[joint][i], block.lane(joint, i));
            lanes.value[i] = turned.value;
            lanes.by_input[i] = turned.by_input;
            for (by, value) in lanes.by_coefficient.iter_mut().zip(turned.by_coefficient) {
                by[i] = value;
            }
        }
    }
}

/// The variables of the derivatives of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Columns {
    /// Nothing.
    None,
    /// One column for each coefficient of the model.
    Coefficients,
    /// One column for each joint's command, per rad or mm.
    Commands,
}

/// A derivative of a joint's value with respect to one coefficient or one command.
#[derive(Clone)]
struct JointTangent {
    column: usize,
    joint: usize,
    lanes: Lanes,
}

/// Up to 64 samples on their way from joint commands to measured points, with derivatives where they are asked for.
#[derive(Clone)]
pub struct Block<'a> {
    /// The robot as its controller believes it to be.
    pub(super) robot: &'a Robot,
    /// Conditions, per joint where they belong to one.
    q: Vec<Lanes>,
    dir: Vec<Lanes>,
    speed: Vec<Lanes>,
    travel: Vec<Lanes>,
    load_kg: Lanes,
    above_20_c: Vec<Lanes>,
    /// Measured torques; NaN where there is none.
    torque_nm: Vec<Lanes>,
    time_s: Lanes,
    setup: Lanes,
    target: Lanes,
    /// Joint values after the joint effects so far.
    theta: Vec<Lanes>,
    tangents: Vec<JointTangent>,
    /// The reflector.
    pub point: Lanes3,
    /// Derivatives of `point`, one for each coefficient of the model, or for each joint's command
    /// where those were asked for.
    pub columns: Vec<Lanes3>,
    /// Which columns are not zero so far.
    live: Vec<bool>,
    /// Which columns stay zero: no fit moves their coefficients.
    held: Vec<bool>,
    by: Columns,
    /// From which column on the derivatives by the joints' values are, where they stay apart.
    by_joints_from: Option<usize>,
    /// Samples of this block; the lanes behind them repeat the last one.
    pub len: usize,
}

impl<'a> Block<'a> {
    /// Room for blocks of a model with so many coefficients. Without `differentiate` there are no
    /// columns.
    pub fn new(robot: &'a Robot, coefficients: usize, differentiate: bool) -> Self {
        if differentiate {
            Self::with_columns(robot, Columns::Coefficients, coefficients)
        } else {
            Self::with_columns(robot, Columns::None, 0)
        }
    }

    /// Room for blocks with the derivatives with respect to the joints' commands, whatever else depends on conditions:
    /// sides, speeds and travels stay what they are.
    pub fn by_commands(robot: &'a Robot) -> Self {
        Self::with_columns(robot, Columns::Commands, robot.joints.len())
    }

    /// Room for blocks in which what moves a joint alone stays apart: of all coefficients that do, one column is
    /// carried on, the derivative by the joint's value. What each of them does is that times a number of each
    /// sample ([`Block::turning`]), so that who takes its rows may do so once for each joint.
    pub(crate) fn apart(robot: &'a Robot, coefficients: usize) -> Self {
        let all = coefficients + robot.joints.len();
        Self {
            by_joints_from: Some(coefficients),
            ..Self::with_columns(robot, Columns::Coefficients, all)
        }
    }

    fn with_columns(robot: &'a Robot, by: Columns, columns: usize) -> Self {
        let per_joint = || vec![[0.0; LANES]; robot.joints.len()];
        Self {
            robot,
            q: per_joint(),
            dir: per_joint(),
            speed: per_joint(),
            travel: per_joint(),
            load_kg: [0.0; LANES],
            above_20_c: per_joint(),
            torque_nm: per_joint(),
            time_s: [0.0; LANES],
            setup: [0.0; LANES],
            target: [0.0; LANES],
            theta: per_joint(),
            tangents: Vec::new(),
            point: [[0.0; LANES]; 3],
            columns: vec![[[0.0; LANES]; 3]; columns],
            live: vec![false; columns],
            held: vec![false; columns],
            by,
            by_joints_from: None,
            len: 0,
        }
    }

    /// Fills the block with the samples from `start` on, the reflectors at home. Columns that are not
    /// there, or do not reach so far, are as if nothing had been recorded.
    pub fn load(&mut self, inputs: &Inputs, start: usize) {
        fn own<T: AsRef<[f64]>>(columns: &[Option<T>], joint: usize) -> Option<&[f64]> {
            columns.get(joint)?.as_ref().map(AsRef::as_ref)
        }

        self.len = inputs.len().saturating_sub(start).min(LANES);
        let len = self.len;
        let rows = start..start + len;
        let copy = |to: &mut Lanes, from: Option<&[f64]>, default: f64| match from
            .and_then(|from| from.get(rows.clone()))
        {
            Some(from) => {
                to[..len].copy_from_slice(from);
                to[len..].fill(from.last().copied().unwrap_or(default));
            }
            None => to.fill(default),
        };
        for joint in 0..self.q.len() {
            let q = inputs.q.get(joint).map(AsRef::as_ref);
            copy(&mut self.q[joint], q, 0.0);
            copy(&mut self.dir[joint], own(&inputs.dir, joint), 0.0);
            copy(&mut self.speed[joint], own(&inputs.speed, joint), 0.0);
            let travel = own(&inputs.travel, joint);
            copy(&mut self.travel[joint], travel, f64::INFINITY);
            let own = inputs.joint_above_20_c.get(joint).and_then(Option::as_ref);
            let warmth = own.or(inputs.above_20_c.as_ref());
            copy(&mut self.above_20_c[joint], warmth.map(Vec::as_slice), 0.0);
            let torque = inputs.torque_nm.get(joint).and_then(Option::as_deref);
            copy(&mut self.torque_nm[joint], torque, f64::NAN);
            self.theta[joint] = self.q[joint];
        }
        copy(&mut self.load_kg, inputs.load_kg.as_deref(), 0.0);
        copy(&mut self.time_s, inputs.time_s.as_deref(), 0.0);
        copy(&mut self.setup, inputs.setup.as_deref(), 0.0);
        let homes = &inputs.reflectors_at_home;
        if let Some(target) = &inputs.target {
            for lane in 0..LANES {
                let index = target.get(start + lane.min(len.saturating_sub(1)));
                let index = index.copied().unwrap_or(0);
                self.target[lane] = f64::from(index);
                let home = homes.get(index as usize).copied().unwrap_or([f64::NAN; 3]);
                for (axis, value) in home.into_iter().enumerate() {
                    self.point[axis][lane] = value;
                }
            }
        } else {
            let home = homes.first().copied().unwrap_or([f64::NAN; 3]);
            for (lanes, value) in self.point.iter_mut().zip(home) {
                lanes.fill(value);
            }
            self.target.fill(0.0);
        }
        self.tangents.clear();
        self.live.fill(false);
        if self.by == Columns::Commands {
            // Every joint starts from its own command.
            let own = (0..self.q.len()).map(|joint| JointTangent {
                column: joint,
                joint,
                lanes: [1.0; LANES],
            });
            self.tangents.extend(own);
        }
    }

    /// Whether the block has the derivatives with respect to the commands, so that an effect that depends on a command
    /// has to add its own ([`Block::turn_by_command`], [`Block::shift_by_command`]).
    pub fn by_command(&self) -> bool {
        self.by == Columns::Commands
    }

    /// The change of an effect of the joint stage that was just applied because it depends on the command of joint
    /// `of`: the derivative of its own joint's value with respect to that command, in addition to that of the value
    /// before.
    pub fn turn_by_command(&mut self, me: &Placed, of: usize, f: impl Fn(Lane) -> f64) {
        if self.by_command() {
            let lanes = std::array::from_fn(|i| f(self.lane(me.joint, i)));
            self.tangents.push(JointTangent {
                column: of,
                joint: me.joint,
                lanes,
            });
        }
    }

    /// The same for an effect that has worked the derivative out for each sample.
    pub fn turn_by_command_of(&mut self, me: &Placed, of: usize, slopes: &Lanes) {
        if self.by_command() {
            self.tangents.push(JointTangent {
                column: of,
                joint: me.joint,
                lanes: *slopes,
            });
        }
    }

    /// What an effect that has just moved the point changes because it looks at its joint's
    /// command: `f` gives the derivative of the point by it, from the point as it is now.
    pub fn shift_by_command(&mut self, me: &Placed, f: impl Fn([f64; 3], Lane) -> [f64; 3]) {
        self.shift_by_command_of(me, me.joint, f);
    }

    /// The same for an effect that looks at the command of joint `of`.
    pub fn shift_by_command_of(
        &mut self,
        me: &Placed,
        of: usize,
        f: impl Fn([f64; 3], Lane) -> [f64; 3],
    ) {
        if !self.by_command() {
            return;
        }
        let column = of;
        if !self.live[column] {
            self.columns[column] = [[0.0; LANES]; 3];
            self.live[column] = true;
        }
        for i in 0..LANES {
            let point = [self.point[0][i], self.point[1][i], self.point[2][i]];
            let slope = f(point, self.lane(me.joint, i));
            for axis in 0..3 {
                self.columns[column][axis][i] += slope[axis];
            }
        }
    }

    #[inline(always)]
    #[allow(
        clippy::inline_always,
        reason = "most effects look at one or two of its fields"
    )]
    fn lane(&self, joint: usize, i: usize) -> Lane {
        Lane {
            q: self.q[joint][i],
            dir: self.dir[joint][i],
            speed: self.speed[joint][i],
            travel: self.travel[joint][i],
            load_kg: self.load_kg[i],
            above_20_c: self.above_20_c[joint][i],
            time_s: self.time_s[i],
            setup: self.setup[i],
            target: self.target[i],
            lane: i,
        }
    }

    /// Commanded value of a joint, rad or mm.
    pub(super) fn command(&self, joint: usize, lane: usize) -> f64 {
        self.q[joint][lane]
    }

    /// The same in all lanes.
    pub(super) fn commands(&self, joint: usize) -> &Lanes {
        &self.q[joint]
    }

    /// Values of a joint in all lanes after the joint effects so far, rad or mm.
    pub(super) fn values(&self, joint: usize) -> &Lanes {
        &self.theta[joint]
    }

    /// Value of a joint after the joint effects so far, rad or mm.
    pub(super) fn value(&self, joint: usize, lane: usize) -> f64 {
        self.theta[joint][lane]
    }

    /// Measured torque about a joint, N·m; `None` where it was not measured.
    pub(super) fn torque_nm(&self, joint: usize, lane: usize) -> Option<f64> {
        Some(self.torque_nm[joint][lane]).filter(|torque| !torque.is_nan())
    }

    /// Side from which a joint came: 1, −1, or 0 where it is not known.
    pub(super) fn side(&self, joint: usize, lane: usize) -> f64 {
        self.dir[joint][lane]
    }

    /// Speed of a joint, rad/s or mm/s.
    pub(super) fn speed(&self, joint: usize, lane: usize) -> f64 {
        self.speed[joint][lane]
    }

    /// Temperature of a joint above 20 °C, K.
    pub(super) fn above_20_c(&self, joint: usize, lane: usize) -> f64 {
        self.above_20_c[joint][lane]
    }

    /// Load at the tool's origin, kg.
    pub(super) fn load_kg(&self, lane: usize) -> f64 {
        self.load_kg[lane]
    }

    /// Whether a sample of the block was measured in this setup.
    pub(super) fn is_of_setup(&self, setup: f64) -> bool {
        self.setup[..self.len].contains(&setup)
    }

    /// The same in all lanes.
    pub(super) fn loads_kg(&self) -> &Lanes {
        &self.load_kg
    }

    /// An effect of the joint stage: `f` gives the joint's value after the effect.
    #[inline]
    pub fn turn<const N: usize>(&mut self, me: &Placed, f: impl Fn(f64, Lane) -> Turned<N>) {
        let mut lanes = TurnedLanes::zero();
        wide(EachTurned {
            block: self,
            joint: me.joint,
            f,
            lanes: &mut lanes,
        });
        self.take_turn(me, &lanes);
    }

    /// The same where all lanes are known.
    pub(super) fn take_turn<const N: usize>(&mut self, me: &Placed, turned: &TurnedLanes<N>) {
        let joint = me.joint;
        self.theta[joint] = turned.value;
        if self.by == Columns::None {
            return;
        }
        // Most effects add to the value, whatever it is.
        if turned.by_input.iter().any(|factor| *factor != 1.0) {
            for tangent in self.tangents.iter_mut().filter(|t| t.joint == joint) {
                for (value, factor) in tangent.lanes.iter_mut().zip(&turned.by_input) {
                    *value *= factor;
                }
            }
        }
        if self.by == Columns::Commands {
            return;
        }
        for (k, lanes) in turned.by_coefficient.iter().enumerate() {
            self.tangents.push(JointTangent {
                column: me.first_column + k,
                joint,
                lanes: *lanes,
            });
        }
    }

    /// An effect that adds a displacement which does not depend on where the point is.
    /// `f` gives the displacement and its derivatives.
    #[inline]
    pub fn displace<const N: usize>(
        &mut self,
        me: &Placed,
        f: impl Fn(Lane) -> ([f64; 3], [[f64; 3]; N]),
    ) {
        let asked = self.asks_for::<N>(me);
        for i in 0..LANES {
            let (by, columns) = f(self.lane(me.joint, i));
            for axis in 0..3 {
                self.point[axis][i] += by[axis];
            }
            if asked {
                for (k, column) in columns.into_iter().enumerate() {
                    for axis in 0..3 {
                        self.columns[me.first_column + k][axis][i] = column[axis];
                    }
                }
            }
        }
        self.mark_live::<N>(me);
    }

    /// An effect that moves the point depending on where it is. `f` gives the new point, the
    /// derivative of the new point with respect to the old one (by rows), and the derivatives
    /// with respect to the effect's coefficients.
    #[inline]
    pub fn transform<const N: usize>(
        &mut self,
        me: &Placed,
        f: impl Fn([f64; 3], Lane) -> ([f64; 3], [[f64; 3]; 3], [[f64; 3]; N]),
    ) {
        let mut carried = [[[0.0; LANES]; 3]; 3];
        let asked = self.asks_for::<N>(me);
        for i in 0..LANES {
            let before = [self.point[0][i], self.point[1][i], self.point[2][i]];
            let (to, jacobian, columns) = f(before, self.lane(me.joint, i));
            for axis in 0..3 {
                self.point[axis][i] = to[axis];
            }
            if self.by == Columns::None {
                continue;
            }
            for (lanes, factor) in carried.iter_mut().flatten().zip(jacobian.as_flattened()) {
                lanes[i] = *factor;
            }
            if !asked {
                continue;
            }
            // None of its own columns is live yet.
            for (k, column) in columns.into_iter().enumerate() {
                for axis in 0..3 {
                    self.columns[me.first_column + k][axis][i] = column[axis];
                }
            }
        }
        wide(Carrying {
            columns: &mut self.columns,
            live: &self.live,
            by: &carried,
        });
        self.mark_live::<N>(me);
    }

    /// Whether any column of an effect with so many coefficients is asked for.
    pub(super) fn asks_for<const N: usize>(&self, me: &Placed) -> bool {
        let mut own = me.first_column..me.first_column + N;
        self.by == Columns::Coefficients && own.any(|column| !self.held[column])
    }

    fn mark_live<const N: usize>(&mut self, me: &Placed) {
        if self.by == Columns::Coefficients {
            for column in me.first_column..me.first_column + N {
                self.live[column] = !self.held[column];
            }
        }
    }

    /// Leaves the columns of coefficients that are held zero, from the next samples on: no fit moves them.
    pub(crate) fn hold(&mut self, columns: impl Iterator<Item = usize>) {
        for column in columns {
            if let Some(held) = self.held.get_mut(column) {
                *held = true;
            }
        }
    }

    /// Whether a column is anything but zero apart from what [stays apart](Self::apart).
    pub(crate) fn is_live(&self, column: usize) -> bool {
        self.live[column]
    }

    /// What a joint's value does, where that [stays apart](Self::apart); `None` of one that no coefficient turns.
    pub(crate) fn by_value(&self, joint: usize) -> Option<&Lanes3> {
        let column = self.by_joints_from? + joint;
        self.live[column].then(|| &self.columns[column])
    }

    /// The coefficients that turn a joint and how much, in the order of the joint stage: column, joint, and the
    /// derivative of the joint's value in every lane.
    pub(crate) fn turning(&self) -> impl Iterator<Item = (usize, usize, &Lanes)> {
        let free = self.tangents.iter().filter(|t| !self.held[t.column]);
        free.map(|tangent| (tangent.column, tangent.joint, &tangent.lanes))
    }

    /// Clears the columns that nothing has changed, so that they can be read as zero. Where columns stay apart,
    /// `is_live` tells which.
    pub fn settle(&mut self) {
        if self.by_joints_from.is_some() {
            return;
        }
        for (column, _) in self.columns.iter_mut().zip(&self.live).filter(|c| !*c.1) {
            *column = [[0.0; LANES]; 3];
        }
    }
}
