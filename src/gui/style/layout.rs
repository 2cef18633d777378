//! How the window is divided at its size: how wide the sides are, and whether the results are in sight. Sizes are points,
//! so that a larger size of text is a smaller window. The sides grow moderately with it; the plots get the rest,
//! and are never narrower than [`MIDDLE`]: where there is no room for the results beside them the results are shut,
//! and when they are opened they take the plots' place.

/// The narrowest that plots are, points.
pub(crate) const MIDDLE: f32 = 380.0;
/// The narrowest that results are, points.
pub(crate) const RIGHT: f32 = 288.0;
/// The narrowest that steps are, points.
pub(crate) const LEFT: f32 = 260.0;
/// The widest that either can be pulled, points.
pub(crate) const WIDEST: f32 = 720.0;
/// From this width on results are shown beside the plots unless they are shut, points.
const BESIDE: f32 = 980.0;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Layout {
    /// Width of the steps and their controls.
    pub(crate) left: f32,
    /// Width of the results, where they are shown beside the plots.
    pub(crate) right: Option<f32>,
    /// Whether the results take the place of the plots.
    pub(crate) instead: bool,
}

impl Layout {
    /// In a window of this size; `wanted` is whether the results are opened or shut by hand.
    pub(crate) fn of(width: f32, wanted: Option<bool>) -> Self {
        // In steps, so that what was pulled holds while the window is pulled a little.
        let (left, right) = match width {
            ..1100.0 => (280.0, RIGHT),
            ..1600.0 => (304.0, 344.0),
            ..2560.0 => (344.0, 420.0),
            _ => (440.0, 560.0),
        };
        let open = wanted.unwrap_or(width >= BESIDE);
        let beside = width - left - MIDDLE >= right;
        Self {
            left,
            right: (open && beside).then_some(right),
            instead: open && !beside,
        }
    }

    /// Whether the results are in sight.
    pub(crate) fn results(&self) -> bool {
        self.right.is_some() || self.instead
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sides_never_shrink_as_the_window_grows_and_the_plots_grow_with_it() {
        let mut last = Layout::of(600.0, None);
        for width in (600..4000).step_by(7) {
            let width = width as f32;
            let room = Layout::of(width, None);
            assert!(
                room.left >= last.left && room.right >= last.right,
                "{width}"
            );
            let middle = width - room.left - room.right.unwrap_or(0.0);
            assert!(
                room.instead || width < 700.0 || middle >= MIDDLE,
                "{width}: {middle}"
            );
            if width >= 1280.0 {
                assert!(middle >= 0.48 * width, "{width}: {middle}");
            }
            last = room;
        }
    }

    #[test]
    fn results_that_have_no_room_beside_the_plots_can_be_opened_in_their_place() {
        let narrow = |wanted| Layout::of(683.0, wanted);
        assert!(!narrow(None).results());
        assert!(narrow(Some(true)).instead && narrow(Some(true)).right.is_none());
        assert!(Layout::of(960.0, Some(true)).right.is_some());
        assert!(!Layout::of(1920.0, Some(false)).results());
        assert!(Layout::of(1024.0, None).right.is_some());
    }
}
