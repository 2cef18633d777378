//! What the robot of a session looks like: the meshes of its URDF, placed at home; without them strokes along its
//! axes.
//!
//! Meshes are found in the URDF's own folder or below it, and `package://x/…` in the folder x that
//! the URDF lies in or that lies beside one of the folders above it; no `..`, no absolute path, no
//! link that leads out. One that is missing, too large or damaged is a warning, and the robot is
//! drawn from its screws.
//!
//! A saved session names axes and no URDF. Where the one that it came from is remembered, its meshes are
//! drawn again as long as it still describes the robot of the session; where it does not, or is not
//! there, a note says so.

use std::io::Read as _;
use std::path::{Path, PathBuf};

use nalgebra::{Point3, Vector3};
use serde::{Deserialize, Serialize};

use crate::diagnostic::{Diagnostic, Place, Rejected, unreadable};
use crate::kinematics::{Axis, Robot, Visual, robot_from_file, visuals_of_urdf};
use crate::sessions::files::open::{self, Refusal};

use super::mesh::{self, Flaw, MOST_BYTES, MOST_TRIANGLES, Triangle};

/// Triangles that are drawn of a robot.
const DRAWN: usize = 24_000;
/// Folders above the URDF in which a package is looked for.
const FOLDERS_UP: usize = 6;
/// Meshes of one robot.
const MOST_MESHES: usize = 200;

/// The robot's surface, mm of the base frame at home.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Appearance {
    /// Triangles, each behind so many joints.
    pub(crate) parts: Vec<(usize, Vec<Triangle>)>,
    /// Whose meshes they are.
    pub(crate) chain: Chain,
}

/// The chain of a URDF file.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Chain {
    /// The file; in a session, as that names it.
    pub(crate) file: PathBuf,
    pub(crate) base: String,
    pub(crate) tip: String,
}

#[derive(Deserialize)]
struct AppearanceFile {
    robot: RobotOfDocument,
}

#[derive(Deserialize)]
struct RobotOfDocument {
    urdf: Option<Chain>,
}

/// What the robot of a chain looks like; why that is not known is a finding.
pub(crate) fn seen(chain: Option<Chain>, findings: &mut Vec<Diagnostic>) -> Option<Appearance> {
    match chain?.appearance()? {
        Ok(appearance) => Some(appearance),
        Err(finding) => {
            findings.push(*finding);
            None
        }
    }
}

/// What the robot of a session looks like whose chain is remembered from when it was saved. The user was not asked
/// for it now: that it is not known is a note.
pub(crate) fn seen_again(
    chain: &Chain,
    robot: &Robot,
    findings: &mut Vec<Diagnostic>,
) -> Option<Appearance> {
    let because = match robot_from_file(&chain.file, None, &chain.base, &chain.tip) {
        Err(rejected) => rejected.diagnostics.into_iter().next()?,
        Ok(described) if have_the_same_axes(&described.robot, robot) => match chain.appearance()? {
            Ok(appearance) => return Some(appearance),
            Err(because) => *because,
        },
        Ok(_) => {
            let found = text!("it describes another robot than when the session was saved");
            Diagnostic::note(Place::file(&chain.file), found)
        }
    };
    let found = text!(
        "{found}; the robot is drawn from its axes",
        found = because.found
    );
    findings.push(Diagnostic::note(because.place, found));
    None
}

/// Whether joints of two robots are of one kind and lie on one line.
fn have_the_same_axes(one: &Robot, other: &Robot) -> bool {
    /// Of unit directions, and mm: what writing and reading a session changes is far below.
    const CLOSE: [f64; 2] = [1e-6, 1e-3];
    one.joints.len() == other.joints.len()
        && one.joints.iter().zip(&other.joints).all(|(a, b)| {
            let off = b.axis.point_mm - a.axis.point_mm;
            a.kind == b.kind
                && (*a.axis.direction - *b.axis.direction).norm() < CLOSE[0]
                && off.cross(&a.axis.direction).norm() < CLOSE[1]
        })
}

impl Chain {
    /// The chain that the session at this path names, if it names one.
    pub(crate) fn of_session(path: &Path) -> Option<Self> {
        // The reader of sessions says what is wrong with it.
        let bytes = open::read_document(path).ok()?;
        let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
        let document: AppearanceFile = serde_json::from_slice(start).ok()?;
        let chain = document.robot.urdf?;
        let file = path.parent()?.join(&chain.file);
        Some(Self { file, ..chain })
    }

