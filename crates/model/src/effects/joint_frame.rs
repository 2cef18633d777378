//! Directions and points of one joint that effects refer to.

use crate::kinematics::{Axis, Robot};
use crate::rounding;

/// Directions and points of one joint that effects refer to, base frame, at home.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointFrame {
    /// A point on the axis, mm.
    pub origin_mm: [f64; 3],
    /// Along the axis, a unit vector.
    pub along: [f64; 3],
    /// Across the axis: the base frame's x, made perpendicular (y where x is along the axis).
    pub across_1: [f64; 3],
    /// Across the axis, a quarter turn further.
    pub across_2: [f64; 3],
    /// From the axis to the tool's origin; zero where the tool lies on the axis.
    pub radial: [f64; 3],
    /// A quarter turn from `radial`, in the joint's positive sense.
    pub tangential: [f64; 3],
    /// The tool's distance from the axis, mm.
    pub radius_mm: f64,
    /// The point on the axis at the height of the tool's origin, mm.
    pub foot_mm: [f64; 3],
}

impl JointFrame {
    /// The frame of a joint; of one that the robot has not, about the base's z.
    pub fn new(robot: &Robot, joint: usize) -> Self {
        use nalgebra::Vector3;
        let base_z = Axis {
            direction: Vector3::z_axis(),
            point_mm: nalgebra::Point3::origin(),
        };
        let axis = robot.joints.get(joint).map_or(base_z, |joint| joint.axis);
        let along = axis.direction.into_inner();
        let across = |v: Vector3<f64>| v - along * along.dot(&v);
        let x = across(Vector3::x());
        let across_1 = if x.norm_squared() > rounding::WRITTEN {
            x
        } else {
            across(Vector3::y())
        }
        .normalize();
        let tool = robot.base_from_tool.translation.vector;
        let arm = tool - axis.point_mm.coords;
        let radial = across(arm);
        let radius_mm = radial.norm();
        let on_axis = radius_mm <= rounding::COMPUTED * (1.0 + arm.norm());
        let radial = if on_axis {
            Vector3::zeros()
        } else {
            radial / radius_mm
        };
        Self {
            origin_mm: axis.point_mm.coords.into(),
            along: along.into(),
            across_1: across_1.into(),
            across_2: along.cross(&across_1).into(),
            radial: radial.into(),
            tangential: along.cross(&radial).into(),
            radius_mm: if on_axis { 0.0 } else { radius_mm },
            foot_mm: (axis.point_mm.coords + along * along.dot(&arm)).into(),
        }
    }

    /// The plane that the tool turns in: away from the axis at home, and a quarter turn further. Of a
    /// tool on the axis any direction across it will do.
    #[doc(hidden)]
    pub fn plane_of_motion(&self) -> [[f64; 3]; 2] {
        if self.radius_mm > 0.0 {
            [self.radial, self.tangential]
        } else {
            [self.across_1, self.across_2]
        }
    }
}
