//! The view in space on the screen, with what the pointer does in it, and as a picture.

use crate::gui::scene::{SIZE, Screen, Sheet, paint};
use crate::gui::style::tokens::Palette;
use crate::gui::view::{Camera, Canvas};
use crate::gui::workbench::{Command, ViewChange, Workbench};
use crate::present::drawing::Drawing;
use crate::present::numbers::trimmed;
use egui::{Panel, Pos2, Role, Sense, Ui, WidgetInfo};

use super::super::model::Shown;
use super::super::notes::Notes;
use super::super::plot_size::tell_plot_size;
use super::super::pointer::{REACH, hover};
use super::super::robot::Drawn;
use super::super::{layout, legend, over};
use super::scene::{Space, scene};
use super::{joints, looking, pick};

/// A direction in space is drawn so much shorter on average.
const FORESHORTENED: f64 = std::f64::consts::FRAC_PI_4;

/// Width of the sliders that pose the robot, points.
const SLIDERS: f32 = 176.0;

/// Shows the view in the space that is left, and sends what the pointer does.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, posing: bool, commands: &mut Vec<Command>) {
    let palette = Palette::of(ui);
    let shown = Shown::of(workbench);
    let robot = Drawn::of(workbench);
    let notes = Notes::recall(ui, &shown);
    let scale = legend::show(
        ui,
        workbench,
        &shown,
        robot.as_ref(),
        &notes.lines,
        &palette,
    );
    if posing && let Some(robot) = &robot {
        Panel::right("joints of the robot")
            .resizable(false)
            .exact_size(SLIDERS)
            .frame(egui::Frame::NONE.inner_margin(egui::Margin::symmetric(8, 4)))
            .show(ui, |ui| joints::show(ui, workbench, &robot.q, commands));
    }
    let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
    let space = Space::new(workbench, rect);
    let camera = &space.camera;
    let whole = Camera {
        zoom: 1.0,
        ..workbench.view().camera
    };
    let size = [rect.width(), rect.height()].map(f64::from);
    let seen = FORESHORTENED * whole.points_per_mm(&space.ball, size);
    tell_plot_size(workbench, seen, commands);
    let mut inside = ui.new_child(egui::UiBuilder::new().max_rect(rect));
    let ui = &mut inside;
    ui.set_clip_rect(rect.intersect(ui.clip_rect()));
    let scene = scene(workbench, &shown, robot.as_ref(), &space);
    let mut shapes = Vec::new();
    let mut screen = Screen::new(ui.painter(), &palette, &mut shapes);
    paint(&scene, camera, &mut screen);
    ui.painter().extend(shapes);
    let about = (&shown, robot.as_ref());
    over::show(ui, workbench, about, camera, (notes, scale));
    let view = workbench.view();
    describe(&response, workbench);
    let pointer = response.hover_pos().filter(|_| !response.dragged());
    let under = pointer.and_then(|at| under(workbench, &shown, &space, at));
    hover(&response, workbench, under, commands);
    let turned = looking::looked(ui, &response, rect, &space.ball, view.camera);
    if response.double_clicked() {
        commands.push(Command::View(ViewChange::FitWorkspace));
    } else if turned != view.camera {
        commands.push(Command::View(ViewChange::Turn(turned)));
    }
}

/// How the view is called, and what it shows, for those who do not see it.
fn describe(response: &egui::Response, workbench: &Workbench) {
    let view = workbench.view();
    let samples = workbench.loaded_session().overview.usable.len();
    let camera = view.camera.describe();
    let name = match view.selected {
        Some(sample) => say!(
            "3-D view, {samples} samples, {camera}, sample {sample} selected",
            samples = samples,
            camera = camera,
            sample = sample + 1
        ),
        None => say!(
            "3-D view, {samples} samples, {camera}",
            samples = samples,
            camera = camera
        ),
    };
    response.widget_info(|| WidgetInfo::labeled(Role::Figure, true, name.clone()));
    let how =
        say!("arrow keys orbit, plus and minus zoom, Home fits; 0, 1, 3 and 7 are standard views");
    let ctx = &response.ctx;
    ctx.accesskit_node_builder(response.id, |node| node.set_description(how));
}

/// The sample that is drawn under the pointer.
fn under(workbench: &Workbench, shown: &Shown, space: &Space, at: Pos2) -> Option<usize> {
    let transform = space.camera.transform();
    let at = transform.value_from_position(at);
    let [points, _] = layout::counts(shown, transform);
    let scale = space.camera.points_per_mm();
    pick::under(
        workbench,
        shown,
        [at.x, at.y],
        scale,
        (f64::from(REACH), points),
    )
}