    /// What it looks like, or why that is not known; `None`: it has no meshes.
    pub(crate) fn appearance(&self) -> Option<Result<Appearance, Box<Diagnostic>>> {
        let read = visuals_of_urdf(&self.file, &self.base, &self.tip, mesh::can_be_read);
        match read {
            // The robot itself was read from it.
            Err(Rejected { diagnostics }) => Some(Err(Box::new(diagnostics.into_iter().next()?))),
            Ok(visuals) if visuals.is_empty() => None,
            Ok(visuals) => Some(self.placed(&visuals)),
        }
    }

    fn placed(&self, visuals: &[Visual]) -> Result<Appearance, Box<Diagnostic>> {
        if let Some(one) = visuals.get(MOST_MESHES) {
            let found = text!("{visuals} meshes", visuals = visuals.len());
            let expected = text!("at most {most} of a robot", most = MOST_MESHES);
            let finding = Diagnostic::warning(one.place.clone(), found, expected);
            return Err(Box::new(finding));
        }
        let mut parts = Vec::new();
        let mut count = 0;
        for visual in visuals {
            let triangles = self.read(visual)?;
            count += triangles.len();
            if count > MOST_TRIANGLES {
                let found = text!(
                    "meshes of more than {most} triangles",
                    most = MOST_TRIANGLES
                );
                let expected = text!("fewer in all meshes of a robot");
                let finding = Diagnostic::warning(visual.place.clone(), found, expected);
                return Err(Box::new(finding));
            }
            parts.push((visual, triangles));
        }
        let part = |(visual, triangles): (&Visual, Vec<Triangle>)| {
            let share = DRAWN * triangles.len() / count.max(1);
            let triangles = mesh::thinned(triangles, share.max(200));
            (
                visual.behind,
                triangles.iter().map(|t| placed(visual, t)).collect(),
            )
        };
        let parts = parts.into_iter().map(part).collect();
        Ok(Appearance {
            parts,
            chain: self.clone(),
        })
    }

    fn read(&self, visual: &Visual) -> Result<Vec<Triangle>, Box<Diagnostic>> {
        let warn = |place: Place, (found, expected): Refusal| {
            Box::new(Diagnostic::warning(place, found, expected))
        };
        let path = self.path_of(&visual.file);
        let path = path.map_err(|refusal| warn(visual.place.clone(), refusal))?;
        let place = Place::file(&path);
        let bytes = bytes_of(&path).map_err(|refusal| warn(place.clone(), refusal))?;
        mesh::read(&visual.file, &bytes).map_err(|flaw: Flaw| {
            let place = match flaw.line {
                Some(line) => place.clone().at_line(line),
                None => place.clone(),
            };
            warn(place, (flaw.found, flaw.expected))
        })
    }

    /// Where the file of a mesh is.
    fn path_of(&self, name: &str) -> Result<PathBuf, Refusal> {
        let folder = self.file.parent().filter(|f| !f.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new("."));
        let Some(rest) = name.strip_prefix("package://") else {
            return open::samples_path(folder, name).map_err(of_a_mesh);
        };
        let (package, rest) = rest.split_once('/').unwrap_or((rest, ""));
        let plain = !package.is_empty() && !package.contains(['\\', ':', '\0']) && package != "..";
        let up = std::path::absolute(folder).unwrap_or_default();
        let mut above = up.ancestors().take(FOLDERS_UP);
        let found = above.find_map(|folder| {
            let is_this = folder.file_name().is_some_and(|own| own == package);
            let inside = folder.join(package);
            if is_this {
                Some(folder.to_path_buf())
            } else {
                inside.is_dir().then_some(inside)
            }
        });
        let Some(found) = found.filter(|_| plain && package != ".") else {
            let expected = text!("a folder with the name of the package above the URDF file");
            return Err((text!("no package {package}", package), expected));
        };
        open::samples_path(&found, rest).map_err(of_a_mesh)
    }
}

fn of_a_mesh((found, _): Refusal) -> Refusal {
    let expected = text!("a mesh in the URDF's own folder or below it, or in that of its package");
    (found, expected)
}

fn bytes_of(path: &Path) -> Result<Vec<u8>, Refusal> {
    let (file, length) = open::open_regular(path)?;
    if length > MOST_BYTES {
        let expected = text!("a mesh of at most {value} MiB", value = MOST_BYTES >> 20);
        return Err((
            text!(one "{count} byte", "{count} bytes", count = length),
            expected,
        ));
    }
    let mut bytes = Vec::new();
    file.take(MOST_BYTES)
        .read_to_end(&mut bytes)
        .map_err(|error| (unreadable(&error), text!("a file that can be read")))?;
    Ok(bytes)
}

