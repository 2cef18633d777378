//! What the links of a URDF chain look like: the files of their meshes, where each lies at home, and
//! behind how many joints.
//!
//! ```text
//! base_from_mesh(q) = motion_k(q) · base_from_link(0) · Trans(xyz) · Rz(yaw) Ry(pitch) Rx(roll)
//! ```
//!
//! `motion_k` is that of [`Robot::motions_from_home`](super::Robot::motions_from_home) behind k joints.
//! Metres of the file become mm. A link whose `<visual>` has a mesh that cannot be read by its ending
//! is taken by its `<collision>`, where that one can. Nothing is opened here but the URDF file.

use std::path::Path;

use super::pose::Pose;
use super::urdf;
use super::xml::{Document, ROOT, read_text};
use crate::diagnostic::{Diagnostic, Place, Rejected};

/// A mesh of a link.
#[derive(Debug, Clone, PartialEq)]
pub struct Visual {
    /// Joints of the chain before it.
    pub behind: usize,
    /// Where it lies at home, mm of the base frame.
    pub base_from_mesh: Pose,
    /// What a unit of its file stands for along each axis, mm.
    pub scale_mm: [f64; 3],
    /// Its file as the URDF names it.
    pub file: String,
    /// Where the URDF names it.
    pub place: Place,
}

/// The meshes of the links from `base` to `tip` of the URDF file at `path`; `reads` says whether a file
/// of this name can be read.
///
/// # Errors
/// As [`robot_from_urdf`](super::robot_from_urdf), and numbers of a mesh that are none.
pub fn visuals_of_urdf(
    path: &Path,
    base: &str,
    tip: &str,
    reads: impl Fn(&str) -> bool,
) -> Result<Vec<Visual>, Rejected> {
    let text = read_text(path).map_err(|(found, expected)| {
        Rejected::because(Diagnostic::error(Place::file(path), found, expected))
    })?;
    let document = Document::parse(&text, path)?;
    let tree = urdf::tree(&document, path)?;
    let links: Vec<usize> = document.children(ROOT, "link").collect();
    let mut all = Vec::new();
    for body in tree.at_home(base, tip)? {
        let of = |what: &str| meshes(&document, links[body.index], what);
        let seen = of("visual")?;
        let can_be_read = |meshes: &[Visual]| meshes.iter().all(|one| reads(&one.file));
        let meshes = if can_be_read(&seen) {
            seen
        } else {
            let solid = of("collision")?;
            let better = !solid.is_empty() && can_be_read(&solid);
            if better { solid } else { seen }
        };
        all.extend(meshes.into_iter().map(|mesh| Visual {
            behind: body.behind,
            base_from_mesh: body.base_from_body * mesh.base_from_mesh,
            ..mesh
        }));
    }
    Ok(all)
}

/// The meshes of a link, in its own frame.
fn meshes(document: &Document, link: usize, what: &str) -> Result<Vec<Visual>, Rejected> {
    let mut all = Vec::new();
    for part in document.children(link, what) {
        let shapes = document.children(part, "geometry");
        for mesh in shapes.flat_map(|geometry| document.children(geometry, "mesh")) {
            let scale = document.numbers::<3>(mesh, "scale")?.unwrap_or([1.0; 3]);
            all.push(Visual {
                behind: 0,
                base_from_mesh: urdf::origin(document, part)?,
                scale_mm: scale.map(|s| s * super::tree::MM_PER_M),
                file: document.required(mesh, "filename")?.to_owned(),
                place: document.place(mesh),
            });
        }
    }
    Ok(all)
}

#[cfg(test)]
#[test]
fn meshes_lie_where_their_links_are_and_collisions_stand_in() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("arm.urdf");
    let text = r#"<robot name="arm">
      <link name="base"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
      <link name="upper"><visual><origin xyz="0 0 0.1" rpy="0 0 1.5707963267948966"/>
        <geometry><mesh filename="upper.stl" scale="0.001 0.001 0.001"/></geometry></visual></link>
      <link name="tool"><visual><geometry><mesh filename="tool.dae"/></geometry></visual>
        <collision><geometry><mesh filename="tool.obj"/></geometry></collision></link>
      <link name="aside"><visual><geometry><mesh filename="aside.stl"/></geometry></visual></link>
      <joint name="j" type="revolute"><origin xyz="1 0 0"/><parent link="base"/><child link="upper"/>
        <axis xyz="0 0 1"/><limit lower="-1" upper="1"/></joint>
      <joint name="f" type="fixed"><origin xyz="0 2 0"/><parent link="upper"/><child link="tool"/></joint>
      <joint name="a" type="fixed"><parent link="base"/><child link="aside"/></joint></robot>"#;
    std::fs::write(&path, text).unwrap();
    let all = visuals_of_urdf(&path, "base", "tool", |file| file != "tool.dae").unwrap();
    let files: Vec<&str> = all.iter().map(|one| one.file.as_str()).collect();
    assert_eq!(files, ["upper.stl", "tool.obj"]);
    assert_eq!([all[0].behind, all[1].behind], [1, 1]);
    assert_eq!(all[0].scale_mm, [1.0; 3]);
    let at = all[0].base_from_mesh * nalgebra::Point3::new(10.0, 0.0, 0.0);
    assert!((at - nalgebra::Point3::new(1000.0, 10.0, 100.0)).norm() < 1e-9);
    let at = all[1].base_from_mesh.translation.vector;
    assert!((at - nalgebra::Vector3::new(1000.0, 2000.0, 0.0)).norm() < 1e-9);
}