/// The view on a sheet, and what it shows.
///
/// # Errors
/// There is nothing to draw.
pub(crate) fn sheet(workbench: &Workbench) -> Result<(Drawing, String), String> {
    if workbench.loaded_session().is_empty() {
        return Err(say!("there are no samples to draw").to_owned());
    }
    let shown = Shown::on(workbench, Canvas::Shapes);
    let robot = Drawn::of(workbench);
    let space = Space::new(workbench, Sheet::frame(SIZE));
    let session = crate::report::document::clean(&workbench.loaded_session().session.name);
    let (samples, camera) = (shown.samples, workbench.view().camera.describe());
    let magnified = trimmed(shown.magnification, 3);
    let title = if shown.look.answered {
        say!(
            "{session}: {samples} samples, {camera}, deviations after magnified {magnified} times",
            session = session,
            samples = samples,
            camera = camera,
            magnified = magnified
        )
    } else {
        say!(
            "{session}: {samples} samples, {camera}, deviations before magnified {magnified} times",
            session = session,
            samples = samples,
            camera = camera,
            magnified = magnified
        )
    };
    let sheet = Sheet {
        title: title.clone(),
        axes: None,
        legend: legend::on_paper(workbench, &shown, robot.as_ref(), &space.camera),
        notes: shown.notes(),
    };
    let scene = scene(workbench, &shown, robot.as_ref(), &space);
    Ok((sheet.with(&scene, &space.camera), title))
}

#[cfg(test)]
mod tests {
    use egui::{Rect, vec2};
    use nalgebra::{Isometry3, Point3, Vector3};

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
        workbench.execute(Command::Edit(Edit::Identify));
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
        workbench.execute(Command::Edit(Edit::Identify));
        workbench.receive();
        assert!(far(&workbench) < 20.0, "{}", far(&workbench));
        // z of the base is up although the tracker leans.
        let up = workbench.base().rotation * Vector3::z();
        assert!(workbench.facing().flat(up.into())[0].abs() < 1e-9);
        // Vectors are as long as what is left can be read, and the frame's error is not drawn.
        let scene = Shown::of(&workbench);
        assert!(scene.magnification > 100.0 && !scene.look.ghosts());
        // The plane stays in the measuring frame.
        workbench.execute(Command::View(ViewChange::Look(crate::gui::view::Plane::Xy)));
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
            workbench.execute(Command::View(ViewChange::Turn(turned)));
            let space = Space::new(&workbench, rect);
            let loaded_session = workbench.loaded_session();
            for sample in 0..loaded_session.len() {
                let at = space.camera.at(loaded_session.measured(sample));
                assert!(rect.contains(at), "{at:?}");
            }
            assert!(rect.contains(space.camera.at(space.of_base([0.0; 3]))));
        }
        let closer = workbench.view().camera.zoomed(20.0, [0.0; 2]);
        workbench.execute(Command::View(ViewChange::Turn(closer)));
        workbench.execute(Command::View(ViewChange::FitWorkspace));
        assert_eq!(workbench.view().camera.zoom, 1.0);
    }

    #[test]
    fn a_posed_robot_stands_there_until_a_sample_is_chosen_or_the_robot_is_another() {
        let mut workbench = arm();
        let pose = vec![0.1, -0.2, 0.3, 0.0, 0.5, 0.0];
        workbench.execute(Command::View(ViewChange::Pose(Some(pose.clone()))));
        let drawn = Drawn::of(&workbench).expect("a robot");
        assert!(drawn.q == pose && drawn.asked_for && drawn.real.is_none());
        assert!(
            drawn.describe().starts_with("robot as posed"),
            "{}",
            drawn.describe()
        );
        workbench.execute(Command::View(ViewChange::Select(Some(3))));
        assert_eq!(Drawn::of(&workbench).expect("a robot").sample, Some(3));
        workbench.execute(Command::View(ViewChange::Pose(Some(pose))));
        workbench.execute(Command::View(ViewChange::Pose(Some(vec![0.0]))));
        assert_eq!(
            workbench.view().pose,
            None,
            "one value is no pose of six joints"
        );
    }

    #[test]
    fn a_slider_reaches_over_the_limits_or_what_was_measured() {
        let workbench = arm();
        let session = &workbench.loaded_session().session;
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
