//! What became of the targets of a file.

use crate::text::Text;

named! {
    /// Why a target was left as it is.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Reason {
        /// The tool can hardly be moved in some direction there.
        Singular = "singular",
        /// No joint values within the limits reach it.
        Unreachable = "unreachable",
        /// Several sets of joint values reach it, and nothing says which.
        Ambiguous = "ambiguous",
        /// It is a way from where the robot is, and no place.
        Relative = "relative",
        /// Its frame or its tool is not known.
        Frame = "frame",
        /// No motion of the file goes to it.
        Unused = "unused",
        /// The program changes it.
        Changed = "changed",
        /// An external axis stands elsewhere, and the model does not have it.
        External = "external",
        /// No pose that was measured shows enough of it.
        Unseen = "unseen",
    }
    /// Its name in answers.
    pub fn name;
}

/// A target that was left as it is.
#[derive(Debug, Clone, PartialEq)]
pub struct SkippedTarget {
    /// What kind of reason there is.
    pub reason: Reason,
    /// The reason in words.
    pub explanation: Text,
}

impl SkippedTarget {
    pub(super) fn new(reason: Reason, says: impl Into<Text>) -> Self {
        let says = says.into();
        Self {
            reason,
            explanation: says,
        }
    }
}

/// A target that was corrected.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    /// Joint values that the target means, rad or mm.
    pub commanded: Vec<f64>,
    /// Joint values that it means now, rad or mm.
    pub corrected: Vec<f64>,
    /// Side from which each joint comes: +1, −1, 0 unknown.
    pub dir: Vec<i8>,
    /// Load at the tool's origin, kg.
    pub load_kg: f64,
    /// How far the real tool is from the target without and with the correction, mm.
    pub position_mm: [f64; 2],
    /// The same of its orientation, rad.
    pub rotation_rad: [f64; 2],
}

/// What became of one target.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Its name.
    pub name: String,
    /// Line and column, from 1.
    pub place: (u64, u64),
    /// Whether it is a pose rather than joint values.
    pub is_pose: bool,
    /// What became of it.
    pub result: Result<Written, SkippedTarget>,
}

/// A corrected file, and what there is to say about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// The file.
    pub bytes: Vec<u8>,
    /// Every target, in the order of the file.
    pub targets: Vec<Outcome>,
    /// What is worked out at run time and was not corrected: line, column, words.
    pub at_run_time: Vec<(u64, u64, crate::text::Text)>,
    /// What else there is to know, with line and column.
    pub remarks: Vec<(u64, u64, crate::text::Text)>,
    /// What was assumed.
    pub notes: Vec<crate::text::Text>,
}

impl Answer {
    /// Targets that were left as they are.
    pub fn left(&self) -> usize {
        self.targets.iter().filter(|t| t.result.is_err()).count()
    }
}
