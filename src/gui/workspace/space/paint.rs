//! The view in space in egui, and what the pointer does in it.

use std::sync::Arc;

use egui::{Align2, FontId, Panel, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, vec2};
use egui_plot::{PlotBounds, PlotPoint, PlotTransform};
use nalgebra::{Isometry3, Point3, Vector3};

use crate::gui::cache::cloud::Cloud;
use crate::gui::layers::{CloudLayer, Frame, Layer, SpaceLayer};
use crate::gui::plots::marks;
use crate::gui::style::tokens::{Palette, size};
use crate::gui::view::{Ball, Camera, Canvas, Facing};
use crate::gui::workbench::{Command, Workbench};
use crate::present::numbers::trimmed;

use super::super::drawn::{arrows, emphasis, path, points, ring};
use super::super::model::{Scene, ball};
use super::super::notes::Notes;
use super::super::pointer::{REACH, hover, marked};
use super::super::robot::{self, Drawn, FAINT};
use super::super::room::tell_room;
use super::super::{label_layout, layout, legend};
use super::ground::{Triad, frame, grid, square_mm};
use super::robot::Pen;
use super::surface::Face;
use super::{joints, looking, pick, surface};

/// A direction in space is drawn so much shorter on average.
const FORESHORTENED: f64 = std::f64::consts::FRAC_PI_4;

/// Width of the sliders that pose the robot, points.
const SLIDERS: f32 = 176.0;

/// Shows the view in the space that is left, and sends what the pointer does.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, posing: bool, commands: &mut Vec<Command>) {
    let palette = Palette::of(ui);
    let scene = Scene::of(workbench);
    let robot = Drawn::of(workbench);
    let notes = Notes::recall(ui, &scene);
    let scale = legend::show(ui, workbench, &scene, robot.as_ref(), &notes.said, &palette);
    if posing && let Some(robot) = &robot {
        Panel::right("joints of the robot")
            .resizable(false)
            .exact_size(SLIDERS)
            .frame(egui::Frame::NONE.inner_margin(egui::Margin::symmetric(8, 4)))
            .show(ui, |ui| joints::show(ui, workbench, &robot.q, commands));
    }
    let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
    let space = Space::new(workbench, rect);
    let transform = &space.transform;
    let whole = Camera {
        zoom: 1.0,
        ..workbench.view().camera
    };
    let size = [rect.width(), rect.height()].map(f64::from);
    let seen = FORESHORTENED * whole.points_per_mm(&space.ball, size);
    tell_room(workbench, seen, commands);
    let mut inside = ui.new_child(egui::UiBuilder::new().max_rect(rect));
    let ui = &mut inside;
    ui.set_clip_rect(rect.intersect(ui.clip_rect()));
    drawn(ui, workbench, &scene, robot.as_ref(), &space, &palette);
    notes.keep(ui, &scene, transform);
    if let Some(room) = scale {
        // The legend stands above the plot.
        let mut above = ui.new_child(egui::UiBuilder::new().max_rect(room));
        above.set_clip_rect(room.expand(40.0));
        legend::scale(&above, room, &scene, transform, workbench, &palette);
    }
    let view = workbench.view();
    if let Some(robot) = &robot {
        let crowd = if view.selected.is_some() && view.hovered.is_none() {
            label_layout::crowd(workbench, &scene, transform)
        } else {
            Vec::new()
        };
        let written = robot.asked_for && view.hovered.is_none();
        robot::values(ui, transform, robot, written, &crowd, &palette);
    }
    says(&response, workbench);
    let pointer = response.hover_pos().filter(|_| !response.dragged());
    let under = pointer.and_then(|at| space.under(workbench, &scene, at));
    hover(&response, workbench, under, commands);
    let camera = looking::looked(ui, &response, rect, &space.ball, view.camera);
    if response.double_clicked() {
        commands.push(Command::FitWorkspace);
    } else if camera != view.camera {
        commands.push(Command::Turn(camera));
    }
}

/// How the view is called, and what it shows, for those who do not see it.
fn says(response: &egui::Response, workbench: &Workbench) {
    let view = workbench.view();
    let samples = workbench.subject().overview.usable.len();
    let mut name = say!(
        "3-D view, {samples} samples, {camera}",
        samples = samples,
        camera = view.camera.says()
    );
    if let Some(sample) = view.selected {
        name += &say!(", sample {sample} selected", sample = sample + 1);
    }
    response.widget_info(|| WidgetInfo::labeled(Role::Figure, true, name.clone()));
    let how =
        say!("arrow keys orbit, plus and minus zoom, Home fits; 0, 1, 3 and 7 are standard views");
    let ctx = &response.ctx;
    ctx.accesskit_node_builder(response.id, |node| node.set_description(how));
}

