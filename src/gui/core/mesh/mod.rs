//! Meshes of links: STL (binary and text) and OBJ, as triangles.
//!
//! Readers take any bytes and answer with triangles of finite corners, or with what is wrong and where;
//! no input makes them panic. What the file says is not quoted: a robot description
//! may name any file, also one that is private and no mesh.

mod obj;
mod parts;
mod stl;
mod thinned;

use std::path::Path;

pub(crate) use parts::{Flaw, MOST_BYTES, MOST_TRIANGLES, Triangle};
pub(crate) use thinned::thinned;

/// Whether the ending of a name is that of a mesh that can be read.
pub(crate) fn can_be_read(name: &str) -> bool {
    reader(name).is_some()
}

type Reader = fn(&[u8]) -> Result<Vec<Triangle>, Flaw>;

fn reader(name: &str) -> Option<Reader> {
    let ending = Path::new(name).extension()?.to_str()?;
    match ending.to_ascii_lowercase().as_str() {
        "stl" => Some(stl::read),
        "obj" => Some(obj::read),
        _ => None,
    }
}

/// The triangles of a file by the ending of its name.
///
/// # Errors
/// See [`Flaw`].
pub(crate) fn read(name: &str, bytes: &[u8]) -> Result<Vec<Triangle>, Flaw> {
    let Some(reader) = reader(name) else {
        return Err(Flaw::new(
            None,
            text!("another kind of file"),
            text!("a mesh as .stl or .obj"),
        ));
    };
    let triangles = reader(bytes)?;
    if triangles.is_empty() {
        return Err(Flaw::new(
            None,
            text!("no triangle"),
            text!("at least one triangle"),
        ));
    }
    Ok(triangles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(512))]

        #[test]
        fn no_bytes_make_a_reader_panic(
            bytes in proptest::collection::vec(any::<u8>(), 0..400),
            start in proptest::sample::select(vec!["", "solid ", "solid x\nfacet normal 0 0 1\nouter loop\n", "v 0 0 1\n", "f 1 2"]),
        ) {
            let bytes = [start.as_bytes(), &bytes].concat();
            for name in ["a.stl", "a.OBJ", "a.dae", "a"] {
                if let Ok(triangles) = read(name, &bytes) {
                    prop_assert!(triangles.iter().flatten().flatten().all(|v| v.is_finite()));
                }
            }
        }

        #[test]
        fn words_of_the_formats_in_any_order_make_no_reader_panic(
            words in proptest::collection::vec(proptest::sample::select(vec![
                "solid", "facet", "normal", "outer", "loop", "vertex", "endloop", "endfacet", "endsolid",
                "v", "vn", "f", "1", "-1", "2/1/1", "0", "99999999999999999999", "1e40", "nan", "\n", "3//",
            ]), 0..120),
        ) {
            let text = words.join(" ");
            for name in ["a.stl", "a.obj"] {
                let _ = read(name, text.as_bytes());
            }
        }
    }

    #[test]
    fn what_is_no_mesh_is_refused_without_its_content() {
        for name in ["secret.stl", "secret.obj"] {
            let flaw = read(name, b"root:x:0:0:password\nv root root root\n").unwrap_err();
            assert!(!flaw.found.to_string().contains("root"), "{flaw:?}");
        }
        let flaw = read("arm.dae", b"<COLLADA/>").unwrap_err();
        assert_eq!(flaw.expected, text!("a mesh as .stl or .obj"));
        assert_eq!(
            read("a.stl", b"").unwrap_err().found,
            text!("an empty file")
        );
    }
}
