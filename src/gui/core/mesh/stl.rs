//! STL: 80 bytes of anything, the number of triangles, and 50 bytes for each (binary, little endian);
//! or `facet`, `outer loop`, three times `vertex x y z`, `endloop`, `endfacet` (text).
//!
//! Some programs begin a binary file with `solid` as well: a file whose length is what its number of
//! triangles asks for is binary. Normals are not read, the corners say them.

use super::parts::{Flaw, MOST_TRIANGLES, Triangle, corner, text};

const HEAD: usize = 84;
const EACH: usize = 50;

pub(super) fn read(bytes: &[u8]) -> Result<Vec<Triangle>, Flaw> {
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
                length = length,
                count = count
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
                at = at
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

#[cfg(test)]
mod tests {
    use super::*;

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
            read(&binary_file(b"made by a program")),
            Ok(CORNERS.to_vec())
        );
        // A binary file may begin like a text.
        assert_eq!(read(&binary_file(b"solid arm")), Ok(CORNERS.to_vec()));
        assert_eq!(read(text_file().as_bytes()), Ok(CORNERS.to_vec()));
    }

    #[test]
    fn what_is_damaged_is_refused_with_its_place() {
        let mut cut = binary_file(b"");
        cut.pop();
        let flaw = read(&cut).unwrap_err();
        assert!(
            flaw.found
                .to_string()
                .contains("183 bytes, and at byte 80 the number of 2"),
            "{flaw:?}"
        );
        let mut wrong = binary_file(b"");
        wrong[84 + 50 + 12..][..4].copy_from_slice(&f32::NAN.to_le_bytes());
        let flaw = read(&wrong).unwrap_err();
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
            let flaw = read(text.as_bytes()).unwrap_err();
            assert_eq!(flaw.line, Some(line), "{flaw:?}");
        }
    }
}
