//! What the readers of meshes share: triangles, limits, what is wrong with a file, numbers of a line.

use crate::text::Text;

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
    pub(super) fn new(
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

    pub(super) fn too_many(line: impl Into<Option<u64>>) -> Self {
        let found = text!("more than {most} triangles", most = MOST_TRIANGLES);
        Self::new(line, found, text!("a mesh of no more triangles than that"))
    }
}

/// Three finite numbers of a line of text.
pub(super) fn corner<'w>(
    words: &mut impl Iterator<Item = &'w str>,
    line: u64,
) -> Result<[f32; 3], Flaw> {
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
pub(super) fn text(bytes: &[u8]) -> Result<&str, Flaw> {
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
