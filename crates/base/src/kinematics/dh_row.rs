//! Denavit–Hartenberg rows and the frames of their links.

use nalgebra::{UnitQuaternion, Vector3};

use super::joint_kind::JointKind;
use super::pose::Pose;

/// Which of the two customs a row follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DhConvention {
    /// Paul: the joint first, then the link.
    Standard,
    /// Craig: the link first, then the joint.
    Modified,
}

/// One row of a Denavit–Hartenberg table, one joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DhRow {
    /// Length of the common normal, mm.
    pub a_mm: f64,
    /// Twist of the axes about it, rad.
    pub alpha_rad: f64,
    /// Offset along the joint's axis, at home, mm.
    pub d_mm: f64,
    /// Angle about the joint's axis, at home, rad.
    pub theta_rad: f64,
    /// Which custom the row follows.
    pub convention: DhConvention,
    /// Whether the joint turns or slides.
    pub kind: JointKind,
}

impl DhRow {
    /// The part across the joint, `Tx(a) Rx(α)`.
    pub(super) fn link(&self) -> Pose {
        about(Vector3::x_axis(), self.alpha_rad) * Pose::translation(self.a_mm, 0.0, 0.0)
    }

    /// The part along the joint at home, `Rz(θ) Tz(d)`.
    pub(super) fn joint(&self) -> Pose {
        about(Vector3::z_axis(), self.theta_rad) * Pose::translation(0.0, 0.0, self.d_mm)
    }
}

/// At home in the base frame: for each row the frame before its joint and the one behind it, both
/// with z along the joint; and the frame behind the last row.
pub(super) fn frames(rows: &[DhRow]) -> (Vec<[Pose; 2]>, Pose) {
    let mut base_from_frame = Pose::identity();
    let mut frames = Vec::with_capacity(rows.len());
    for row in rows {
        let (link, joint) = (row.link(), row.joint());
        match row.convention {
            DhConvention::Standard => {
                frames.push([base_from_frame, base_from_frame * joint]);
                base_from_frame *= joint * link;
            }
            DhConvention::Modified => {
                let before = base_from_frame * link;
                frames.push([before, before * joint]);
                base_from_frame = before * joint;
            }
        }
    }
    (frames, base_from_frame)
}

/// The frame behind each joint of a table at home, in the base frame, z along the joint.
pub(super) fn link_frames(rows: &[DhRow]) -> Vec<Pose> {
    frames(rows)
        .0
        .into_iter()
        .map(|[_, behind]| behind)
        .collect()
}

fn about(axis: nalgebra::Unit<Vector3<f64>>, angle_rad: f64) -> Pose {
    let rotation = UnitQuaternion::from_axis_angle(&axis, angle_rad);
    Pose::from_parts(Vector3::zeros().into(), rotation)
}
