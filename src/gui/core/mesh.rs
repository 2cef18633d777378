//! Meshes of links: STL (binary and text) and OBJ, as triangles, and fewer of them.
//!
//! Readers take any bytes and answer with triangles of finite corners, or with what is wrong and
//! where; no input makes them panic. What the file says is not quoted: a robot description may name
//! any file, also one that is private and no mesh.
//!
//! - STL: 80 bytes of anything, the number of triangles, and 50 bytes for each (binary, little endian);
//!   or `facet`, `outer loop`, three times `vertex x y z`, `endloop`, `endfacet` (text). Some programs
//!   begin a binary file with `solid` as well: a file whose length is what its number of triangles asks
//!   for is binary. Normals are not read, the corners say them.
//! - OBJ (Wavefront): `v x y z` and `f a b c …`, corners counted from 1 or, below 0, back from the last;
//!   `a/b/c` names texture and normal behind the corner. A face of more corners is a fan of triangles.
//!   All other lines (normals, materials, groups, lines) are passed over.

use std::collections::BTreeMap;
use std::path::Path;

use crate::text::{Template, Text};

/// Whether the ending of a name is that of a mesh that can be read.
pub(crate) fn can_be_read(name: &str) -> bool {
    reader(name).is_some()
}

type Reader = fn(&[u8]) -> Result<Vec<Triangle>, Flaw>;

fn reader(name: &str) -> Option<Reader> {
    let ending = Path::new(name).extension()?.to_str()?;
    match ending.to_ascii_lowercase().as_str() {
        "stl" => Some(read_stl),
        "obj" => Some(read_obj),
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

/// Corners of a triangle, in the units of the file until they are placed.
pub(crate) type Triangle = [[f32; 3]; 3];

/// A file that is longer, bytes, is not read.
pub(crate) const MOST_BYTES: u64 = 64 << 20;
/// A mesh with more triangles is refused.
pub(crate) const MOST_TRIANGLES: usize = 1_000_000;

/// What is wrong with a file: its line, counted from 1, where it has lines; what was found and what was
/// expected.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Flaw {
    pub(crate) line: Option<u64>,
    pub(crate) found: Text,
    pub(crate) expected: Text,
}

impl Flaw {
    fn new(
        line: impl Into<Option<u64>>,
        found: impl Into<Text>,
        expected: impl Into<Text>,
    ) -> Self {
        Self {
            line: line.into(),
            found: found.into(),
            expected: expected.into(),
        }
    }

    fn too_many(line: impl Into<Option<u64>>) -> Self {
        let found = text!("more than {most} triangles", most = MOST_TRIANGLES);
        Self::new(line, found, text!("a mesh of no more triangles than that"))
    }
}

/// Three finite numbers of a line of text.
fn corner<'w>(words: &mut impl Iterator<Item = &'w str>, line: u64) -> Result<[f32; 3], Flaw> {
    let mut corner = [0.0; 3];
    for value in &mut corner {
        let number = words.next().and_then(|word| word.parse::<f32>().ok());
        let number = number.filter(|number| number.is_finite());
        *value = number.ok_or_else(|| {
            Flaw::new(
                line,
                text!("a corner without three numbers"),
                text!("three finite numbers"),
            )
        })?;
    }
    Ok(corner)
}

/// A file of text.
fn text(bytes: &[u8]) -> Result<&str, Flaw> {
    std::str::from_utf8(bytes).map_err(|error| {
        let before = &bytes[..error.valid_up_to()];
        let line = memchr::memchr_iter(b'\n', before).count() as u64 + 1;
        Flaw::new(
            line,
            text!("bytes that are not text"),
            text!("a mesh in ASCII"),
        )
    })
}

const HEAD: usize = 84;
const EACH: usize = 50;

fn read_stl(bytes: &[u8]) -> Result<Vec<Triangle>, Flaw> {
    let count = bytes.get(80..HEAD).and_then(|four| four.try_into().ok());
    let count = count.map(|four| u64::from(u32::from_le_bytes(four)));
    let length = count.map(|count| HEAD as u64 + EACH as u64 * count);
    if length == Some(bytes.len() as u64) {
        return binary(&bytes[HEAD..]);
    }
    if bytes.trim_ascii_start().starts_with(b"solid") {
        return as_text(text(bytes)?);
    }
    let found = match (bytes.len(), count) {
        (0, _) => text!("an empty file"),
        (length, None) => text!(one "{count} byte", "{count} bytes", count = length),
        (length, Some(count)) => {
            text!(
                "{length} bytes, and at byte 80 the number of {count} triangles",
                length,
                count
            )
        }
    };
    let expected =
        text!("an STL file: text that begins with solid, or 84 bytes and 50 for each triangle");
    Err(Flaw::new(None, found, expected))
}

