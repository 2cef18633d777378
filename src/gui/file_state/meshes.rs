//! From which URDF the robot of a saved session is drawn: kept with the settings, since a session names
//! the axes of its robot and no file of meshes.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::gui::core::appearance::Chain;

/// Sessions that are remembered.
const MOST: usize = 500;

/// A saved session and whose meshes it is drawn from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct DrawnFrom {
    session: PathBuf,
    /// Its file is named as seen from the folder of the session where it lies in there.
    chain: Chain,
}

impl DrawnFrom {
    pub(crate) fn new(session: &Path, chain: &Chain) -> Self {
        let session = absolute(session);
        let file = absolute(&chain.file);
        let folder = session.parent();
        let below = folder.and_then(|folder| file.strip_prefix(folder).ok());
        let chain = Chain {
            file: below.map_or(file.clone(), Path::to_path_buf),
            ..chain.clone()
        };
        Self { session, chain }
    }
}

fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf())
}

/// The list with this one in front, in place of what it said of the same session.
pub(crate) fn remember(list: &mut Vec<DrawnFrom>, one: DrawnFrom) {
    list.retain(|other| other.session != one.session);
    list.insert(0, one);
    list.truncate(MOST);
}

/// Whose meshes a session is drawn from, as far as that is remembered.
pub(crate) fn remembered(list: &[DrawnFrom], session: &Path) -> Option<Chain> {
    let session = absolute(session);
    let one = list.iter().find(|one| one.session == session)?;
    Some(Chain {
        file: session.parent()?.join(&one.chain.file),
        ..one.chain.clone()
    })
}

#[cfg(test)]
#[test]
fn a_session_has_its_last_chain_back_and_another_has_none() {
    let chain = |file: &str| Chain {
        file: absolute(Path::new(file)),
        base: "base".to_owned(),
        tip: "tip".to_owned(),
    };
    let mut list = Vec::new();
    for (session, file) in [
        ("/a/one.json", "/b/old.urdf"),
        ("/a/two.json", "/b/arm.urdf"),
        ("/a/one.json", "/a/urdf/arm.urdf"),
    ] {
        remember(&mut list, DrawnFrom::new(Path::new(session), &chain(file)));
    }
    assert_eq!(list.len(), 2);
    let of = |session: &str| remembered(&list, Path::new(session));
    assert_eq!(of("/a/one.json"), Some(chain("/a/urdf/arm.urdf")));
    assert_eq!(of("/a/two.json"), Some(chain("/b/arm.urdf")));
    assert_eq!(of("/b/one.json"), None);
    assert_eq!(list[0].chain.file, Path::new("urdf/arm.urdf"));
    for k in 0..2 * MOST {
        let session = format!("/c/{k}.json");
        remember(
            &mut list,
            DrawnFrom::new(Path::new(&session), &chain("/arm.urdf")),
        );
    }
    assert_eq!(list.len(), MOST);
}
