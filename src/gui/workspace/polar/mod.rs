//! A component of the deviation around the angle of the joint, as circles of a ballbar test are shown: the
//! nominal circle, and the deviation magnified along its radius. On the screen, with what the pointer does in
//! it, and as a picture.

pub(crate) mod model;
mod scene;

pub(super) use model::{Polar, scale};
pub(super) use scene::legend;

use std::cell::OnceCell;

use egui::{Pos2, Role, Ui, WidgetInfo, vec2};

use crate::gui::cache::charts::Envelope;
use crate::gui::core::scale::thinned;
use crate::gui::plots::{Drawing, gestures};
use crate::gui::scene::paint::paint;
use crate::gui::scene::paint::{Bearing, Camera, Projection};
use crate::gui::scene::screen::Screen;
use crate::gui::scene::sheet::Sheet;
use crate::gui::style::Palette;
use crate::gui::workbench::{Command, Workbench};
use crate::present::drawing;

use super::layout::nearest;
use super::model::dial;
use super::pointer::{REACH, hover};
use model::PolarSample;
use scene::{NOMINAL, bounds, places, scene};

/// Of so many near the pointer at most; more stand on one another.
const MOST_NEAR: usize = 400;
/// Width and height of the picture on paper, points.
const SQUARE: f32 = 360.0;

/// As the angle lies in the plane that is looked at.
fn bearing(workbench: &Workbench) -> Bearing {
    dial(workbench.loaded_session(), workbench.view().plane).map_or_else(
        || Bearing::of([1.0, 0.0], [0.0, 1.0]),
        |dial| Bearing::of(dial.radial, dial.tangential),
    )
}

/// Shows the view in the space that is left, and sends what the pointer does.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, polar: &Polar, commands: &mut Vec<Command>) {
    let palette = Palette::of(ui);
    let view = workbench.view();
    let name = view.component.name();
    let bearing = bearing(workbench);
    let id = ("polar", name, workbench.only_after(), view.fitted.workspace);
    let plot = gestures::plot(id)
        .data_aspect(1.0)
        .show_axes(false)
        .show_grid(false)
        .set_margin_fraction(egui::Vec2::splat(0.01));
    let drawn = OnceCell::new();
    let shown = gestures::show(ui, plot, |plot| {
        plot.add(Drawing::new(
            "polar",
            bounds(polar),
            |ui, transform, shapes| {
                let camera = Camera::new(Projection::Around(bearing, NOMINAL), transform);
                let scene = drawn.get_or_init(|| scene(workbench, polar, camera.points_per_mm()));
                paint(
                    scene,
                    &camera,
                    &mut Screen::new(ui.painter(), &palette, shapes),
                );
            },
        ));
    });
    let response = shown.response;
    let samples = workbench.loaded_session().overview.usable.len();
    response.widget_info(|| {
        let says = say!(
            "polar view, {component}, {samples} samples, {polar}",
            component = name,
            samples,
            polar = scale(polar, workbench.units())
        );
        WidgetInfo::labeled(Role::Figure, true, says)
    });
    let camera = Camera::new(Projection::Around(bearing, NOMINAL), &shown.transform);
    let under = response.hover_pos().and_then(|pointer| {
        let at = [pointer.x, pointer.y];
        match (workbench.around(), drawn.get()) {
            (Some(envelope), _) => {
                let near = near(envelope, polar, bearing, &camera, pointer);
                let all = near.into_iter().flat_map(|sample| {
                    let spot = spot(workbench, sample);
                    let places = places(polar, &spot, workbench.only_after());
                    places.into_iter().flatten().map(move |at| (sample, at))
                });
                let all = all.map(|(sample, at)| (sample, camera.at(at).into()));
                nearest(all, at, REACH)
            }
            (None, scene) => nearest(camera.samples(scene?), at, REACH),
        }
    });
    hover(&response, workbench, under, commands);
}

