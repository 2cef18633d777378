//! What the robot of a session looks like: the meshes of its URDF, placed at home.
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

use super::mesh::{self, Flaw, MOST_BYTES, MOST_TRIANGLES, Triangle};
use crate::diagnostic::{Diagnostic, Place, Rejected, unreadable};
use crate::kinematics::{Robot, Visual, robot_from_file, visuals_of_urdf};
use crate::sessions::files::open;
use crate::sessions::files::open::Refusal;

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
            return Err((text!("no package {package}", package = package), expected));
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

#[cfg(test)]
mod tests {
    use super::*;

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
}
