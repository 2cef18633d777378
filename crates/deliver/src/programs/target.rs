//! What a reader finds in a file.

use crate::text::Text;
use std::sync::Arc;

use crate::kinematics::configuration::Statement;

use super::answer::{Reason, SkippedTarget};
use super::number::{Number, Span};
use super::pose::Frame;
use super::referred::{Placed, UsedPairs};

/// Something broken in a file: at which byte, what is there and what should be.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Problem {
    pub(super) at: usize,
    pub(super) found: Text,
    pub(super) expected: Text,
}

impl Problem {
    pub(super) fn new(at: usize, found: impl Into<Text>, expected: impl Into<Text>) -> Self {
        Self {
            at,
            found: found.into(),
            expected: expected.into(),
        }
    }
}

/// Something in a file that a person has to know.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remark {
    /// The byte that it is about.
    pub at: usize,
    /// What there is to say.
    pub text: Text,
}

/// The numbers of a target.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// One number for each joint of the robot.
    Joints {
        /// In the order of the robot's joints.
        numbers: Vec<Number>,
        /// rad or mm in one of the file's units, joint by joint: the same of all targets of a table.
        scales: Arc<[f64]>,
        /// Digits behind the point that a number needs at least.
        decimals: usize,
    },
    /// A pose of the tool. Tables are of joint values, whose targets are smaller by it.
    Pose(Box<Frame>),
}

impl Shape {
    /// The values as they stand in the file.
    pub fn values(&self) -> Vec<f64> {
        match self {
            Self::Joints { numbers, .. } => numbers.iter().map(|n| n.value).collect(),
            Self::Pose(frame) => {
                let all = frame.position.iter().chain(&frame.turn);
                all.map(|n| n.value).collect()
            }
        }
    }
}

/// Numbers of a configuration, which are written anew where a joint crosses a border.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Mark {
    /// That of one of the statements: a quadrant, or whole turns.
    Of(usize, Span),
    /// One bit for each axis that is below zero, from the lowest.
    Signs {
        span: Span,
        value: u32,
        /// Digits between the quotes of a binary number; 0 for a decimal one.
        binary_digits: usize,
    },
}

/// What is known of the circumstances of a target.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Circumstances {
    /// Load at the tool's origin, kg.
    pub load_kg: Option<f64>,
    /// Temperature, °C.
    pub temperature_c: Option<f64>,
    /// Side from which each joint comes, +1, −1 or 0 (unknown); `None`: it follows from the target
    /// before.
    pub dir: Vec<Option<f64>>,
    /// Signed speed of each joint, rad/s or mm/s.
    pub speed: Vec<Option<f64>>,
}

/// What a file says about how the arm stands at a target.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Posture {
    /// Its configuration.
    pub configuration: Vec<Statement>,
    /// Joint values that its configuration is the nearest to, rad or mm.
    pub near: Option<Vec<f64>>,
    /// Values of the joints that the pose does not move (external axes), rad or mm, by joint.
    pub external: Vec<(usize, f64)>,
    pub(super) marks: Vec<Mark>,
}

impl Posture {
    /// A statement about a joint, which the file makes by a number of its own.
    pub(super) fn marked(&mut self, statement: Statement, span: Span) {
        self.marks.push(Mark::Of(self.configuration.len(), span));
        self.configuration.push(statement);
    }
}

/// Where external axes are that the model does not have, in the file's unit.
pub(super) type Outside = [Option<f64>; 6];

/// One target of a file. A long program has hundreds of thousands, so that what few have stands apart.
#[derive(Debug, Clone, PartialEq)]
pub struct Target {
    /// Its name, or what it is a part of.
    pub name: String,
    /// Its first byte.
    pub at: usize,
    /// Its numbers.
    pub shape: Shape,
    posture: Option<Box<Posture>>,
    circumstances: Option<Box<Circumstances>>,
    /// Why it cannot be corrected, whatever its numbers.
    pub left: Option<Box<SkippedTarget>>,
    /// In which frames and with which tools motions go to it.
    pub(super) ways: UsedPairs,
    /// How its pose is to be read.
    pub(super) placed: Placed,
    /// Where external axes are that the model does not have, counted from 1 in the program's list; 0: not said.
    pub(super) outside: u32,
    /// Whether it is no target after all.
    pub(super) is_none: bool,
}

impl Target {
    pub(super) fn new(name: impl Into<String>, at: usize, shape: Shape) -> Self {
        Self {
            name: name.into(),
            at,
            shape,
            posture: None,
            circumstances: None,
            left: None,
            ways: UsedPairs::default(),
            placed: Placed::default(),
            outside: 0,
            is_none: false,
        }
    }

    /// Whether it is a pose rather than joint values.
    pub fn is_pose(&self) -> bool {
        matches!(self.shape, Shape::Pose(_))
    }

    /// Leaves it as it is, unless there was a reason before.
    pub(super) fn leave(&mut self, reason: Reason, says: Text) {
        self.left
            .get_or_insert_with(|| Box::new(SkippedTarget::new(reason, says)));
    }

    /// What is known of its circumstances.
    pub fn circumstances(&self) -> &Circumstances {
        const NOTHING: &Circumstances = &Circumstances {
            load_kg: None,
            temperature_c: None,
            dir: Vec::new(),
            speed: Vec::new(),
        };
        self.circumstances.as_deref().unwrap_or(NOTHING)
    }

    pub(super) fn set_circumstances(&mut self, known: Circumstances) {
        self.circumstances = (known != Circumstances::default()).then(|| Box::new(known));
    }

    /// What the file says about how the arm stands there.
    pub fn posture(&self) -> &Posture {
        const NOTHING: &Posture = &Posture {
            configuration: Vec::new(),
            near: None,
            external: Vec::new(),
            marks: Vec::new(),
        };
        self.posture.as_deref().unwrap_or(NOTHING)
    }

    /// The same, to say something.
    pub(super) fn posture_mut(&mut self) -> &mut Posture {
        self.posture.get_or_insert_default()
    }

    /// Motions come as it is nearest: what is stated neither holds nor is written anew.
    pub(super) fn forget_configuration(&mut self) {
        if let Some(posture) = &mut self.posture {
            posture.configuration.clear();
            posture.marks.clear();
        }
    }

    /// Gives back the room that lists have to grow, and that of nothing.
    pub(super) fn shrink(&mut self) {
        self.posture = self
            .posture
            .take()
            .filter(|said| **said != Posture::default());
        if let Some(said) = &mut self.posture {
            said.configuration.shrink_to_fit();
            said.marks.shrink_to_fit();
            said.external.shrink_to_fit();
        }
    }
}
