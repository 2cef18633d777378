//! How the window is divided at its size: how wide the sides are, and what stands there at all.
//!
//! Sizes are points, so that a larger size of text is a smaller window. The sides grow moderately
//! with it; the plots get the rest, and are never narrower than [`MIDDLE`]: where there is no room
//! for the results beside them the results are shut, and when they are opened they take the
//! plots' place.

/// The narrowest that plots are, points.
pub(crate) const MIDDLE: f32 = 380.0;
/// The narrowest that results are, points.
const RIGHT: f32 = 288.0;
/// The narrowest that steps are, points.
const LEFT: f32 = 260.0;
/// The widest that either can be pulled, points.
const WIDEST: f32 = 720.0;
/// From this width on results stand beside the plots unless they are shut, points.
const BESIDE: f32 = 980.0;
/// Below this height the list of steps has one line for each, points.
const LOW: f32 = 640.0;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Layout {
    /// Width of the steps and their controls.
    pub(crate) left: f32,
    /// Width of the results, where they stand beside the plots.
    pub(crate) right: Option<f32>,
    /// Whether the results take the place of the plots.
    pub(crate) instead: bool,
    /// Whether the steps have one line each.
    pub(crate) low: bool,
}

impl Layout {
    /// In a window of this size; `wanted` is whether the results are opened or shut by hand, `pulled`
    /// the widths of steps and results where they were pulled.
    pub(crate) fn of(
        width: f32,
        height: f32,
        wanted: Option<bool>,
        pulled: [Option<f32>; 2],
    ) -> Self {
        let usual_left = along(
            width,
            [
                (900.0, 280.0),
                (1024.0, 280.0),
                (1280.0, 304.0),
                (1920.0, 344.0),
                (3840.0, 440.0),
            ],
        );
        let usual_right = along(
            width,
            [
                (900.0, RIGHT),
                (1024.0, RIGHT),
                (1280.0, 344.0),
                (1920.0, 420.0),
                (3840.0, 560.0),
            ],
        );
        let least = LEFT + MIDDLE + RIGHT;
        let mut sides = (usual_left, usual_right);
        // Pulled widths never shut what has room at its least.
        if width >= least && pulled.iter().any(Option::is_some) {
            let left = pulled[0].unwrap_or(usual_left);
            let left = left.clamp(LEFT, (width - MIDDLE - RIGHT).clamp(LEFT, WIDEST));
            let right = pulled[1].unwrap_or(usual_right);
            let right = right.clamp(RIGHT, (width - MIDDLE - left).clamp(RIGHT, WIDEST));
            sides = (left, right);
        }
        let (left, right) = sides;
        let open = wanted.unwrap_or(width >= BESIDE);
        let beside = width - left - MIDDLE >= right;
        Self {
            left,
            right: (open && beside).then_some(right),
            instead: open && !beside,
            low: height < LOW,
        }
    }

    /// Whether the results are in sight.
    pub(crate) fn results(&self) -> bool {
        self.right.is_some() || self.instead
    }
}

/// Between these points it is linear, outside it is what it is at the end.
fn along(x: f32, points: [(f32, f32); 5]) -> f32 {
    let [first, .., last] = points;
    if x <= first.0 {
        return first.1;
    }
    let pairs = points.windows(2).find(|pair| x <= pair[1].0);
    pairs.map_or(last.1, |pair| {
        let t = (x - pair[0].0) / (pair[1].0 - pair[0].0);
        (pair[0].1 + t * (pair[1].1 - pair[0].1)).round()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sides_never_shrink_as_the_window_grows_and_the_plots_grow_with_it() {
        let mut last = Layout::of(600.0, 700.0, None, [None; 2]);
        for width in (600..4000).step_by(7) {
            let width = width as f32;
            let room = Layout::of(width, 700.0, None, [None; 2]);
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
        let narrow = |wanted| Layout::of(683.0, 384.0, wanted, [None; 2]);
        assert!(!narrow(None).results());
        assert!(narrow(Some(true)).instead && narrow(Some(true)).right.is_none());
        assert!(
            Layout::of(960.0, 540.0, Some(true), [None; 2])
                .right
                .is_some()
        );
        assert!(!Layout::of(1920.0, 1080.0, Some(false), [None; 2]).results());
        assert!(Layout::of(1024.0, 700.0, None, [None; 2]).right.is_some());
    }

    #[test]
    fn a_low_window_has_one_line_for_each_step() {
        assert!(Layout::of(911.0, 512.0, None, [None; 2]).low);
        assert!(!Layout::of(1024.0, 700.0, None, [None; 2]).low);
    }

    #[test]
    fn pulled_widths_hold_within_what_can_be_read_and_leave_room_for_the_plots() {
        let pulled = |left, right| Layout::of(1280.0, 800.0, None, [Some(left), Some(right)]);
        let room = pulled(380.0, 420.0);
        assert_eq!((room.left, room.right), (380.0, Some(420.0)));
        for (left, right) in [(1.0, 1.0), (5000.0, 5000.0), (700.0, 10.0), (10.0, 900.0)] {
            let room = pulled(left, right);
            let right = room.right.expect("there is room for them");
            assert!(room.left >= LEFT && right >= RIGHT, "{left} {room:?}");
            assert!(1280.0 - room.left - right >= MIDDLE, "{left} {room:?}");
        }
    }
}
