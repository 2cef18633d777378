//! Options that several formats have.

use crate::importers::formats::OwnOption;

/// Option: the socket of all samples.
pub(crate) const SOCKET: &str = "socket";

/// Option: the plane of all samples.
pub(crate) const PLANE: &str = "plane";

/// Option: known distances between sockets.
pub(super) const SOCKET_DISTANCES: &str = "socket-distances";

pub(crate) const SOCKET_OPTION: OwnOption = OwnOption {
    name: SOCKET,
    title: phrase!("Socket"),
    value: "NAME",
    help: phrase!(
        "the socket that the target sat in for all rows, where no column names it: joint values are enough then"
    ),
    values: &[],
};

pub(crate) const PLANE_OPTION: OwnOption = OwnOption {
    name: PLANE,
    title: phrase!("Plane"),
    value: "NAME",
    help: phrase!(
        "the plane that was touched in all rows, where no column names it: joint values are enough then"
    ),
    values: &[],
};

pub(crate) const SOCKET_DISTANCES_OPTION: OwnOption = OwnOption {
    name: SOCKET_DISTANCES,
    title: phrase!("Distances between sockets"),
    value: "A-B=MM,…",
    help: phrase!(
        "known distances between sockets, mm, such as S1-S2=400: one of them sets the size of the robot"
    ),
    values: &[],
};

/// Option: the order of the angles and what their axes do.
#[doc(hidden)]
pub const EULER: &str = "euler";

/// The order of the angles of an orientation, in tables that a person explains.
pub(crate) const EULER_OPTION: OwnOption = OwnOption {
    name: EULER,
    title: phrase!("Angles of the orientation"),
    value: "ORDER",
    help: phrase!(
        "how rx, ry, rz (or euler1, euler2, euler3) make an orientation: an order of axes and whether they move, \
           such as zyx-moving, xyz-fixed (= zyx-moving) or zyz-moving; rpy (= xyz-fixed); rotvec"
    ),
    values: &[],
};
