//! Base offset: the axis stands elsewhere in the measuring frame, `p += (dx, dy, dz)`.

use super::about::{About, Form, Over, Quantity, Setting, Stage};
use super::block::Block;
use super::{Effect, Placed, Survey};

/// See the module.
pub(super) struct BaseOffset;

const ABOUT: About = About {
    id: "base-offset",
    title: "Base offset",
    stage: Stage::World,
    per_joint: false,
    form: Form::Plain(&[
        Quantity {
            name: "x_mm",
            inner: 1.0,
        },
        Quantity {
            name: "y_mm",
            inner: 1.0,
        },
        Quantity {
            name: "z_mm",
            inner: 1.0,
        },
    ]),
    setting: Setting::None,
    equation: "p = p + (x, y, z)",
    source: "ISO 9283, 5.6: the base frame as measured",
    cause: "the measuring frame was surveyed to a point beside the axis",
    over: Over::Angle,
    never_negative: false,
    implausible_above: Some(50.0),
    usual_size: "0.1 to 5 mm",
    confused_with: "encoder eccentricity where only the angle is seen: the radius, or a second radius, parts them",
    check: "survey the base again",
};

impl Effect for BaseOffset {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn obstacle(&self, survey: &Survey, _: usize) -> Option<String> {
        let at_rest = survey.joints.iter().all(|j| j.values < 2);
        at_rest.then(|| "the robot never moved: the offset cannot be told from the tool".to_owned())
    }

    fn act(&self, me: &Placed, block: &mut Block) {
        let by = [me.coefficients[0], me.coefficients[1], me.coefficients[2]];
        block.displace(me, |_| (by, AXES));
    }
}

/// The derivatives of a point with respect to its own coordinates.
pub(super) const AXES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
