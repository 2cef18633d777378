//! The logo in the head of a report: a PNG file. It is decoded and written anew, so that nothing but
//! its picture gets into a report; what is transparent is white, as the paper is.

use crate::text::{Template, Text};
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::guard::read_regular;
use png::{BitDepth, ColorType, Decoder, Encoder, Limits, Transformations};

/// Largest file, bytes.
const MOST_BYTES: u64 = 2 << 20;
/// Longest side, pixels: a hand's width at 600 dots per inch.
const MOST_PIXELS: u32 = 2400;

/// Room for it in the head of a report, points.
pub(super) const LOGO: [f64; 2] = [150.0, 42.0];

/// A picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Logo {
    /// The file that it was read from.
    pub path: PathBuf,
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Red, green and blue of each pixel, row by row.
    pub rgb: Arc<[u8]>,
}

impl Logo {
    /// What a logo has to be.
    pub const EXPECTED: Template = phrase!("a PNG file of at most 2 MiB and 2400 × 2400 pixels");

    /// Reads a PNG file.
    ///
    /// # Errors
    /// What is wrong with the file; [`Logo::EXPECTED`] was expected.
    pub fn read(path: &Path) -> Result<Self, Text> {
        let wrong = |what: Text| {
            text!(
                "{found}: {name}",
                found = path.display().to_string(),
                name = what
            )
        };
        let bytes = read_regular(path, MOST_BYTES).map_err(|(found, _)| wrong(found))?;
        Self::decoded(path.to_path_buf(), &bytes).map_err(wrong)
    }

    fn decoded(path: PathBuf, bytes: &[u8]) -> Result<Self, Text> {
        let no_png =
            |e: png::DecodingError| text!("not a PNG file: {error}", error = e.to_string());
        let most = Limits {
            bytes: 16 * (MOST_PIXELS as usize).pow(2),
        };
        let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), most);
        decoder.set_transformations(Transformations::normalize_to_color8());
        let mut reader = decoder.read_info().map_err(no_png)?;
        let info = reader.info();
        let size = [info.width, info.height];
        if size.iter().any(|side| *side > MOST_PIXELS) {
            let [width, height] = size;
            return Err(text!("{width} × {height} pixels", width, height));
        }
        let length = reader.output_buffer_size();
        let mut pixels = vec![0; length.ok_or_else(|| text!("too many pixels"))?];
        let frame = reader.next_frame(&mut pixels).map_err(no_png)?;
        pixels.truncate(frame.buffer_size());
        let rgb = pixels
            .chunks_exact(frame.color_type.samples())
            .flat_map(|pixel| on_paper(frame.color_type, pixel));
        Ok(Self {
            path,
            size,
            rgb: rgb.collect(),
        })
    }

    /// The picture as a PNG file.
    pub(super) fn png(&self) -> Vec<u8> {
        let mut out = Vec::new();
        let [width, height] = self.size;
        let mut encoder = Encoder::new(&mut out, width, height);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        let written = encoder
            .write_header()
            .and_then(|mut writer| writer.write_image_data(&self.rgb));
        // Only a size that is not that of the pixels can fail, and they were made together.
        debug_assert!(written.is_ok(), "{written:?}");
        out
    }

    /// Width and height within a box, in the unit of the box.
    pub(super) fn within(&self, [width, height]: [f64; 2]) -> [f64; 2] {
        let [w, h] = self.size.map(|side| f64::from(side.max(1)));
        let scale = (width / w).min(height / h);
        [w * scale, h * scale]
    }
}

/// A pixel on white paper.
fn on_paper(kind: ColorType, pixel: &[u8]) -> [u8; 3] {
    let over = |colour: u8, alpha: u8| {
        let (colour, alpha) = (u32::from(colour), u32::from(alpha));
        #[allow(clippy::cast_possible_truncation, reason = "a mean of two bytes")]
        let mixed = ((colour * alpha + 255 * (255 - alpha) + 127) / 255) as u8;
        mixed
    };
    match (kind, pixel) {
        (ColorType::Rgb, &[r, g, b]) => [r, g, b],
        (ColorType::Rgba, &[r, g, b, a]) => [over(r, a), over(g, a), over(b, a)],
        (ColorType::GrayscaleAlpha, &[grey, a]) => [over(grey, a); 3],
        _ => [pixel.first().copied().unwrap_or(255); 3],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transparent_pixels_are_white_and_a_written_logo_reads_the_same() {
        let mut file = Vec::new();
        let mut encoder = Encoder::new(&mut file, 2, 1);
        encoder.set_color(ColorType::Rgba);
        let mut writer = encoder.write_header().unwrap();
        writer
            .write_image_data(&[10, 20, 30, 255, 9, 9, 9, 0])
            .unwrap();
        writer.finish().unwrap();
        let logo = Logo::decoded(PathBuf::new(), &file).unwrap();
        assert_eq!(*logo.rgb, [10, 20, 30, 255, 255, 255]);
        assert_eq!(Logo::decoded(PathBuf::new(), &logo.png()).unwrap(), logo);
        assert_eq!(logo.within([10.0, 40.0]), [10.0, 5.0]);
        for end in 0..file.len() - 1 {
            let cut = Logo::decoded(PathBuf::new(), &file[..end]);
            assert!(cut.is_err() || end > 40, "{end}");
        }
    }

    #[test]
    fn what_is_no_logo_is_refused_in_words() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("logo.png");
        let refused = || Logo::read(&path).unwrap_err();
        assert!(refused().to_string().contains("logo.png"));
        std::fs::write(&path, "GIF89a").unwrap();
        assert!(
            refused().to_string().contains("not a PNG file"),
            "{}",
            refused()
        );
        std::fs::write(&path, vec![0; 3 << 20]).unwrap();
        assert!(
            refused().to_string().contains("3145728 bytes"),
            "{}",
            refused()
        );
        let mut wide = Vec::new();
        let mut encoder = Encoder::new(&mut wide, 5000, 1);
        encoder.set_color(ColorType::Grayscale);
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(&[0; 5000]).unwrap();
        writer.finish().unwrap();
        std::fs::write(&path, wide).unwrap();
        assert!(
            refused().to_string().contains("5000 × 1 pixels"),
            "{}",
            refused()
        );
    }
}
