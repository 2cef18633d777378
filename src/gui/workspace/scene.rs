//! What is seen of samples in a plane and in space: the heat map, the nominal path, error vectors,
//! measured points and what stands out.

use std::sync::Arc;

use crate::gui::cache::cloud::Cloud;
use crate::gui::layers::{LayerOptions, WEDGE, WIDTH};
use crate::gui::scene::paint::Camera;
use crate::gui::scene::{
    ColourToken, Form, Item, Label, Layer, Mark, Place, Samples, Scene, Stroke, Tint,
};
use crate::gui::style::size;
use crate::gui::view::Colouring;
use crate::gui::workbench::Workbench;
use crate::numeric::single;
use crate::sessions::Region;

use super::layout::{self, HANDLE, SECTOR};
use super::model::{Dial, Shown, VisibleSample, shown};
use super::pointer::marked;
use super::robot::{Drawn, body};

/// Width of a path where its colour says how sure the model is, points …
const BAND: f32 = 7.0;
/// … and that of the square of a pose that was not measured.
pub(super) const SQUARE: f32 = 5.0;
/// Names of regions stand so far from the axis, in parts of the farthest reflector's distance.
const NAMES: f64 = 0.42;

/// The workspace in a plane.
pub(super) fn plane(
    workbench: &Workbench,
    shown: &Shown,
    robot: Option<&Drawn>,
    editing: bool,
    camera: &Camera,
) -> Scene {
    let mut scene = Scene::default();
    let regions = &workbench.document().regions;
    if let Some(dial) = &shown.dial {
        sectors(&mut scene, shown, dial, regions, editing);
    }
    heat(&mut scene, workbench, shown);
    path(&mut scene, shown);
    if let Some(robot) = robot {
        body::body(&mut scene, robot, &workbench.base(), camera);
    }
    samples(&mut scene, workbench, shown, camera);
    emphasised(&mut scene, workbench, shown);
    if let Some(dial) = &shown.dial {
        names_of_regions(&mut scene, shown, dial, regions, camera);
    }
    scene
}

fn sectors(scene: &mut Scene, shown: &Shown, dial: &Dial, regions: &[Region], editing: bool) {
    let raised = |p: [f64; 2]| shown.look.facing.raised(p);
    let mut order: Vec<usize> = (0..regions.len()).collect();
    order.sort_by(|a, b| regions[*a].from_rad.total_cmp(&regions[*b].from_rad));
    // All of them together, without soft edges: neighbouring pieces leave no seams.
    let mut triangles = Vec::new();
    for (place, region) in order.into_iter().map(|k| &regions[k]).enumerate() {
        let ink = Tint::from(ColourToken::Sector(place));
        for corners in layout::sector(dial, region.from_rad, region.to_rad) {
            let [a, b, c, d] = corners.map(|p| raised(p).map(single));
            triangles.extend([([a, b, c], ink), ([a, c, d], ink)]);
        }
    }
    scene.items.push(Item::Triangles(triangles));
    let (end, stroke) = if editing {
        (HANDLE, Stroke::new(1.5, ColourToken::Accent))
    } else {
        (SECTOR.1, Stroke::new(1.0, ColourToken::Line))
    };
    for region in regions {
        for angle in [region.from_rad, region.to_rad] {
            let at = |part: f64| raised(dial.at(angle, part * dial.radius_mm));
            scene.line([SECTOR.0, end].map(at), stroke);
        }
    }
}

/// The heat map, if it is shown.
fn heat(scene: &mut Scene, workbench: &Workbench, shown: &Shown) {
    let Some(heat) = workbench.heat() else {
        return;
    };
    // The map is of lengths, whatever the colour of vectors says.
    let look = LayerOptions {
        colouring: Colouring::Deviation,
        ..shown.look
    };
    scene
        .items
        .push(Item::Layer(Layer::Heat(Arc::clone(heat), look)));
}

/// The way of each reflector on the nominal robot, with how sure the model is of it.
pub(super) fn path(scene: &mut Scene, shown: &Shown) {
    let sure = |part: f32| ColourToken::Scale(Colouring::Uncertainty, part);
    for (at, part) in &shown.over {
        let square = Mark::filled(*at, Form::Square, 0.5 * SQUARE, sure(*part));
        scene.mark(square);
    }
    for (k, path) in shown.paths_mm.iter().enumerate() {
        let parts = shown.sure.get(k).map_or(&[][..], Vec::as_slice);
        for (pair, part) in path.windows(2).zip(parts) {
            scene.line([pair[0], pair[1]], Stroke::new(BAND, sure(*part)));
        }
        let points = path.iter().map(|p| Place::from(*p)).collect();
        let stroke = Stroke::new(1.25, ColourToken::Nominal);
        scene.items.push(Item::Line(points, stroke));
    }
    if let Some(dial) = &shown.dial {
        let centre = Place::from(shown.look.facing.raised(dial.centre_mm));
        let stroke = Stroke::new(1.5, ColourToken::Nominal);
        for [x, y] in [[6.0, 0.0], [0.0, 6.0]] {
            let ends = vec![centre.shifted(-x, -y), centre.shifted(x, y)];
            scene.items.push(Item::Line(ends, stroke));
        }
        scene.mark(Mark::ring(centre, Form::Disc, 3.5, stroke));
    }
}