/// Where everything is on the screen.
pub(super) struct Space {
    pub(super) facing: Facing,
    /// The base in the measuring frame.
    base: Isometry3<f64>,
    pub(super) ball: Ball,
    pub(super) points_per_mm: f64,
    transform: PlotTransform,
}

impl Space {
    /// In a plot here.
    pub(super) fn new(workbench: &Workbench, rect: Rect) -> Self {
        let camera = workbench.view().camera;
        let size = [rect.width(), rect.height()].map(f64::from);
        let ball = ball(workbench);
        let [mut low, mut high] = camera.bounds(&ball, size);
        // The plot's coordinates are those of the measuring frame.
        let (facing, base) = (workbench.facing(), workbench.base());
        let shift = facing.flat(base.translation.vector.into());
        for k in 0..2 {
            low[k] += shift[k];
            high[k] += shift[k];
        }
        Self {
            facing,
            base,
            points_per_mm: camera.points_per_mm(&ball, size),
            transform: PlotTransform::new(rect, PlotBounds::from_min_max(low, high), false),
            ball,
        }
    }

    /// Where a point of the base frame is on the screen.
    pub(super) fn screen(&self, p: [f64; 3]) -> Pos2 {
        self.measured(self.base * Point3::from(p))
    }

    /// Where a point of the measuring frame is.
    fn measured(&self, p: Point3<f64>) -> Pos2 {
        self.seen(self.facing.flat(p.into()))
    }

    /// Where a point of the scene is, mm to the right and up.
    pub(super) fn seen(&self, [x, y]: [f64; 2]) -> Pos2 {
        self.transform.position_from_point(&PlotPoint::new(x, y))
    }

    fn under(&self, workbench: &Workbench, scene: &Scene, at: Pos2) -> Option<usize> {
        let at = self.transform.value_from_position(at);
        let [points, _] = layout::counts(scene, &self.transform);
        let reach = (f64::from(REACH), points);
        pick::under(
            workbench,
            scene,
            &self.facing,
            [at.x, at.y],
            self.points_per_mm,
            reach,
        )
    }
}

/// Grid, frames, robot and samples.
fn drawn(
    ui: &Ui,
    workbench: &Workbench,
    scene: &Scene,
    robot: Option<&Drawn>,
    space: &Space,
    palette: &Palette,
) {
    let view = workbench.view();
    let transform = &space.transform;
    let screen = |p: [f64; 3]| space.screen(p);
    let mut shapes = Vec::new();
    grid(&mut shapes, &space.ball, &screen, palette);
    path(&mut shapes, transform, scene, palette);
    if let Some(robot) = robot {
        let pen = Pen {
            facing: &space.facing,
            points_per_mm: space.points_per_mm,
            screen: |p| space.measured(p),
            palette,
            base: [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| space.base.rotation * axis),
        };
        let surface = surface_of(workbench, robot, space, palette);
        let surface = surface.map(|faces| surface::shape(&faces));
        super::robot::beneath(&mut shapes, robot, transform, &pen, surface);
    }
    if let Canvas::Layers(_) = view.canvas {
        shapes.push(cloud(
            workbench,
            scene,
            transform,
            palette,
            ui.pixels_per_point(),
        ));
    } else {
        points(&mut shapes, transform, scene, palette);
        arrows(
            &mut shapes,
            transform,
            scene,
            palette,
            workbench.answer().is_some(),
        );
    }
    proposed(&mut shapes, workbench, &screen, palette);
    for sample in marked(view, workbench.subject().len()) {
        ring(&mut shapes, transform, workbench, sample, palette);
    }
    if let Some(sample) = view.hovered.or(view.selected) {
        emphasis(&mut shapes, transform, scene, workbench, sample, palette);
    }
    ui.painter().extend(shapes);
    frames(ui, workbench, robot, space, palette);
    let units = workbench.units();
    let square = trimmed(units.length_value(square_mm(&space.ball)), 3);
    let says = say!(
        "grid {square} {unit}",
        square = square,
        unit = units.length_name()
    );
    let at = transform.frame().left_bottom() + vec2(4.0, -4.0);
    let font = FontId::proportional(size::SMALL);
    ui.painter()
        .text(at, Align2::LEFT_BOTTOM, says, font, palette.muted);
}

