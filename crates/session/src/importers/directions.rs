//! The side from which each joint came, where rows are in the order in which they were measured.
//!
//! A joint that moved up since the row before came from below (+1), one that moved down from above
//! (−1). A joint that did not move keeps the side of the row before: whatever play it has is still
//! taken up on that side. Before its first motion a joint's side is unknown (0).

use crate::importers::columns::{Column, Columns};
use crate::importers::job::{Job, Matched};
use crate::importers::matching::Matching;
use crate::importers::path::sides;
use crate::sessions::columns::{Quantity, Unit};

/// A joint that moves less than this has not moved, rad or mm: what rounding leaves.
const STANDING: f64 = 1e-9;

impl Job<'_> {
    /// Derives directions where that was asked for; says that it can be where nothing tells them.
    pub(crate) fn directions(&mut self, columns: &mut Columns, matched: Option<&Matched>) {
        let joints = self.settings.robot.joint_count();
        let lacking: Vec<usize> = (0..joints)
            .filter(|&joint| columns.find(Quantity::Direction(joint)).is_none())
            .collect();
        if lacking.is_empty() || columns.rows() < 2 {
            return;
        }
        let numbers: Vec<String> = lacking
            .iter()
            .map(|joint| (joint + 1).to_string())
            .collect();
        let joints = match &numbers[..] {
            [joint] => text!("joint {joint}", joint),
            all => text!("joints {joints}", joints = all.join(", ")),
        };
        if !self.settings.in_measuring_order {
            if matched.is_none_or(|matched| matched.by != Matching::Time) {
                self.note(text!(
                    "the side of approach is not stated ({joints}), so that backlash cannot be tested: where the rows are in \
                     the order in which they were measured, --in-measuring-order derives it from the row before",
                    joints
                ));
            }
            return;
        }
        for joint in lacking {
            if let Some(values) = columns.numbers(Quantity::Commanded(joint)) {
                let quantity = Quantity::Direction(joint);
                columns.put(Column::made(
                    quantity,
                    Unit::Fixed,
                    sides(&values, STANDING),
                ));
            }
        }
        self.say(text!(
            "the side of approach ({joints}) is that of the motion since the row before: the rows are in measuring order, as stated",
            joints
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_joint_that_stands_keeps_its_side() {
        let values = [0.0, 0.0, 0.5, 0.5, 1.0, 0.2, 0.2 + 1e-12, f64::NAN, 0.3];
        let expected = [0.0, 0.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, 1.0];
        assert_eq!(sides(&values, STANDING), expected);
        assert!(sides(&[], STANDING).is_empty());
    }
}
