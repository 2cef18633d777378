//! OBJ (Wavefront): `v x y z` and `f a b c …`, corners counted from 1 or, below 0, back from the last;
//! `a/b/c` names texture and normal behind the corner. A face of more corners is a fan of triangles.
//! All other lines (normals, materials, groups, lines) are passed over.

use super::parts::{Flaw, MOST_TRIANGLES, Triangle, corner, text};
use crate::text::Template;

/// More corners than any mesh of so many triangles has.
const MOST_CORNERS: usize = 3 * MOST_TRIANGLES;

pub(super) fn read(bytes: &[u8]) -> Result<Vec<Triangle>, Flaw> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_become_triangles() {
        let text = b"# a square and a triangle\no thing\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0\nv 0 1 0\n\
            vn 0 0 1\nusemtl grey\nf 1/2/3 2//1 3 4\nf -4 -3 -1\n";
        let [a, b, c, d] =
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| [x, y, 0.0]);
        assert_eq!(read(text), Ok(vec![[a, b, c], [a, c, d], [a, b, d]]));
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
                read(text.as_bytes()).unwrap_err().line,
                Some(line),
                "{text}"
            );
        }
        assert_eq!(read(b"v 0 0 0\n\xff").unwrap_err().line, Some(2));
    }
}