/// The robot's meshes as they are seen, where they are known.
pub(super) fn surface_of(
    workbench: &Workbench,
    robot: &Drawn,
    space: &Space,
    palette: &Palette,
) -> Option<Vec<Face>> {
    let subject = workbench.subject();
    let appearance = subject.appearance.as_deref()?;
    let motions = subject.session.robot.motions_from_home(&robot.q);
    let motions: Vec<_> = motions.iter().map(|motion| space.base * motion).collect();
    let seen = if robot.asked_for { 1.0 } else { FAINT };
    let screen = |p| space.measured(p);
    Some(surface::faces(
        appearance,
        &motions,
        &space.facing,
        screen,
        palette,
        seen,
    ))
}

/// Samples by their depth.
fn cloud(
    workbench: &Workbench,
    scene: &Scene,
    transform: &PlotTransform,
    palette: &Palette,
    pixels: f32,
) -> Shape {
    let layer = CloudLayer {
        cloud: Arc::clone(&Cloud::of(workbench.subject())),
        remainder: workbench.remainder(),
        frame: Frame::new(&scene.look, palette, transform, None, pixels),
        counts: layout::counts(scene, transform),
        ghosts: scene.look.ghosts(),
    };
    SpaceLayer(layer).shape(*transform.frame())
}

/// Poses that a diagnosis proposes to measure: open diamonds where the target would be.
fn proposed(
    shapes: &mut Vec<Shape>,
    workbench: &Workbench,
    screen: &impl Fn([f64; 3]) -> Pos2,
    palette: &Palette,
) {
    let session = &workbench.subject().session;
    let poses = workbench.diagnosis().map_or(&[][..], |d| &d.next_poses);
    for pose in poses
        .iter()
        .filter(|p| p.q.len() == session.robot.joint_count())
    {
        let named = |name: &String| session.targets.iter().find(|t| t.name == *name);
        let known = pose
            .target
            .as_ref()
            .and_then(named)
            .or(session.targets.first());
        let target = match pose.target_mm {
            Some(at) => Point3::from(at),
            None => known.map_or_else(Point3::origin, |t| t.position_mm),
        };
        let at = screen(session.robot.point_in_base(&pose.q, &target).coords.into());
        let edge = Stroke::new(1.5, palette.accent);
        shapes.push(marks::diamond(at, 5.0, egui::Color32::TRANSPARENT, edge));
    }
}

