//! The geometry of the camera: where points are on the screen before and after it moves.

use super::*;

const BALL: Ball = Ball {
    centre_mm: [100.0, -50.0, 300.0],
    radius_mm: 400.0,
};
const SIZE: [f64; 2] = [600.0, 400.0];

/// Where a point is on the screen, points from the upper left corner.
fn seen(camera: &Camera, p: [f64; 3]) -> [f64; 2] {
    let [low, high] = camera.bounds(&BALL, SIZE);
    let [x, y] = camera.facing().flat(p);
    [
        (x - low[0]) / (high[0] - low[0]) * SIZE[0],
        (high[1] - y) / (high[1] - low[1]) * SIZE[1],
    ]
}

fn near(a: [f64; 2], b: [f64; 2]) {
    assert!(
        (a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9,
        "{a:?} {b:?}"
    );
}

#[test]
fn the_axes_of_a_view_are_a_right_handed_frame_with_z_upright() {
    for (azimuth_rad, elevation_rad) in [(0.3, 0.5), (-2.0, -1.2), (3.0, 1.5)] {
        let camera = Camera {
            azimuth_rad,
            elevation_rad,
            ..Camera::default()
        };
        let Facing { right, up, towards } = camera.facing();
        let cross = [
            right[1] * up[2] - right[2] * up[1],
            right[2] * up[0] - right[0] * up[2],
            right[0] * up[1] - right[1] * up[0],
        ];
        assert!((0..3).all(|k| (cross[k] - towards[k]).abs() < 1e-12));
        assert!((dot(up, up) - 1.0).abs() < 1e-12 && right[2] == 0.0 && up[2] > 0.0);
    }
}

#[test]
fn standard_views_show_the_axes_that_their_names_say() {
    let seen = |view: Standard| {
        let facing = Camera::from(view).facing();
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| facing.flat(axis))
    };
    let [x, y, z] = seen(Standard::Top);
    near(x, [1.0, 0.0]);
    near(y, [0.0, 1.0]);
    near(z, [0.0, 0.0]);
    let [x, y, z] = seen(Standard::Front);
    near(x, [0.0, 0.0]);
    near(y, [1.0, 0.0]);
    near(z, [0.0, 1.0]);
    let [x, y, z] = seen(Standard::Side);
    near(x, [1.0, 0.0]);
    near(y, [0.0, 0.0]);
    near(z, [0.0, 1.0]);
    let lengths = seen(Standard::Isometric).map(|[a, b]| a.hypot(b));
    assert!(
        lengths.iter().all(|l| (l - lengths[0]).abs() < 1e-12),
        "{lengths:?}"
    );
    for view in Standard::ALL {
        assert_eq!(Camera::from(view).standard(), Some(view));
    }
    assert_eq!(Camera::default().orbited([3.0, 0.0]).standard(), None);
}

#[test]
fn what_is_drawn_fits_from_every_side() {
    let mut camera = Camera::default();
    for _ in 0..40 {
        camera = camera.orbited([37.0, 11.0]);
        for corner in 0..8_usize {
            let side = BALL.radius_mm / 3.0_f64.sqrt();
            let p = [0, 1, 2]
                .map(|k| BALL.centre_mm[k] + if corner >> k & 1 == 1 { side } else { -side });
            let [x, y] = seen(&camera, p);
            assert!((0.0..=SIZE[0]).contains(&x) && (0.0..=SIZE[1]).contains(&y));
        }
    }
}

#[test]
fn orbiting_leaves_the_pivot_in_the_middle_and_turns_what_is_near_with_the_pointer() {
    let camera = Camera::default().panned([40.0, -25.0]);
    let pivot = [0, 1, 2].map(|k| BALL.centre_mm[k] + camera.offset_mm[k]);
    let turned = camera.orbited([50.0, 20.0]);
    near(seen(&camera, pivot), [300.0, 200.0]);
    near(seen(&turned, pivot), [300.0, 200.0]);
    let towards = camera.facing().towards;
    let front = [0, 1, 2].map(|k| pivot[k] + 100.0 * towards[k]);
    let (before, after) = (seen(&camera, front), seen(&turned, front));
    assert!(
        after[0] > before[0] && after[1] > before[1],
        "{before:?} {after:?}"
    );
    // Straight from above is as far as it goes.
    assert_eq!(camera.orbited([0.0, 1e6]).elevation_rad, FRAC_PI_2);
}

#[test]
fn panning_takes_everything_along_by_as_many_points_as_the_pointer_moved() {
    let camera = Camera::default()
        .zoomed(3.0, [0.0; 2])
        .orbited([15.0, -30.0]);
    let p = [80.0, 20.0, 250.0];
    let scale = camera.points_per_mm(&BALL, SIZE);
    let moved = camera.panned([24.0 / scale, 10.0 / scale]);
    let [x, y] = seen(&camera, p);
    near(seen(&moved, p), [x + 24.0, y - 10.0]);
}

#[test]
fn zooming_leaves_what_is_under_the_pointer_where_it_is() {
    let camera = Camera::default().orbited([70.0, 30.0]);
    let p = [180.0, 60.0, 410.0];
    let [x, y] = seen(&camera, p);
    let scale = camera.points_per_mm(&BALL, SIZE);
    let at = [(x - 0.5 * SIZE[0]) / scale, (0.5 * SIZE[1] - y) / scale];
    let closer = camera.zoomed(4.0, at);
    near(seen(&closer, p), [x, y]);
    assert!((closer.points_per_mm(&BALL, SIZE) / scale - 4.0).abs() < 1e-9);
    assert_eq!(
        closer.fitted().bounds(&BALL, SIZE),
        camera.fitted().bounds(&BALL, SIZE)
    );
    // No nearer than numbers go, and then nothing moves.
    assert_eq!(camera.zoomed(1e30, [0.0; 2]).zoom, ZOOM[1]);
}

#[test]
fn what_is_no_number_becomes_one_that_can_be_drawn() {
    let broken = Camera {
        azimuth_rad: f64::NAN,
        elevation_rad: f64::INFINITY,
        zoom: f64::NAN,
        offset_mm: [f64::NAN, 1.0, 2.0],
    };
    let sound = broken.sound();
    assert_eq!(
        (sound.azimuth_rad, sound.elevation_rad, sound.zoom),
        (0.0, 0.0, 1.0)
    );
    assert_eq!(sound.offset_mm, [0.0, 1.0, 2.0]);
    assert_eq!(Ball::around(&[[f64::INFINITY; 3]]).radius_mm, 1.0);
}
