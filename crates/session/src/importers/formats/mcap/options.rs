//! Options that only this format has, and a question that they leave open.

pub(super) const TOPIC_JOINTS: &str = "topic-joints";

pub(super) const TOPIC_MEASURED: &str = "topic-measured";

pub(super) const FRAME_CHILD: &str = "frame-child";

pub(super) const JOINT_NAMES: &str = "joint-names";

/// Something is asked or wrong, and stands in the inspection.
pub(super) struct NeedsAnswer;
