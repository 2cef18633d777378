//! From where the workspace is looked at, and what its colours say.

use super::camera::Facing;

named! {
    /// The plane that the workspace is looked at in.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub(crate) enum Plane {
        /// From above.
        #[default]
        Xy = "x y",
        /// From the side.
        Xz = "x z",
        /// From the front.
        Yz = "y z",
    }
    pub(crate) fn name;
    pub(crate) const ALL;
}

impl Plane {
    /// The axes that it shows: to the right, and up.
    pub(crate) fn axes(self) -> [usize; 2] {
        match self {
            Self::Xy => [0, 1],
            Self::Xz => [0, 2],
            Self::Yz => [1, 2],
        }
    }

    /// Its axes in the measuring frame.
    pub(crate) fn facing(self) -> Facing {
        let unit = |axis: usize, sign: f64| [0, 1, 2].map(|k| if k == axis { sign } else { 0.0 });
        let [right, up] = self.axes();
        let sign = if self == Self::Xz { -1.0 } else { 1.0 };
        Facing {
            right: unit(right, 1.0),
            up: unit(up, 1.0),
            towards: unit(self.normal(), sign),
        }
    }

    /// The axis that it looks along.
    pub(crate) fn normal(self) -> usize {
        match self {
            Self::Xy => 2,
            Self::Xz => 1,
            Self::Yz => 0,
        }
    }
}

/// What the upper plot shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Aspect {
    /// Where the robot was, in a plane.
    #[default]
    Plane,
    /// The same in three dimensions.
    Space,
    /// The deviation around the joint's angle.
    Around,
}

named! {
    /// What the colour of an error vector says.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub(crate) enum Colouring {
        /// Before or after.
        #[default]
        State = say!("before and after"),
        /// The deviation's length.
        Deviation = say!("deviation"),
        /// Where it points to.
        Direction = say!("direction"),
        /// One standard uncertainty of what the model predicts.
        Uncertainty = say!("uncertainty (1σ)"),
        Load = say!("load"),
        Temperature = say!("temperature"),
        Time = say!("time"),
    }
    pub(crate) fn name;
    pub(crate) const ALL;
}

impl Colouring {
    /// Whether the width of a vector says the same as its colour.
    pub(crate) fn by_width(self) -> bool {
        self.condition().is_some() || self == Self::Uncertainty
    }

    /// The condition that it shows, in the order of [`crate::gui::cache::cloud::Cloud`].
    pub(crate) fn condition(self) -> Option<usize> {
        match self {
            Self::Load => Some(0),
            Self::Temperature => Some(1),
            Self::Time => Some(2),
            Self::State | Self::Deviation | Self::Direction | Self::Uncertainty => None,
        }
    }
}

/// What draws whatever there is once for each sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Canvas {
    /// Shapes of egui, thinned where there are many: nothing else is there.
    #[default]
    Shapes,
    /// The graphics processor, at most so many samples.
    Layers(usize),
}