/// A triangle of a file where it lies at home, mm of the base frame.
fn placed(visual: &Visual, triangle: &Triangle) -> Triangle {
    triangle.map(|corner| {
        let scaled: Vector3<f64> =
            Vector3::from_fn(|k, _| f64::from(corner[k]) * visual.scale_mm[k]);
        let at = visual.base_from_mesh * Point3::from(scaled);
        #[allow(clippy::cast_possible_truncation, reason = "drawn in single precision")]
        let at = at.coords.map(|v| v as f32);
        at.into()
    })
}

/// Axes that enclose less than this (its sine) have no common perpendicular worth drawing.
const PARALLEL: f64 = 0.02;

/// A corner of the chain at home, and how many joints move it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Node {
    at_home: Point3<f64>,
    joints: usize,
}

/// The robot at one pose as strokes from base to tool, mm of the base frame.
///
/// A chain of axes has no links of its own, so that they are drawn where the axes put them: along
/// an axis, and from one to the next on their common perpendicular,
///
/// ```text
/// base → a₁ … b₁ → a₂ … b₂ → … → tool,   aᵢ, bᵢ on axis i,
/// ```
///
/// aᵢ nearest to what comes before, bᵢ nearest to what comes after; both are moved from home by
/// the product of exponentials ([`Robot::motions_from_home`]). For a column that is its mast and
/// its arm.
///
/// The corners from base to tool: base, two on each axis, tool.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Skeleton<'a> {
    robot: &'a Robot,
    nodes: Vec<Node>,
}

impl<'a> Skeleton<'a> {
    /// The chain of a robot up to a point of its tool, mm of the tool frame.
    pub(crate) fn new(robot: &'a Robot, target_mm: &Point3<f64>) -> Self {
        let tool = robot.base_from_tool * target_mm;
        let base = Point3::origin();
        let axes: Vec<&Axis> = robot.joints.iter().map(|joint| &joint.axis).collect();
        let mut nodes = vec![Node {
            at_home: base,
            joints: 0,
        }];
        let mut last = base;
        let mut enters = axes.first().map(|axis| on_axis(axis, &base));
        for (k, axis) in axes.iter().enumerate() {
            let enter = enters.unwrap_or_else(|| on_axis(axis, &last));
            let (leave, next) = match axes.get(k + 1) {
                None => (on_axis(axis, &tool), None),
                Some(next) => match nearest(axis, next) {
                    Some((here, there)) => (here, Some(there)),
                    None => (enter, Some(on_axis(next, &enter))),
                },
            };
            nodes.push(Node {
                at_home: enter,
                joints: k,
            });
            nodes.push(Node {
                at_home: leave,
                joints: k + 1,
            });
            (last, enters) = (leave, next);
        }
        nodes.push(Node {
            at_home: tool,
            joints: axes.len(),
        });
        Self { robot, nodes }
    }

    /// Where the corners are at a pose, mm of the base frame; `None` where the pose is not one.
    pub(crate) fn at(&self, q: &[f64]) -> Option<Vec<Point3<f64>>> {
        if q.len() != self.robot.joints.len() || !q.iter().all(|v| v.is_finite()) {
            return None;
        }
        let motions = self.robot.motions_from_home(q);
        let moved = self.nodes.iter();
        Some(moved.map(|n| motions[n.joints] * n.at_home).collect())
    }
}

/// The point of an axis that is nearest to a point.
fn on_axis(axis: &Axis, to: &Point3<f64>) -> Point3<f64> {
    let along = axis.direction.into_inner();
    axis.point_mm + along * along.dot(&(to - axis.point_mm))
}

/// The points of two axes that are nearest to each other; `None` where they are parallel.
fn nearest(a: &Axis, b: &Axis) -> Option<(Point3<f64>, Point3<f64>)> {
    let (u, v) = (a.direction.into_inner(), b.direction.into_inner());
    let cosine = u.dot(&v);
    let squared_sine = 1.0 - cosine * cosine;
    if squared_sine < PARALLEL * PARALLEL {
        return None;
    }
    let between = b.point_mm - a.point_mm;
    let (p, r) = (u.dot(&between), v.dot(&between));
    let s = (p - cosine * r) / squared_sine;
    let t = (cosine * p - r) / squared_sine;
    Some((a.point_mm + u * s, b.point_mm + v * t))
}

