//! A tool that is farther off than anyone mounts it: it, or the targets in it, are not where the session states.

use super::diagnosis::DataProblem;
use super::identification::Identification;
use crate::effects::{TOOL_POSITION, tool_radius};
use crate::kinematics::Robot;
use crate::text::length;

/// A tool is mounted no farther off than this share of the reach …
const MOST_SHARE: f64 = 0.15;
/// … or this, mm, whichever is more.
const MOST_MM: f64 = 120.0;
/// The nominal robot is off by this share of it, or nothing is wrong.
const SEEN_SHARE: f64 = 0.1;

/// How far off a tool may be mounted, mm.
pub(crate) fn farthest_tool_mm(robot: &Robot) -> f64 {
    MOST_MM.max(MOST_SHARE * robot.length_along_links_mm())
}

impl Identification {
    /// The message where the tool is far from where the session states. No sample distinguishes which of the tool and
    /// the targets is wrong: what is measured is both together.
    #[doc(hidden)]
    pub fn far_tool(&self) -> Option<DataProblem> {
        let moved = self.parameters.iter().filter(|own| {
            let of_all = own.effect == TOOL_POSITION.about().id && own.target.is_none();
            of_all || own.effect == tool_radius().about().id
        });
        let moved_mm = moved.map(|own| own.value * own.value).sum::<f64>().sqrt();
        let most = farthest_tool_mm(&self.model.robot);
        // Where the frame takes a part of it back, the tool's place is little known and no mistake.
        let is_seen = self.gap.before.rms_mm > SEEN_SHARE * moved_mm;
        (moved_mm > most && is_seen).then(|| DataProblem {
            what: text!(
                "the tool is {moved} from where the session states",
                moved = length(moved_mm, 1)
            ),
            evidence: text!(
                "no tool is mounted as far off; the samples tell where the targets are, and not whether the tool or the targets in it are stated wrongly"
            ),
            proposal: text!(
                "check tool.position_mm and targets: what is corrected is the origin of the tool as identified"
            ),
            mend: None,
            samples: Vec::new(),
        })
    }
}
