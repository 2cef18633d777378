//! The report's first pages side by side. Poppler's `pdftoppm` draws them where it is installed.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;
use std::process::Command;

use crate::palette;

/// Room around the pages, pixels, and the colour of the table on which they lie.
const ROOM: usize = 16;
const TABLE: [u8; 3] = [222, 226, 230];

struct Page {
    width: usize,
    height: usize,
    rgb: Vec<u8>,
}

fn read(path: &Path) -> anyhow::Result<Page> {
    let mut reader = png::Decoder::new(BufReader::new(File::open(path)?)).read_info()?;
    let size = reader.output_buffer_size();
    let mut rgb = vec![0; size.ok_or_else(|| anyhow::anyhow!("a page without a size"))?];
    let info = reader.next_frame(&mut rgb)?;
    rgb.truncate(info.buffer_size());
    Ok(Page {
        width: info.width as usize,
        height: info.height as usize,
        rgb,
    })
}

/// Draws these pages of a PDF file; `None` where nothing can draw them.
pub fn picture(pdf: &Path, pages: [u32; 2], out: &Path) -> anyhow::Result<Option<u64>> {
    let folder = pdf.parent().unwrap_or(Path::new("."));
    let mut drawn = Vec::new();
    for page in pages {
        let stem = folder.join(format!("page{page}"));
        let page = page.to_string();
        let ran = Command::new("pdftoppm")
            .args(["-png", "-singlefile", "-r", "76", "-f", &page, "-l", &page])
            .args([pdf, &stem])
            .status();
        if !ran.is_ok_and(|status| status.success()) {
            return Ok(None);
        }
        drawn.push(read(&stem.with_extension("png"))?);
    }
    let width = ROOM + drawn.iter().map(|page| page.width + ROOM).sum::<usize>();
    let height = 2 * ROOM + drawn.iter().map(|page| page.height).max().unwrap_or(0);
    let mut rgba: Vec<u8> = [TABLE[0], TABLE[1], TABLE[2], 255].repeat(width * height);
    let mut left = ROOM;
    for page in &drawn {
        for (row, line) in page.rgb.chunks_exact(3 * page.width).enumerate() {
            for (column, pixel) in line.chunks_exact(3).enumerate() {
                let at = 4 * ((row + ROOM) * width + left + column);
                rgba[at..at + 3].copy_from_slice(pixel);
            }
        }
        left += page.width + ROOM;
    }
    let (width, height) = (u32::try_from(width)?, u32::try_from(height)?);
    palette::save(out, width, height, &rgba).map(Some)
}
