//! The workspace in three dimensions: what the plane shows, seen from wherever the camera is, with what the pointer
//! does in it.
//!
//! What is drawn is what a plane shows, projected along the line of sight, so that vectors, colours,
//! legend and robot are the same in both; only what has a depth is added here.

use egui::{Key, PointerButton, Rect, Response, Role, Sense, Ui, Vec2, WidgetInfo};

use crate::gui::style::{Palette, space};
use crate::gui::view::{Ball, Camera as ViewCamera};
use crate::gui::workbench::Workbench;
use crate::gui::workspace::pen::{Camera, Pen};
use crate::gui::workspace::pointer::{Seen, tell_plot_size};
use crate::gui::workspace::robot::{Drawn, body};
use crate::gui::{plots, widgets};
use crate::kinematics::Robot;

use super::model::ball;
use super::scene::{in_sight, in_space};

/// A direction in space is drawn so much shorter on average.
const FORESHORTENED: f64 = std::f64::consts::FRAC_PI_4;

/// Shows the view in the space that is left, and sends what the pointer does.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench) {
    let seen = Seen::of(ui, workbench);
    let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
    let ball = ball(workbench);
    let camera = in_sight(workbench, &ball, rect);
    let whole = ViewCamera {
        zoom: 1.0,
        ..workbench.view.camera
    };
    let size = [rect.width(), rect.height()].map(f64::from);
    let points_per_mm = FORESHORTENED * whole.points_per_mm(&ball, size);
    tell_plot_size(workbench, points_per_mm);
    let mut inside = ui.new_child(egui::UiBuilder::new().max_rect(rect));
    let ui = &mut inside;
    ui.set_clip_rect(rect.intersect(ui.clip_rect()));
    let pen = Pen {
        painter: ui.painter(),
        palette: &Palette::of(ui),
    };
    let (shown, robot) = (&seen.shown, seen.robot.as_ref());
    in_space(pen, workbench, shown, robot, (&ball, &camera));
    let view = &workbench.view;
    describe(&response, workbench);
    let pointer = response.hover_pos().filter(|_| !response.dragged());
    seen.finish(ui, workbench, &camera, (&response, pointer));
    let turned = looked(ui, &response, rect, &ball, view.camera);
    if response.double_clicked() {
        workbench.then(move |bench| bench.view.fit_workspace());
    } else if turned != view.camera {
        workbench.then(move |bench| bench.view.camera = turned);
    }
}

/// How the view is called, and what it shows, for those who do not see it.
fn describe(response: &Response, workbench: &Workbench) {
    let view = &workbench.view;
    let samples = workbench.loaded_session().overview.usable.len();
    let camera = view.camera.describe();
    let name = match view.selected {
        Some(sample) => say!(
            "3-D view, {samples} samples, {camera}, sample {sample} selected",
            samples,
            camera,
            sample = sample + 1
        ),
        None => say!("3-D view, {samples} samples, {camera}", samples, camera),
    };
    response.widget_info(|| WidgetInfo::labeled(Role::Figure, true, name.clone()));
    let how = say!("arrow keys orbit, plus and minus zoom, Home fits");
    let ctx = &response.ctx;
    ctx.accesskit_node_builder(response.id, |node| node.set_description(how));
}

/// Room around the robot, a part of its ball.
const ROOM: f64 = 1.12;

/// Draws a robot of this name at its zero in a field of this size, seen from where the camera is.
pub(crate) fn robot_alone(
    ui: &mut Ui,
    (robot, name): (&Robot, &str),
    camera: &mut ViewCamera,
    size: Vec2,
) -> Response {
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    widgets::label(&response, say!("{robot} at its zero", robot = name));
    let palette = Palette::of(ui);
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, space::ROUND, palette.inset);
    let Some(drawn) = Drawn::alone(robot) else {
        return response;
    };
    let points: Vec<[f64; 3]> = drawn.corners_mm.iter().map(|p| p.coords.into()).collect();
    let mut ball = Ball::around(&points);
    ball.radius_mm *= ROOM;
    *camera = looked(ui, &response, rect, &ball, *camera);
    let sides = [rect.width(), rect.height()].map(f64::from);
    let facing = camera.facing();
    let seen = Camera::showing(facing, camera.bounds(&ball, sides), rect);
    let pen = Pen {
        painter: &painter,
        palette: &palette,
    };
    body(pen, &drawn, &seen);
    response
}

/// What an arrow key turns, points of a drag.
const STEP: f64 = 12.0;
/// What + and − zoom.
const CLOSER: f64 = 1.25;

/// Where the camera is after what mouse and keys did in this frame.
fn looked(ui: &Ui, response: &Response, rect: Rect, ball: &Ball, camera: ViewCamera) -> ViewCamera {
    let size = [rect.width(), rect.height()].map(f64::from);
    let mut camera = camera;
    let dragged = response.drag_delta();
    if dragged != Vec2::ZERO {
        let [right, down] = [dragged.x, dragged.y].map(f64::from);
        let shift = ui.input(|i| i.modifiers.shift);
        camera = if response.dragged_by(PointerButton::Primary) && !shift {
            camera.orbited([right, down])
        } else {
            let scale = camera.points_per_mm(ball, size);
            camera.panned([right / scale, -down / scale])
        };
    }
    if response.contains_pointer()
        && let Some(at) = ui.input(|i| i.pointer.hover_pos())
    {
        let closer = f64::from(plots::closer(ui.ctx()).y)
            * f64::from(ui.input(egui::InputState::zoom_delta));
        if closer != 1.0 {
            let off = at - rect.center();
            let scale = camera.points_per_mm(ball, size);
            camera = camera.zoomed(
                closer,
                [f64::from(off.x) / scale, -f64::from(off.y) / scale],
            );
        }
    }
    if response.has_focus() {
        widgets::keep_arrows(ui, response.id);
        camera = by_keys(ui, camera);
    }
    camera
}

