//! Where there is room: for what is written on a plot, and for the card at the pointer. Rectangles
//! and points only, so that it is tested without pixels.

use egui::{Pos2, Rect, Vec2, pos2, vec2};

/// Places of this size about a point, none of them nearer than `gap`; the most usual ones first.
pub(crate) fn around(at: Pos2, size: Vec2, gap: f32) -> [Rect; 8] {
    let half = 0.5 * size;
    let beside = |x: f32, y: f32| {
        Rect::from_center_size(at + vec2(x * (half.x + gap), y * (half.y + gap)), size)
    };
    [
        beside(1.0, -1.0),
        beside(1.0, 1.0),
        beside(-1.0, -1.0),
        beside(-1.0, 1.0),
        beside(1.0, 0.0),
        beside(-1.0, 0.0),
        beside(0.0, -1.0),
        beside(0.0, 1.0),
    ]
}

/// Of these places the one in the frame that covers the fewest points; the earlier among equals.
pub(crate) fn freest(places: &[Rect], frame: Rect, crowds: &[&[Pos2]]) -> Option<Rect> {
    let covered = |place: &Rect| {
        let inside = |crowd: &&[Pos2]| crowd.iter().filter(|p| place.contains(**p)).count();
        crowds.iter().map(inside).sum::<usize>()
    };
    let inside = places.iter().filter(|place| frame.contains_rect(**place));
    inside.copied().min_by_key(covered)
}

/// The same, then farther away, then the corners of the frame.
pub(crate) fn everywhere(at: Pos2, size: Vec2, gap: f32, frame: Rect) -> Vec<Rect> {
    let nearer = [1.0, 3.0, 6.0].map(|times| around(at, size, times * gap));
    let inner = frame.shrink(8.0);
    let corners = [
        Rect::from_min_size(inner.min, size),
        Rect::from_min_size(pos2(inner.right() - size.x, inner.top()), size),
        Rect::from_min_size(pos2(inner.left(), inner.bottom() - size.y), size),
        Rect::from_min_size(inner.max - size, size),
    ];
    nearer.into_iter().flatten().chain(corners).collect()
}

/// Where the card about a mark stands: beside it, never on it, above or beside the plot rather than
/// below it where another one is, and always within the window.
pub(crate) fn card(mark: Pos2, size: Vec2, gap: f32, plot: Rect, window: Rect) -> Rect {
    let places = around(mark, size, gap);
    let mut corners = [places[0], places[1], places[2], places[3]];
    // Outwards there is less to hide.
    let inwards = |place: &Rect| -(place.center() - plot.center()).length_sq();
    corners.sort_by(|a, b| inwards(a).total_cmp(&inwards(b)));
    let within = |frame: Rect| corners.iter().find(|p| frame.contains_rect(**p)).copied();
    // Beside a plot there are words, which hide less than they say; above them are its controls.
    let band = |bottom: f32| {
        let band = Rect::from_x_y_ranges(window.x_range(), plot.top() - WORDS..=bottom);
        band.intersect(window)
    };
    let bands = [plot.bottom(), window.bottom()].map(band);
    if let Some(place) = within(bands[0]) {
        return place;
    }
    let high = bands.into_iter().find(|band| band.height() >= size.y);
    pushed(mark, size, gap, high.unwrap_or(window))
}

/// Height of the words above a plot, points.
const WORDS: f32 = 22.0;

/// On the side that has more room, pushed into the window along the mark.
fn pushed(mark: Pos2, size: Vec2, gap: f32, window: Rect) -> Rect {
    let left = mark.x - window.left() > window.right() - mark.x;
    let x = if left {
        mark.x - gap - size.x
    } else {
        mark.x + gap
    };
    let most = (window.bottom() - size.y).max(window.top());
    let y = (mark.y - 0.5 * size.y).clamp(window.top(), most);
    Rect::from_min_size(pos2(x, y), size)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rect(left: f32, top: f32, right: f32, bottom: f32) -> Rect {
        Rect::from_min_max(pos2(left, top), pos2(right, bottom))
    }

    #[test]
    fn the_card_never_covers_its_mark_and_never_leaves_the_window() {
        let window = rect(0.0, 0.0, 1024.0, 700.0);
        let plot = rect(304.0, 90.0, 680.0, 420.0);
        for size in [vec2(200.0, 90.0), vec2(260.0, 200.0)] {
            for (x, y) in (0..=40).flat_map(|x| (0..=40).map(move |y| (x, y))) {
                let part = |k: i32, [low, high]: [f32; 2]| low + (high - low) * k as f32 / 40.0;
                let mark = pos2(part(x, [304.0, 680.0]), part(y, [90.0, 700.0]));
                let card = card(mark, size, 14.0, plot, window);
                assert!(window.contains_rect(card), "{mark:?} {card:?}");
                assert!(!card.expand(13.0).contains(mark), "{mark:?} {card:?}");
            }
        }
    }

    #[test]
    fn the_card_stays_off_the_plot_below() {
        let window = rect(0.0, 0.0, 1280.0, 800.0);
        let plot = rect(304.0, 90.0, 930.0, 480.0);
        for mark in [pos2(310.0, 100.0), pos2(920.0, 470.0), pos2(600.0, 450.0)] {
            let card = card(mark, vec2(200.0, 90.0), 14.0, plot, window);
            assert!(card.bottom() <= plot.bottom(), "{mark:?} {card:?}");
        }
    }

    #[test]
    fn the_card_stays_off_the_controls_of_a_low_chart() {
        let window = rect(0.0, 0.0, 1280.0, 800.0);
        let plot = rect(356.0, 598.0, 924.0, 720.0);
        for size in [vec2(180.0, 98.0), vec2(260.0, 190.0)] {
            for mark in [pos2(360.0, 600.0), pos2(480.0, 660.0), pos2(920.0, 715.0)] {
                let card = card(mark, size, 26.0, plot, window);
                assert!(card.top() >= 570.0, "{mark:?} {card:?}");
                assert!(window.contains_rect(card), "{mark:?} {card:?}");
                assert!(!card.expand(13.0).contains(mark), "{mark:?} {card:?}");
            }
        }
    }

    #[test]
    fn the_card_goes_outwards_where_it_can() {
        let window = rect(0.0, 0.0, 1280.0, 800.0);
        let plot = rect(304.0, 90.0, 930.0, 480.0);
        let right = card(pos2(700.0, 300.0), vec2(180.0, 90.0), 20.0, plot, window);
        assert!(right.left() > 700.0);
        let left = card(pos2(520.0, 300.0), vec2(180.0, 90.0), 20.0, plot, window);
        assert!(left.right() < 520.0);
    }

    #[test]
    fn what_is_written_goes_where_the_fewest_points_are() {
        let frame = rect(0.0, 0.0, 400.0, 400.0);
        let tool = pos2(200.0, 200.0);
        let places = around(tool, vec2(80.0, 40.0), 10.0);
        assert_eq!(freest(&places, frame, &[]), Some(places[0]));
        let crowd = [places[0].center(), places[1].center(), places[2].center()];
        assert_eq!(freest(&places, frame, &[&crowd]), Some(places[3]));
        let corner = around(pos2(395.0, 5.0), vec2(80.0, 40.0), 10.0);
        let place = freest(&corner, frame, &[]).expect("there is room to the left");
        assert!(frame.contains_rect(place));
        assert_eq!(freest(&places, rect(0.0, 0.0, 20.0, 20.0), &[]), None);
    }
}