/// The frames of base, tool and instrument.
fn frames(ui: &Ui, workbench: &Workbench, robot: Option<&Drawn>, space: &Space, palette: &Palette) {
    let screen = |p: [f64; 3]| space.measured(Point3::from(p));
    let show = |name: &str, at: Isometry3<f64>| {
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        let triad = Triad {
            at_mm: at.translation.vector.into(),
            axes: axes.map(|axis| (at.rotation * axis).into()),
            name,
        };
        frame(
            ui,
            &triad,
            &space.facing,
            space.points_per_mm,
            &screen,
            palette,
        );
    };
    show(say!("base"), space.base);
    let session = &workbench.subject().session;
    if let Some(robot) = robot.filter(|r| r.asked_for) {
        show(
            say!("tool"),
            space.base * session.robot.base_from_tool(&robot.q),
        );
    }
    let instrument = &session.instrument;
    let own_frame = workbench.found_base().or(workbench.subject().base);
    let stands = instrument.tracker.map(|tracker| tracker.position_mm.coords);
    if let Some(at) = stands.or(own_frame.map(|_| Vector3::zeros())) {
        // A tracker that stands aside is seen from farther away.
        show(
            &instrument.name,
            Isometry3::from_parts(at.into(), nalgebra::UnitQuaternion::identity()),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::core::edit::Edit;
    use crate::gui::testing::workbench;

    /// An arm measured by a tracker that stands in a frame of its own, and says so in a column.
    fn arm() -> Workbench {
        opened(&arms().join("six-60.json"))
    }

    fn arms() -> std::path::PathBuf {
        concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/arms").into()
    }

    fn opened(file: &std::path::Path) -> Workbench {
        let mut workbench = workbench();
        workbench.execute(Command::OpenFile(file.into()));
        workbench.receive();
        assert!(workbench.view().in_space(), "no plane shows several joints");
        workbench
    }

    /// How far from where it was measured the tool of the shown sample is drawn, mm.
    fn far(workbench: &Workbench) -> f64 {
        let drawn = Drawn::of(workbench).expect("there are samples");
        let (tool, sample) = (drawn.corners_mm[13], drawn.sample.expect("one of them"));
        (tool - Point3::from(workbench.subject().measured(sample))).norm()
    }

    #[test]
    fn with_setups_the_robot_stands_there_from_the_beginning() {
        let mut workbench = arm();
        assert!(far(&workbench) < 20.0, "{}", far(&workbench));
        let before = workbench.subject().gap_before.expect("samples").rms_mm;
        assert!(before < 10.0, "{before}");
        workbench.execute(Command::Edit(Edit::Identify));
        workbench.receive();
        assert!(far(&workbench) < 20.0, "{}", far(&workbench));
        assert!(
            Scene::of(&workbench).look.ghosts(),
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
        workbench.execute(Command::Edit(Edit::Identify));
        workbench.receive();
        assert!(far(&workbench) < 20.0, "{}", far(&workbench));
        // z of the base is up although the tracker leans.
        let up = workbench.base().rotation * Vector3::z();
        assert!(workbench.facing().flat(up.into())[0].abs() < 1e-9);
        // Vectors are as long as what is left can be read, and the frame's error is not drawn.
        let scene = Scene::of(&workbench);
        assert!(scene.magnification > 100.0 && !scene.look.ghosts());
        // The plane stays in the measuring frame.
        workbench.execute(Command::Look(crate::gui::view::Plane::Xy));
        assert_eq!(workbench.base(), Isometry3::identity());
    }

    #[test]
    fn everything_is_in_sight_until_somebody_looks_closer() {
        let mut workbench = arm();
        workbench.execute(Command::Edit(Edit::Identify));
        workbench.receive();
        let rect = Rect::from_min_size(egui::pos2(20.0, 30.0), vec2(500.0, 320.0));
        for _ in 0..6 {
            let turned = workbench.view().camera.orbited([61.0, 17.0]);
            workbench.execute(Command::Turn(turned));
            let space = Space::new(&workbench, rect);
            let subject = workbench.subject();
            for sample in 0..subject.len() {
                let at = space.measured(Point3::from(subject.measured(sample)));
                assert!(rect.contains(at), "{at:?}");
            }
            assert!(rect.contains(space.screen([0.0; 3])));
        }
        let closer = workbench.view().camera.zoomed(20.0, [0.0; 2]);
        workbench.execute(Command::Turn(closer));
        workbench.execute(Command::FitWorkspace);
        assert_eq!(workbench.view().camera.zoom, 1.0);
    }

    #[test]
    fn a_posed_robot_stands_there_until_a_sample_is_chosen_or_the_robot_is_another() {
        let mut workbench = arm();
        let pose = vec![0.1, -0.2, 0.3, 0.0, 0.5, 0.0];
        workbench.execute(Command::Pose(Some(pose.clone())));
        let drawn = Drawn::of(&workbench).expect("a robot");
        assert!(drawn.q == pose && drawn.asked_for && drawn.real.is_none());
        assert!(
            drawn.says().starts_with("robot as posed"),
            "{}",
            drawn.says()
        );
        workbench.execute(Command::Select(Some(3)));
        assert_eq!(Drawn::of(&workbench).expect("a robot").sample, Some(3));
        workbench.execute(Command::Pose(Some(pose)));
        workbench.execute(Command::Pose(Some(vec![0.0])));
        assert_eq!(
            workbench.view().pose,
            None,
            "one value is no pose of six joints"
        );
    }

    #[test]
    fn a_slider_reaches_over_the_limits_or_what_was_measured() {
        let workbench = arm();
        let session = &workbench.subject().session;
        for (k, joint) in session.robot.joints.iter().enumerate() {
            let [low, high] = joints::range(&workbench, k);
            assert!(low < high);
            if let Some(limits) = joint.limits {
                assert_eq!([low, high], [limits.from, limits.to]);
            } else {
                let q = &session.samples.q[k];
                assert!(q.iter().all(|v| (low..=high).contains(v)));
            }
        }
    }
}
