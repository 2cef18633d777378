//! What samples of a session share and what can be elsewhere as a whole: the target that was seen, the socket it
//! sat in, the setup of the instrument, the station, plane or anchor that a measurement refers to.

use crate::text::{Argument, Text};

named! {
    /// A kind of group.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Group {
        /// Samples of one target.
        Target = "target",
        /// Samples in one socket.
        Socket = "socket",
        /// Samples of one setup of the instrument.
        Setup = "setup",
        /// Directions from one station.
        Station = "station",
        /// Touches of one plane.
        Plane = "plane",
        /// Distances from one anchor.
        Anchor = "anchor",
    }
    /// The word in files and sentences.
    pub fn name;
    /// Every kind.
    pub const ALL;
}

impl Group {
    /// One of the group, by its name or number, in words.
    #[doc(hidden)]
    pub fn called(self, name: impl Into<Argument>) -> Text {
        let name = name.into();
        match self {
            Self::Target => text!("target {target}", target = name),
            Self::Socket => text!("socket {socket}", socket = name),
            Self::Setup => text!("setup {setup}", setup = name),
            Self::Station => text!("station {station}", station = name),
            Self::Plane => text!("plane {plane}", plane = name),
            Self::Anchor => text!("anchor {anchor}", anchor = name),
        }
    }
}
