//! The robot in a scene: links as rods and joints as drums about their axes, lit, what is near over what is far.
//! Rods and drums are as thick at any zoom: they are signs, not the machine; a robot that is drawn large has them
//! thicker, as far as a hand's breadth. The real robot is a line with a filled tool: form says what colour says.

use std::f64::consts::TAU;

use nalgebra::{Isometry3, Point3, Vector3};

use crate::gui::scene::paint::Camera;
use crate::gui::scene::{ColourToken, Form, Item, Mark, Place, Scene, Stroke, Tint};

use super::{Drawn, JointSymbol};

/// Width of a rod, and of its wall, points.
const ROD: [f32; 2] = [10.0, 1.25];
/// Radius and half the length of a drum, points; of a joint that slides half a side.
const DRUM: [f64; 2] = [8.5, 8.5];
const BLOCK: f64 = 8.0;
/// Below this part of its length an axis is looked along.
const END_ON: f32 = 0.35;
/// Half a side of the plate that the robot stands on, points.
const PLATE: f64 = 17.0;
/// Width of the real robot's line, points.
const LINE: f32 = 2.5;
/// How thick rods and drums become at most, and the part of the robot's length at which they begin to.
const THICKER: f64 = 2.2;
const SLENDER: f64 = 0.04;
/// A rod from its wall to its crest: how wide, as a part of the rod, and how much turned to the light.
const ROUND: [(f32, f32); 4] = [(1.0, 0.35), (0.72, 0.55), (0.46, 0.72), (0.2, 0.86)];
/// How much the ends of drums and their bodies are turned to the light.
const DRUM_LIT: [f32; 2] = [0.95, 0.4];
/// How much of the robot is seen that was not asked for.
const FAINT: f32 = 0.8;

/// Both robots, beneath what was measured. `base` is the base in the measuring
/// frame.
pub(crate) fn body(scene: &mut Scene, drawn: &Drawn, base: &Isometry3<f64>, camera: &Camera) {
    let points_per_mm = camera.points_per_mm();
    let pen = Pen {
        camera,
        mm: 1.0 / points_per_mm,
        thick: thick(drawn, points_per_mm),
        part: if drawn.asked_for { 1.0 } else { FAINT },
    };
    if let Some(stands) = drawn.corners_mm.first() {
        let sides = [Vector3::x(), Vector3::y()].map(|side| base.rotation * side * PLATE);
        let edge = Stroke::new(1.25, seen(drawn, ColourToken::Nominal));
        let plate = pen.face(*stands, sides, false);
        let fill = Some(ColourToken::Surface.into());
        scene.items.push(Item::Area(plate, fill, Some(edge)));
    }
    links_and_joints(scene, drawn, &pen);
    tool(scene, drawn);
    real(scene, drawn);
}

/// How many times as thick as their least rods and drums are.
fn thick(drawn: &Drawn, points_per_mm: f64) -> f64 {
    let corners = drawn.corners_mm.windows(2);
    let length_mm: f64 = corners.map(|pair| (pair[1] - pair[0]).norm()).sum();
    let times = SLENDER * length_mm * points_per_mm / f64::from(ROD[0]);
    // A robot without a size has them as they are.
    if times.is_finite() {
        times.clamp(1.0, THICKER)
    } else {
        1.0
    }
}

/// In full where the pose was asked for, or else paler.
fn seen(drawn: &Drawn, token: ColourToken) -> Tint {
    token.pale(if drawn.asked_for { 1.0 } else { FAINT })
}

fn place(p: &Point3<f64>) -> Place {
    Place::from(<[f64; 3]>::from(p.coords))
}

/// The open ring of the nominal robot's tool.
fn tool(scene: &mut Scene, drawn: &Drawn) {
    if let Some(tool) = drawn.corners_mm.last() {
        let edge = Stroke::new(1.5, seen(drawn, ColourToken::Nominal));
        scene.mark(Mark::filled(place(tool), Form::Disc, 5.5, ColourToken::Surface).edged(edge));
    }
}

/// The real robot, where this pose was asked for.
fn real(scene: &mut Scene, drawn: &Drawn) {
    let Some(real) = drawn.real.as_ref().filter(|_| drawn.asked_for) else {
        return;
    };
    let token = if real.identified {
        ColourToken::After
    } else {
        ColourToken::Before
    };
    let corners = real.corners_mm.iter().map(place).collect();
    scene
        .items
        .push(Item::Line(corners, Stroke::new(LINE, token)));
    if let Some(tool) = real.corners_mm.last() {
        scene.mark(Mark::filled(
            place(tool),
            Form::Disc,
            5.0,
            ColourToken::Surface,
        ));
        scene.mark(Mark::filled(place(tool), Form::Disc, 4.0, token));
    }
}