fn binary(bytes: &[u8]) -> Result<Vec<Triangle>, Flaw> {
    if bytes.len() / EACH > MOST_TRIANGLES {
        return Err(Flaw::too_many(None));
    }
    let triangle = |(k, record): (usize, &[u8])| {
        let value = |at: usize| -> f32 {
            let four = record[at..at + 4].try_into().unwrap_or_default();
            f32::from_le_bytes(four)
        };
        // Twelve bytes of the normal come first.
        let triangle: Triangle =
            [0, 1, 2].map(|c: usize| [0, 1, 2].map(|axis: usize| value(12 + 12 * c + 4 * axis)));
        if triangle.iter().flatten().all(|v| v.is_finite()) {
            Ok(triangle)
        } else {
            let at = HEAD + EACH * k;
            let found = text!(
                "a corner that is not a number in the triangle at byte {at}",
                at
            );
            Err(Flaw::new(None, found, text!("three finite numbers")))
        }
    };
    bytes.chunks_exact(EACH).enumerate().map(triangle).collect()
}

fn as_text(text: &str) -> Result<Vec<Triangle>, Flaw> {
    let mut triangles = Vec::new();
    let mut corners: Vec<[f32; 3]> = Vec::new();
    for (k, line) in text.lines().enumerate() {
        let number = k as u64 + 1;
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some("vertex") if corners.len() < 3 => corners.push(corner(&mut words, number)?),
            Some("vertex") => {
                let found = text!("a fourth corner of a facet");
                return Err(Flaw::new(
                    number,
                    found,
                    text!("three corners in each facet"),
                ));
            }
            Some("endfacet") => {
                let Ok(triangle) = Triangle::try_from(std::mem::take(&mut corners)) else {
                    let found = text!("the end of a facet without three corners");
                    return Err(Flaw::new(
                        number,
                        found,
                        text!("three corners in each facet"),
                    ));
                };
                if triangles.len() == MOST_TRIANGLES {
                    return Err(Flaw::too_many(number));
                }
                triangles.push(triangle);
            }
            None | Some("solid" | "facet" | "outer" | "endloop" | "endsolid") => {}
            Some(_) => {
                let expected =
                    text!("solid, facet, outer loop, vertex, endloop, endfacet or endsolid");
                return Err(Flaw::new(number, text!("a line of another kind"), expected));
            }
        }
    }
    if corners.is_empty() {
        Ok(triangles)
    } else {
        let line = text.lines().count() as u64;
        let found = text!("the end of the file within a facet");
        Err(Flaw::new(
            line,
            found,
            text!("endfacet behind three corners"),
        ))
    }
}

/// More corners than any mesh of so many triangles has.
const MOST_CORNERS: usize = 3 * MOST_TRIANGLES;

fn read_obj(bytes: &[u8]) -> Result<Vec<Triangle>, Flaw> {
    let mut corners: Vec<[f32; 3]> = Vec::new();
    let mut triangles = Vec::new();
    for (k, line) in text(bytes)?.lines().enumerate() {
        let number = k as u64 + 1;
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some("v") if corners.len() == MOST_CORNERS => return Err(Flaw::too_many(number)),
            Some("v") => corners.push(corner(&mut words, number)?),
            Some("f") => {
                let around = words.map(|word| place(word, &corners, number));
                let around: Vec<[f32; 3]> = around.collect::<Result<_, _>>()?;
                let [first, rest @ ..] = &around[..] else {
                    return Err(Flaw::new(number, text!("a face without corners"), AT_LEAST));
                };
                if rest.len() < 2 {
                    return Err(Flaw::new(
                        number,
                        text!("a face of too few corners"),
                        AT_LEAST,
                    ));
                }
                if triangles.len() + rest.len() > MOST_TRIANGLES + 1 {
                    return Err(Flaw::too_many(number));
                }
                triangles.extend(rest.windows(2).map(|pair| [*first, pair[0], pair[1]]));
            }
            _ => {}
        }
    }
    Ok(triangles)
}