fn spot(workbench: &Workbench, sample: usize) -> PolarSample {
    let component = workbench.view().component;
    PolarSample::of(
        workbench.loaded_session(),
        workbench.answer(),
        component,
        sample,
    )
}

/// Samples at the angles around the pointer, on every turn.
fn near(
    envelope: &Envelope,
    polar: &Polar,
    bearing: Bearing,
    camera: &Camera,
    pointer: Pos2,
) -> Vec<usize> {
    let at = camera.transform().value_from_position(pointer);
    let distance = at.x.hypot(at.y).max(1e-6);
    let half = (f64::from(REACH) / camera.points_per_mm() / distance).min(0.5);
    let [low, high] = polar.range;
    let turn = std::f64::consts::TAU;
    let first = bearing.angle_of([at.x, at.y], low);
    let angles = (0..8_u8).map(move |k| first + turn * f64::from(k));
    let angles = angles.take_while(move |q| *q <= high + half);
    let near = move |q: f64| envelope.samples([q - half, q + half], MOST_NEAR);
    angles.flat_map(near).collect()
}

/// The view on a sheet, and what it shows.
///
/// # Errors
/// Why there is none, in words.
pub(crate) fn sheet(workbench: &Workbench) -> Result<(drawing::Drawing, String), String> {
    let polar = Polar::of(workbench)?;
    let around = Projection::Around(bearing(workbench), NOMINAL);
    let frame = Sheet::frame(vec2(SQUARE, SQUARE));
    let camera = Camera::showing(around, bounds(&polar), frame);
    let title = say!(
        "{component} deviation around the angle",
        component = polar.component.name()
    );
    let mut notes = vec![scale(&polar, workbench.units())];
    if workbench.around().is_some() {
        notes.push(say!("min–max at each angle").to_owned());
    } else {
        notes.extend(thinned(
            polar.stride,
            phrase!("one sample in {stride} shown"; stride),
        ));
    }
    let sheet = Sheet {
        title,
        axes: None,
        legend: legend(workbench, &polar),
        notes,
    };
    let scene = scene(workbench, &polar, camera.points_per_mm());
    let session = crate::report::document::clean(&workbench.loaded_session().session.name);
    let says = say!("{session}: the deviation around the angle", session);
    Ok((sheet.with(&scene, &camera), says))
}

#[cfg(test)]
mod tests {
    use crate::gui::core::edit::Edit;
    use crate::gui::scene::Item;
    use crate::gui::testing::workbench;
    use crate::gui::view::Plane;
    use crate::gui::workbench::ViewChange;
    use crate::present::drawing::Item as OnPaper;

    use super::*;

    #[test]
    fn the_scene_holds_every_sample_and_the_sheet_states_its_scale() {
        let mut workbench = workbench();
        workbench.execute(Command::Edit(Edit::Tolerance(Some(0.2))));
        workbench.execute(Command::View(ViewChange::Look(Plane::Xy)));
        let polar = Polar::of(&workbench).expect("it turns");
        let scene = scene(&workbench, &polar, 20.0);
        let marks = scene.items.iter().filter(|item| match item {
            Item::Mark(mark) => mark.sample.is_some(),
            _ => false,
        });
        assert_eq!(marks.count(), workbench.loaded_session().len());
        let (drawing, _) = sheet(&workbench).expect("it turns");
        let says = |part: &str| {
            let mut items = drawing.items.iter();
            items.any(|item| matches!(item, OnPaper::Text(label) if label.text.contains(part)))
        };
        assert!(says("1 division = ") && says("tolerance") && says("approach +"));
        for item in &drawing.items {
            let points: Vec<[f64; 2]> = match item {
                OnPaper::Lines(lines, _) => lines.concat(),
                OnPaper::Areas(areas) => areas.iter().flat_map(|(p, _)| p.clone()).collect(),
                _ => Vec::new(),
            };
            for p in points {
                let inside = (0.0..=drawing.width).contains(&p[0]);
                assert!(inside && (0.0..=drawing.height).contains(&p[1]), "{p:?}");
            }
        }
    }
}