/// Smallest and largest corner of the robot at some of these poses, mm.
pub(crate) fn robot_extent<'q>(
    robot: &Robot,
    poses: impl Iterator<Item = Vec<f64>> + 'q,
) -> [[f64; 3]; 2] {
    let skeleton = Skeleton::new(robot, &Point3::origin());
    let mut ends = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for corner in poses.filter_map(|q| skeleton.at(&q)).flatten() {
        for k in 0..3 {
            ends[0][k] = ends[0][k].min(corner[k]);
            ends[1][k] = ends[1][k].max(corner[k]);
        }
    }
    ends
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::testing::workbench;
    use crate::kinematics::{Joint, JointKind, Pose};
    use nalgebra::Vector3;

    const URDF: &str = r#"<robot name="arm"><link name="base"/><link name="arm"><visual>
        <origin xyz="0 0 1"/><geometry><mesh filename="FILE"/></geometry></visual></link>
        <joint name="j" type="continuous"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/></joint>
        </robot>"#;
    const MESH: &str = "v 0 0 0\nv 0.1 0 0\nv 0 0.2 0\nf 1 2 3\n";

    /// The chain of a URDF in a folder of a package, whose mesh has this name.
    fn chain(root: &Path, mesh: &str) -> Chain {
        let folder = root.join("my_arm/urdf");
        for folder in [
            &folder,
            &root.join("my_arm/meshes"),
            &root.join("other_arm"),
        ] {
            std::fs::create_dir_all(folder).unwrap();
        }
        let file = folder.join("arm.urdf");
        std::fs::write(&file, URDF.replace("FILE", mesh)).unwrap();
        for path in [
            "my_arm/urdf/a.obj",
            "my_arm/meshes/a.obj",
            "other_arm/a.obj",
            "a.obj",
        ] {
            std::fs::write(root.join(path), MESH).unwrap();
        }
        Chain {
            file,
            base: "base".to_owned(),
            tip: "arm".to_owned(),
        }
    }

    #[test]
    fn meshes_are_found_beside_the_urdf_and_in_its_package() {
        let root = tempfile::tempdir().unwrap();
        for mesh in [
            "a.obj",
            "package://my_arm/meshes/a.obj",
            "package://other_arm/a.obj",
        ] {
            let found = chain(root.path(), mesh).appearance().unwrap();
            let parts = found.unwrap().parts;
            let triangle = [
                [0.0, 0.0, 1000.0],
                [100.0, 0.0, 1000.0],
                [0.0, 200.0, 1000.0],
            ];
            assert_eq!(parts, [(1, vec![triangle])], "{mesh}");
        }
    }

    #[test]
    fn meshes_elsewhere_are_refused_and_nothing_of_them_is_said() {
        let root = tempfile::tempdir().unwrap();
        std::fs::write(root.path().join("secret.obj"), "v secret\n").unwrap();
        let absolute = root.path().join("a.obj").display().to_string();
        for (mesh, says) in [
            ("../meshes/a.obj", "leads upwards"),
            (&*absolute, "an absolute path"),
            (&format!("file://{absolute}"), "no such file"),
            ("package://my_arm/../a.obj", "leads upwards"),
            ("package://../a.obj", "no package .."),
            ("package://./a.obj", "no package ."),
            ("package:///a.obj", "no package "),
            ("package://nowhere/a.obj", "no package nowhere"),
            ("b.obj", "no such file"),
            ("arm.urdf", "another kind of file"),
        ] {
            let refused = chain(root.path(), mesh).appearance().unwrap().unwrap_err();
            assert!(refused.to_string().contains(says), "{mesh}: {refused}");
            assert_eq!(refused.severity, crate::diagnostic::Severity::Warning);
        }
        #[cfg(unix)]
        {
            let chain = chain(root.path(), "link.obj");
            let link = root.path().join("my_arm/urdf/link.obj");
            std::os::unix::fs::symlink(root.path().join("secret.obj"), link).unwrap();
            let refused = chain.appearance().unwrap().unwrap_err().to_string();
            assert!(refused.contains("a link that leaves"), "{refused}");
        }
    }

    #[test]
    fn a_session_names_its_chain_and_a_robot_without_meshes_has_no_appearance() {
        let root = tempfile::tempdir().unwrap();
        let known = chain(root.path(), "a.obj");
        let path = root.path().join("session.json");
        let text = r#"{"robot": {"name": "x", "urdf": {"file": "my_arm/urdf/arm.urdf", "base": "base", "tip": "arm"}}}"#;
        std::fs::write(&path, text).unwrap();
        assert_eq!(Chain::of_session(&path), Some(known.clone()));
        std::fs::write(&path, r#"{"robot": {"name": "x", "joints": []}}"#).unwrap();
        assert_eq!(Chain::of_session(&path), None);
        let bare = std::fs::read_to_string(&known.file).unwrap();
        std::fs::write(
            &known.file,
            bare.replace("mesh filename=\"a.obj\"", "sphere"),
        )
        .unwrap();
        assert_eq!(known.appearance(), None);
    }

    /// An arm with six joints: base, shoulder, elbow and a wrist whose axes meet.
    fn arm() -> Robot {
        let joint = |name: &str, along: [f64; 3], at: [f64; 3]| {
            let axis = Axis::through(Vector3::from(along), Point3::from(at)).expect("an axis");
            Joint::new(name, JointKind::Revolute, axis)
        };
        Robot {
            name: "arm".to_owned(),
            joints: vec![
                joint("base", [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]),
                joint("shoulder", [0.0, 1.0, 0.0], [150.0, 0.0, 450.0]),
                joint("elbow", [0.0, 1.0, 0.0], [150.0, 0.0, 1050.0]),
                joint("roll", [1.0, 0.0, 0.0], [150.0, 0.0, 1150.0]),
                joint("pitch", [0.0, 1.0, 0.0], [800.0, 0.0, 1150.0]),
                joint("flange", [1.0, 0.0, 0.0], [800.0, 0.0, 1150.0]),
            ],
            base_from_tool: Pose::translation(900.0, 0.0, 1150.0),
            gravity_m_s2: None,
            source: crate::kinematics::RobotSource::Axes,
        }
    }

    #[test]
    fn a_column_is_a_mast_and_an_arm() {
        let workbench = workbench();
        let robot = &workbench.loaded_session().session.robot;
        let corners = Skeleton::new(robot, &Point3::origin()).at(&[0.0]);
        let expected = [
            [0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0],
            [0.0, 0.0, 300.0],
            [250.0, 0.0, 300.0],
        ];
        let corners = corners.expect("a pose");
        for (corner, expected) in corners.iter().zip(expected) {
            assert!(
                (corner - Point3::from(expected)).norm() < 1e-9,
                "{corners:?}"
            );
        }
    }

    #[test]
    fn the_chain_of_an_arm_ends_where_its_kinematics_say_and_links_keep_their_lengths() {
        let robot = arm();
        let target = Point3::new(10.0, 20.0, 30.0);
        let skeleton = Skeleton::new(&robot, &target);
        let lengths = |corners: &[Point3<f64>]| -> Vec<f64> {
            corners.windows(2).map(|p| (p[1] - p[0]).norm()).collect()
        };
        let home = lengths(&skeleton.at(&[0.0; 6]).expect("a pose"));
        assert!(home.iter().sum::<f64>() < 3_000.0, "{home:?}");
        for q in [
            [0.3, -0.4, 0.5, -0.6, 0.7, -0.8],
            [2.0, 0.1, -1.2, 3.0, 1.0, 0.2],
        ] {
            let corners = skeleton.at(&q).expect("a pose");
            assert_eq!(corners.len(), 2 * 6 + 2);
            let tool = robot.point_in_base(&q, &target);
            assert!((corners[13] - tool).norm() < 1e-9);
            for (here, at_home) in lengths(&corners).iter().zip(&home) {
                assert!((here - at_home).abs() < 1e-9, "a rigid link");
            }
        }
    }

    #[test]
    fn a_joint_that_slides_draws_its_way() {
        let axis = Axis::through(Vector3::x(), Point3::origin()).expect("an axis");
        let robot = Robot {
            joints: vec![Joint::new("rail", JointKind::Prismatic, axis)],
            ..arm()
        };
        let corners = Skeleton::new(&robot, &Point3::origin()).at(&[500.0]);
        let corners = corners.expect("a pose");
        let tool = corners.last().expect("a tool");
        assert!((tool - Point3::new(1400.0, 0.0, 1150.0)).norm() < 1e-9);
    }

    #[test]
    fn what_is_no_pose_draws_no_robot() {
        let robot = arm();
        let skeleton = Skeleton::new(&robot, &Point3::origin());
        assert_eq!(skeleton.at(&[0.0; 5]), None);
        assert_eq!(skeleton.at(&[0.0, 0.0, f64::NAN, 0.0, 0.0, 0.0]), None);
    }
}