/// Rods and drums.
fn links_and_joints(scene: &mut Scene, drawn: &Drawn, pen: &Pen<'_>) {
    let [edge, ink] = [ColourToken::Nominal, ColourToken::Text].map(|token| seen(drawn, token));
    let nearness = |p: Point3<f64>| pen.camera.nearness(p.into());
    let mut pieces: Vec<(f64, Vec<Item>)> = Vec::new();
    for pair in drawn.corners_mm.windows(2) {
        if (pair[1] - pair[0]).norm() > 1e-6 {
            let middle = nalgebra::center(&pair[0], &pair[1]);
            pieces.push((nearness(middle), pen.rod(&pair[0], &pair[1], edge)));
        }
    }
    for sign in &drawn.signs {
        // An axis that is looked along is a point: its end is seen through the links over it.
        let along = pen.camera.direction(sign.axis);
        let above = if along.length() < END_ON {
            f64::INFINITY
        } else {
            nearness(sign.at_mm) + pen.thick * DRUM[0] * pen.mm
        };
        pieces.push((above, pen.joint(sign, Stroke::new(1.5, ink))));
    }
    pieces.sort_by(|a, b| a.0.total_cmp(&b.0));
    let pieces = pieces.into_iter().flat_map(|(_, piece)| piece);
    scene.items.extend(pieces);
}

/// What signs are drawn with.
struct Pen<'a> {
    camera: &'a Camera,
    /// A point of the picture, mm.
    mm: f64,
    /// How many times as thick as their least rods and drums are.
    thick: f64,
    /// How much of the robot is seen.
    part: f32,
}

impl Pen<'_> {
    /// A flat piece around a point with these half sides (or radii, where it is round), points.
    fn face(&self, at: Point3<f64>, sides: [Vector3<f64>; 2], round: bool) -> Vec<Place> {
        let corners: u8 = if round { 24 } else { 4 };
        let corner = |k: u8| {
            let (sin, cos) = (TAU * (f64::from(k) + 0.5) / f64::from(corners)).sin_cos();
            let out = if round { 1.0 } else { 2.0_f64.sqrt() };
            place(&(at + (sides[0] * cos + sides[1] * sin) * (out * self.mm)))
        };
        (0..corners).map(corner).collect()
    }

    /// A link from one corner to the next: round, lit from the front.
    fn rod(&self, from: &Point3<f64>, to: &Point3<f64>, wall: Tint) -> Vec<Item> {
        let ends = [from, to].map(place);
        let width = ROD[0] * crate::numeric::single(self.thick);
        let inner = width - 2.0 * ROD[1];
        let lit =
            ROUND.map(|(part, turned)| (part * inner, ColourToken::Lit(turned).pale(self.part)));
        let mut items = Vec::new();
        for (width, ink) in std::iter::once((width, wall)).chain(lit) {
            items.push(Item::Line(ends.to_vec(), Stroke::new(width, ink)));
            let round = |end| Item::Mark(Mark::filled(end, Form::Disc, 0.5 * width, ink));
            items.extend(ends.map(round));
        }
        items
    }

    /// A drum about an axis, or a block along it.
    fn joint(&self, sign: &JointSymbol, edge: Stroke) -> Vec<Item> {
        let axis = Vector3::from(sign.axis);
        let [radius, half] = if sign.turns { DRUM } else { [BLOCK; 2] };
        let [radius, half] = [radius, half].map(|points| self.thick * points);
        let aside = if axis.x.abs() < 0.9 {
            Vector3::x()
        } else {
            Vector3::y()
        };
        let across = axis.cross(&aside).normalize();
        let sides = [across * radius, axis.cross(&across) * radius];
        // The end that is farther first, the body over it, the nearer end over both.
        let way = if self.camera.nearness(sign.axis) < 0.0 {
            -axis
        } else {
            axis
        };
        let off = way * (half * self.mm);
        let near = sign.at_mm + off;
        let ends = [sign.at_mm - off, near].map(|end| self.face(end, sides, sign.turns));
        let area = |corners, turned: f32| {
            let fill = ColourToken::Lit(turned).pale(self.part);
            Item::Area(corners, Some(fill), Some(edge))
        };
        vec![
            area(ends.concat(), DRUM_LIT[1]),
            area(ends[1].clone(), DRUM_LIT[0]),
            Item::Mark(Mark::filled(place(&near), Form::Disc, 1.6, edge.colour)),
        ]
    }
}
