//! The robot's meshes in space, shaded: every triangle in one shade by how it is turned to a light that
//! goes with the viewer, the farthest first, so that what is near covers what is far.

use egui::epaint::Mesh;
use egui::{Color32, Pos2, Shape};
use nalgebra::{Isometry3, Point3, Vector3};

use crate::gui::core::appearance::Appearance;
use crate::gui::style::tokens::Palette;
use crate::gui::view::Facing;

/// The light: from above and from the left, over the shoulder.
const LIGHT: [f64; 3] = [-0.35, 0.55, 0.76];
/// How much of the robot's colour a triangle has that is turned to the light, and one that is not, on a
/// surface that is lighter than that colour, and on one that is darker.
const ON_LIGHT: [f32; 2] = [0.16, 0.78];
const ON_DARK: [f32; 2] = [0.95, 0.28];

/// A triangle of the surface as it is seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Face {
    pub(super) corners: [Pos2; 3],
    pub(super) color: Color32,
}

/// The surface at a pose, the farthest first: `motions` are those from home, in the measuring frame.
pub(super) fn faces(
    appearance: &Appearance,
    motions: &[Isometry3<f64>],
    facing: &Facing,
    screen: impl Fn(Point3<f64>) -> Pos2,
    palette: &Palette,
    seen: f32,
) -> Vec<Face> {
    let [right, up, towards] = [facing.right, facing.up, facing.towards].map(Vector3::from);
    let light = right * LIGHT[0] + up * LIGHT[1] + towards * LIGHT[2];
    let bright =
        |color: Color32| u16::from(color.r()) + u16::from(color.g()) + u16::from(color.b());
    let on_light = bright(palette.surface) > bright(palette.nominal);
    let [lit, dark] = if on_light { ON_LIGHT } else { ON_DARK };
    let mut faces: Vec<(f64, Face)> = Vec::new();
    for (behind, triangles) in &appearance.parts {
        let Some(motion) = motions.get(*behind) else {
            continue;
        };
        faces.extend(triangles.iter().map(|triangle| {
            let corners = triangle.map(|p| motion * Point3::from(p.map(f64::from)));
            let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
            // Meshes do not agree on which side is outside.
            let turned = normal.dot(&light).abs() / normal.norm().max(f64::MIN_POSITIVE);
            let near: f64 = corners.iter().map(|p| p.coords.dot(&towards)).sum();
            #[allow(clippy::cast_possible_truncation, reason = "between 0 and 1")]
            let shade = dark + (lit - dark) * turned.min(1.0) as f32;
            let color = palette.surface.lerp_to_gamma(palette.nominal, shade * seen);
            let corners = corners.map(&screen);
            (near, Face { corners, color })
        }));
    }
    faces.retain(|(_, face)| face.corners.iter().all(|p| p.is_finite()));
    faces.sort_by(|a, b| a.0.total_cmp(&b.0));
    faces.into_iter().map(|(_, face)| face).collect()
}

/// The same on the screen.
pub(super) fn shape(faces: &[Face]) -> Shape {
    let mut mesh = Mesh::default();
    for face in faces {
        let first = u32::try_from(mesh.vertices.len()).unwrap_or(u32::MAX);
        for corner in face.corners {
            mesh.colored_vertex(corner, face.color);
        }
        mesh.add_triangle(first, first + 1, first + 2);
    }
    Shape::mesh(mesh)
}

#[cfg(test)]
#[test]
fn what_is_near_is_drawn_over_what_is_far_at_the_pose_of_its_link() {
    use crate::gui::core::appearance::Chain;
    use crate::gui::style::tokens::LIGHT as LIGHT_THEME;
    use crate::gui::view::Plane;
    let at = |z: f32| [[0.0, 0.0, z], [10.0, 0.0, z], [0.0, 10.0, z]];
    let appearance = Appearance {
        parts: vec![
            (1, vec![at(5.0)]),
            (0, vec![at(0.0), at(2.0)]),
            (7, vec![at(0.0)]),
        ],
        chain: Chain::default(),
    };
    let motions = [
        Isometry3::identity(),
        Isometry3::translation(100.0, 0.0, -20.0),
    ];
    let flat = |p: Point3<f64>| {
        #[allow(clippy::cast_possible_truncation, reason = "a few points")]
        egui::pos2(p.x as f32, p.z as f32)
    };
    let facing = Plane::Xy.facing();
    let faces = faces(&appearance, &motions, &facing, flat, &LIGHT_THEME, 1.0);
    let Shape::Mesh(mesh) = shape(&faces) else {
        panic!("no mesh");
    };
    let firsts: Vec<[f32; 2]> = mesh
        .vertices
        .iter()
        .step_by(3)
        .map(|v| [v.pos.x, v.pos.y])
        .collect();
    assert_eq!(
        firsts,
        [[100.0, -15.0], [0.0, 0.0], [0.0, 2.0]],
        "from far to near"
    );
    assert!(mesh.is_valid());
}