/// Measured points and error vectors.
pub(super) fn samples(scene: &mut Scene, workbench: &Workbench, shown: &Shown, camera: &Camera) {
    let layer = Layer::Samples(Samples {
        cloud: Cloud::of(workbench.loaded_session()),
        remainder: workbench.remainder(),
        look: shown.look,
        counts: layout::counts(shown, camera.transform()),
    });
    scene.items.push(Item::Layer(layer));
    if let Some(some) = &shown.vectors {
        vectors(scene, shown, some);
    }
}

/// The vectors of some samples, one by one.
fn vectors(scene: &mut Scene, shown: &Shown, all: &[VisibleSample]) {
    let ends = |one: &VisibleSample, v: [f64; 3]| {
        let (from, m) = (one.simulated_mm(v), shown.magnification);
        [from, [0, 1, 2].map(|k| from[k] + m * v[k])].map(Place::from)
    };
    let ghost = ColourToken::Before.clear(0.38);
    let flat = if shown.look.answered {
        ColourToken::After
    } else {
        ColourToken::Before
    };
    let colouring = shown.look.colouring;
    for one in all {
        if let Some(before) = one.before_mm {
            let stroke = Stroke::new(1.0, ghost);
            scene.items.push(Item::Vector(ends(one, before), stroke));
        }
    }
    for one in all {
        let stroke = match one.shade {
            Some(part) => {
                let wedge = WEDGE[0] + part * (WEDGE[1] - WEDGE[0]);
                let width = if colouring.by_width() { wedge } else { WIDTH };
                Stroke::new(width, ColourToken::Scale(colouring, part))
            }
            None if colouring.by_width() => Stroke::new(WIDTH, ghost),
            None => Stroke::new(WIDTH, flat),
        };
        let vector = Item::Vector(ends(one, one.vector_mm), stroke);
        scene.items.push(vector);
    }
}

/// The samples that a finding is about, and the one under the pointer or else the chosen one.
pub(super) fn emphasised(scene: &mut Scene, workbench: &Workbench, all: &Shown) {
    let (view, loaded_session) = (&workbench.view, workbench.loaded_session());
    let measured =
        |sample: usize| loaded_session.usable[sample].then(|| loaded_session.measured(sample));
    let ring = |scene: &mut Scene, at: [f64; 3]| {
        let edge = Stroke::new(2.5, ColourToken::Accent);
        scene.mark(Mark::ring(at, Form::Disc, 9.0, edge));
    };
    for at in marked(view, loaded_session.len()).filter_map(measured) {
        ring(scene, at);
    }
    let Some(sample) = view.hovered.or(view.selected) else {
        return;
    };
    if let Some(at) = measured(sample) {
        // Its vector over all others, whatever their colour.
        let e = shown(workbench, sample);
        let m = all.magnification;
        let from = [0, 1, 2].map(|k| at[k] - e[k]);
        let to = [0, 1, 2].map(|k| from[k] + m * e[k]);
        let ends = [from, to].map(Place::from);
        for (width, token) in [
            (2.0 * WIDTH + 2.0, ColourToken::Surface),
            (2.0 * WIDTH, ColourToken::Accent),
        ] {
            let stroke = Stroke::new(width, token);
            scene.items.push(Item::Vector(ends, stroke));
        }
        ring(scene, at);
    }
}

fn names_of_regions(
    scene: &mut Scene,
    shown: &Shown,
    dial: &Dial,
    regions: &[Region],
    camera: &Camera,
) {
    let at = |q: f64| {
        let p = dial.at(q, NAMES * dial.radius_mm);
        shown.look.facing.raised(p)
    };
    for region in regions {
        let middle = at(0.5 * (region.from_rad + region.to_rad));
        // As wide as the sector is there.
        let room = if region.to_rad - region.from_rad < std::f64::consts::PI {
            let [from, to] = [region.from_rad, region.to_rad].map(|q| camera.at(at(q)));
            from.distance(to)
        } else {
            let centre = shown.look.facing.raised(dial.centre_mm);
            2.0 * camera.at(middle).distance(camera.at(centre))
        };
        scene.label(Label {
            size: size::BODY,
            bold: true,
            most: Some(room.max(24.0)),
            ..Label::new(middle, &region.name, ColourToken::Muted)
        });
    }
}
