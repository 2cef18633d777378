//! What samples of a session share and what can be elsewhere as a whole: the target that was seen, the socket it
//! sat in, the setup of the instrument, the station, plane or anchor that a measurement refers to.

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
