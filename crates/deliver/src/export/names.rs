//! Names of links and joints in files that need one for each.

use std::collections::BTreeSet;

use crate::kinematics::Robot;
use crate::text::Text;

/// Unique names for links and joints.
pub(super) struct Names {
    pub(super) robot: String,
    /// Base, one for each joint, tool.
    pub(super) links: Vec<String>,
    /// One for each joint, and that of the tool.
    pub(super) joints: Vec<String>,
    changed: bool,
}

impl Names {
    pub(super) fn new(robot: &Robot) -> Self {
        let mut taken = BTreeSet::new();
        let mut changed = false;
        let mut joints = Vec::new();
        for (k, joint) in robot.joints.iter().enumerate() {
            let mut name = plain(&joint.name);
            if name.is_empty() || taken.contains(&name) {
                name = format!("{name}joint_{}", k + 1);
            }
            while taken.contains(&name) {
                name.push('_');
            }
            changed |= name != joint.name;
            taken.insert(name.clone());
            joints.push(name);
        }
        let mut fixed = "tool_fixed".to_owned();
        while taken.contains(&fixed) {
            fixed.push('_');
        }
        joints.push(fixed);
        let links = (0..robot.joints.len()).map(|k| format!("link_{}", k + 1));
        let links = ["base_link".to_owned()].into_iter().chain(links);
        let name = plain(&robot.name);
        Self {
            robot: if name.is_empty() {
                "robot".to_owned()
            } else {
                name
            },
            links: links.chain(["tool0".to_owned()]).collect(),
            joints,
            changed,
        }
    }

    /// First and last link.
    pub(super) fn ends(&self) -> [String; 2] {
        [
            self.links[0].clone(),
            self.links[self.links.len() - 1].clone(),
        ]
    }

    /// What the user should know of them.
    pub(super) fn notes(&self) -> Vec<Text> {
        let says =
            text!("names that are empty or not unique were changed: the file needs one for each");
        self.changed.then_some(says).into_iter().collect()
    }
}

/// A name without what XML does not allow.
fn plain(name: &str) -> String {
    let allowed = |c: &char| !c.is_control() && !matches!(c, '\u{fffe}' | '\u{ffff}');
    name.chars().filter(allowed).collect()
}

/// Text inside an attribute.
pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