const AT_LEAST: Template = phrase!("at least three corners in a face");

/// The corner that a word of a face names.
fn place(word: &str, corners: &[[f32; 3]], line: u64) -> Result<[f32; 3], Flaw> {
    let number = word.split('/').next().and_then(|n| n.parse::<i64>().ok());
    let place = number.and_then(|number| match number {
        1.. => usize::try_from(number - 1).ok(),
        0 => None,
        _ => corners
            .len()
            .checked_sub(usize::try_from(number.unsigned_abs()).ok()?),
    });
    let corner = place.and_then(|place| corners.get(place));
    corner.copied().ok_or_else(|| {
        let expected = text!("the number of a corner (v) above this line");
        Flaw::new(
            line,
            text!("a face with a corner that is not there"),
            expected,
        )
    })
}

/// Cells along the longest side of the box around a mesh, at first.
const CELLS: f32 = 192.0;

/// At most about so many of these triangles, which look the same from afar: corners of one cell of a grid
/// become one (Rossignac & Borrel 1993), and triangles that lie in fewer than three cells go. The grid gets
/// coarser until they are.
pub(crate) fn thinned(triangles: Vec<Triangle>, most: usize) -> Vec<Triangle> {
    if triangles.len() <= most {
        return triangles;
    }
    let all = || triangles.iter().flatten();
    let end = |axis: usize, pick: fn(f32, f32) -> f32, start: f32| {
        all().map(|corner| corner[axis]).fold(start, pick)
    };
    let low: [f32; 3] = std::array::from_fn(|k| end(k, f32::min, f32::INFINITY));
    let side = (0..3).map(|k| end(k, f32::max, f32::NEG_INFINITY) - low[k]);
    let longest = side.fold(0.0, f32::max).max(f32::MIN_POSITIVE);
    let mut cells = CELLS;
    loop {
        let mut first: BTreeMap<[u16; 3], [f32; 3]> = BTreeMap::new();
        let mut kept = Vec::new();
        for triangle in &triangles {
            #[allow(clippy::cast_possible_truncation, reason = "at most CELLS")]
            #[allow(clippy::cast_sign_loss, reason = "at least 0")]
            let cell = |corner: &[f32; 3]| -> [u16; 3] {
                std::array::from_fn(|k| ((corner[k] - low[k]) / longest * cells) as u16)
            };
            let [a, b, c] = [0, 1, 2].map(|k| cell(&triangle[k]));
            if a != b && b != c && c != a {
                let at = [a, b, c].into_iter().zip(triangle);
                let at = at.map(|(cell, corner)| *first.entry(cell).or_insert(*corner));
                kept.extend(Triangle::try_from(at.collect::<Vec<_>>()));
            }
        }
        if kept.len() <= most || cells < 4.0 {
            kept.truncate(most);
            return kept;
        }
        cells *= 0.7;
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

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

    const CORNERS: [Triangle; 2] = [
        [[0.0, 0.0, 0.0], [1.5, 0.0, 0.0], [0.0, 2.0, 0.25]],
        [[9.0, 0.0, 0.0], [1.5, 8.0, 0.0], [0.0, 2.0, 7.0]],
    ];

    fn binary_file(head: &[u8]) -> Vec<u8> {
        let mut bytes = head.to_vec();
        bytes.resize(80, b' ');
        bytes.extend(2_u32.to_le_bytes());
        for triangle in CORNERS {
            bytes.extend([0; 12]);
            for value in triangle.as_flattened() {
                bytes.extend(value.to_le_bytes());
            }
            bytes.extend([0; 2]);
        }
        bytes
    }

    fn text_file() -> String {
        let mut text = "solid arm\n".to_owned();
        for triangle in CORNERS {
            text += " facet normal 0 0 0\n  outer loop\n";
            for [x, y, z] in triangle {
                text += &format!("   vertex {x} {y:e} {z}\n");
            }
            text += "  endloop\n endfacet\n";
        }
        text + "endsolid arm\n"
    }

    #[test]
    fn binary_and_text_say_the_same() {
        assert_eq!(
            read_stl(&binary_file(b"made by a program")),
            Ok(CORNERS.to_vec())
        );
        // A binary file may begin like a text.
        assert_eq!(read_stl(&binary_file(b"solid arm")), Ok(CORNERS.to_vec()));
        assert_eq!(read_stl(text_file().as_bytes()), Ok(CORNERS.to_vec()));
    }

    #[test]
    fn what_is_damaged_is_refused_with_its_place() {
        let mut cut = binary_file(b"");
        cut.pop();
        let flaw = read_stl(&cut).unwrap_err();
        assert!(
            flaw.found
                .to_string()
                .contains("183 bytes, and at byte 80 the number of 2"),
            "{flaw:?}"
        );
        let mut wrong = binary_file(b"");
        wrong[84 + 50 + 12..][..4].copy_from_slice(&f32::NAN.to_le_bytes());
        let flaw = read_stl(&wrong).unwrap_err();
        assert!(
            flaw.found.to_string().ends_with("triangle at byte 134"),
            "{flaw:?}"
        );
        for (from, to, line) in [
            ("vertex 1.5", "vertex x", 5),
            ("vertex 1.5", "corner 1.5", 5),
            ("  endloop\n endfacet\n", "", 9),
            (" endfacet\nendsolid arm\n", "", 14),
        ] {
            let text = text_file().replacen(from, to, 1);
            let flaw = read_stl(text.as_bytes()).unwrap_err();
            assert_eq!(flaw.line, Some(line), "{flaw:?}");
        }
    }

    #[test]
    fn faces_become_triangles() {
        let text = b"# a square and a triangle\no thing\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0\nv 0 1 0\n\
            vn 0 0 1\nusemtl grey\nf 1/2/3 2//1 3 4\nf -4 -3 -1\n";
        let [a, b, c, d] =
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| [x, y, 0.0]);
        assert_eq!(read_obj(text), Ok(vec![[a, b, c], [a, c, d], [a, b, d]]));
    }

    #[test]
    fn what_is_damaged_is_refused_with_its_line() {
        for (text, line) in [
            ("v 0 0\n", 1),
            ("v 0 0 inf\n", 1),
            ("v 0 0 0\nf 1 1\n", 2),
            ("v 0 0 0\nf 1 1 2\n", 2),
            ("v 0 0 0\nf 1 0 1\n", 2),
            ("v 0 0 0\nf 1 -2 1\n", 2),
            ("v 0 0 0\nf 1 x 1\n", 2),
            ("v 0 0 0\nf\n", 2),
        ] {
            assert_eq!(
                read_obj(text.as_bytes()).unwrap_err().line,
                Some(line),
                "{text}"
            );
        }
        assert_eq!(read_obj(b"v 0 0 0\n\xff").unwrap_err().line, Some(2));
    }

    #[test]
    fn a_fine_ball_becomes_a_coarse_one_of_the_same_size() {
        let at = |i: u16, j: u16| -> [f32; 3] {
            let (sin, cos) = (f32::from(i) * std::f32::consts::PI / 200.0).sin_cos();
            let (along, across) = (f32::from(j) * std::f32::consts::TAU / 400.0).sin_cos();
            [100.0 * sin * across, 100.0 * sin * along, 100.0 * cos]
        };
        let mut ball = Vec::new();
        for i in 0..200 {
            for j in 0..400 {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                ball.extend([[a, b, c], [a, c, d]]);
            }
        }
        assert_eq!(ball.len(), 160_000);
        let coarse = thinned(ball.clone(), 5_000);
        assert!((1_000..=5_000).contains(&coarse.len()), "{}", coarse.len());
        for corner in coarse.iter().flatten() {
            let far = corner.iter().map(|v| v * v).sum::<f32>().sqrt();
            assert!((far - 100.0).abs() < 0.01, "{far}");
        }
        let area = |triangles: &[Triangle]| {
            let area = |[a, b, c]: &Triangle| {
                let [a, b, c] = [a, b, c].map(|p| nalgebra::Vector3::from(*p));
                0.5 * (b - a).cross(&(c - a)).norm()
            };
            triangles.iter().map(area).sum::<f32>()
        };
        assert!((area(&coarse) / area(&ball) - 1.0).abs() < 0.05);
        assert_eq!(thinned(coarse.clone(), 5_000), coarse);
    }
}