fn by_keys(ui: &Ui, camera: ViewCamera) -> ViewCamera {
    let pressed = |key| ui.input(|i| i.modifiers.is_none() && i.key_pressed(key));
    let turned = |camera: ViewCamera, way: [f64; 2]| camera.orbited(way.map(|v| STEP * v));
    let mut camera = camera;
    for (key, way) in [
        (Key::ArrowLeft, [-1.0, 0.0]),
        (Key::ArrowRight, [1.0, 0.0]),
        (Key::ArrowUp, [0.0, -1.0]),
        (Key::ArrowDown, [0.0, 1.0]),
    ] {
        if pressed(key) {
            camera = turned(camera, way);
        }
    }
    if pressed(Key::Plus) || pressed(Key::Equals) {
        camera = camera.zoomed(CLOSER, [0.0; 2]);
    }
    if pressed(Key::Minus) {
        camera = camera.zoomed(1.0 / CLOSER, [0.0; 2]);
    }
    camera
}

#[cfg(test)]
mod tests {
    use egui::vec2;
    use nalgebra::{Isometry3, Point3, Vector3};

    use crate::gui::testing::workbench;

    use super::super::model::Shown;
    use super::*;

    /// An arm measured by a tracker that stands in a frame of its own, and says so in a column.
    fn arm() -> Workbench {
        opened(&arms().join("six-60.json"))
    }

    fn arms() -> std::path::PathBuf {
        concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/arms").into()
    }

    fn opened(file: &std::path::Path) -> Workbench {
        let mut workbench = workbench();
        workbench.execute(|bench| bench.open_file(file.into()));
        workbench.receive();
        assert!(workbench.view.in_space, "no plane shows several joints");
        workbench
    }

    /// How far from where it was measured the tool of the shown sample is drawn, mm.
    fn far(workbench: &Workbench) -> f64 {
        let drawn = Drawn::of(workbench).expect("there are samples");
        let (tool, sample) = (drawn.corners_mm[13], drawn.sample.expect("one of them"));
        (tool - Point3::from(workbench.loaded_session().measured(sample))).norm()
    }

    #[test]
    fn with_setups_the_robot_stands_there_from_the_beginning() {
        let mut workbench = arm();
        assert!(far(&workbench) < 20.0, "{}", far(&workbench));
        let before = workbench
            .loaded_session()
            .gap_before
            .expect("samples")
            .rms_mm;
        assert!(before < 10.0, "{before}");
        workbench.execute(|bench| bench.identify(None));
        workbench.receive();
        assert!(far(&workbench) < 20.0, "{}", far(&workbench));
        assert!(
            Shown::of(&workbench).look.ghosts(),
            "before is worth a look"
        );
    }

    #[test]
    fn once_it_is_identified_the_robot_stands_where_its_targets_were_measured() {
        // The same without the column: only the fit finds where the tracker stands.
        let folder = tempfile::tempdir().expect("a folder");
        let text = std::fs::read_to_string(arms().join("six-60.csv")).expect("the samples");
        let file = folder.path().join("six-60.json");
        std::fs::copy(arms().join("six-60.json"), &file).expect("copied");
        let samples = text.replace(",setup,", ",name,");
        std::fs::write(folder.path().join("six-60.csv"), samples).expect("written");
        let mut workbench = opened(&file);
        assert!(far(&workbench) > 1000.0);
        workbench.execute(|bench| bench.identify(None));
        workbench.receive();
        assert!(far(&workbench) < 20.0, "{}", far(&workbench));
        // z of the base is up although the tracker leans.
        let up = workbench.base().rotation * Vector3::z();
        assert!(workbench.facing().flat(up.into())[0].abs() < 1e-9);
        // Vectors are as long as what is left can be read, and the frame's error is not drawn.
        let scene = Shown::of(&workbench);
        assert!(scene.look.magnification > 100.0 && !scene.look.ghosts());
        // The plane stays in the measuring frame.
        workbench.execute(|bench| bench.view.look_in(crate::gui::view::Plane::Xy));
        assert_eq!(workbench.base(), Isometry3::identity());
    }

    #[test]
    fn everything_is_in_sight_until_somebody_looks_closer() {
        let mut workbench = arm();
        workbench.execute(|bench| bench.identify(None));
        workbench.receive();
        let rect = Rect::from_min_size(egui::pos2(20.0, 30.0), vec2(500.0, 320.0));
        for _ in 0..6 {
            let turned = workbench.view.camera.orbited([61.0, 17.0]);
            workbench.execute(|bench| bench.view.camera = turned);
            let camera = in_sight(&workbench, &ball(&workbench), rect);
            let loaded_session = workbench.loaded_session();
            for sample in 0..loaded_session.len() {
                let at = camera.at(loaded_session.measured(sample));
                assert!(rect.contains(at), "{at:?}");
            }
            let origin = workbench.base().translation.vector;
            assert!(rect.contains(camera.at(origin.into())));
        }
        let closer = workbench.view.camera.zoomed(20.0, [0.0; 2]);
        workbench.execute(|bench| bench.view.camera = closer);
        workbench.execute(|bench| bench.view.fit_workspace());
        assert_eq!(workbench.view.camera.zoom, 1.0);
    }
}
