//! Pictures with at most 256 colours, for files a third as large: median cut (Heckbert 1982), each
//! box by the mean of its pixels. A window has few colours and their mixtures along edges; nobody
//! sees the difference.

use std::collections::BTreeMap;
use std::path::Path;

/// So many colours fit into a byte.
const MOST: usize = 256;

type Color = [u8; 3];

/// Colours and how often each occurs.
struct Cell {
    colors: Vec<(Color, u64)>,
}

impl Cell {
    fn weight(&self) -> u64 {
        self.colors.iter().map(|(_, count)| count).sum()
    }

    /// The channel that spreads most, and how far.
    fn widest(&self) -> (usize, u8) {
        let spread = |channel: usize| {
            let values = self.colors.iter().map(|(color, _)| color[channel]);
            let (low, high) = (values.clone().min(), values.max());
            high.unwrap_or(0) - low.unwrap_or(0)
        };
        let channels = (0..3).map(|channel| (channel, spread(channel)));
        channels.max_by_key(|(_, spread)| *spread).unwrap_or((0, 0))
    }

    /// How much worse it is to leave the box whole: rare colours that are far apart count too.
    fn urgency(&self) -> u64 {
        let spread = u64::from(self.widest().1);
        // The root of the number of pixels: a thin line is seen as well as a large surface.
        spread * spread * self.weight().isqrt()
    }

    fn cut(mut self) -> (Self, Self) {
        let (channel, _) = self.widest();
        self.colors.sort_by_key(|(color, _)| color[channel]);
        let half = self.weight() / 2;
        let mut sum = 0;
        let at = self.colors.iter().position(|(_, count)| {
            sum += count;
            sum > half
        });
        let at = at.unwrap_or(0).clamp(1, self.colors.len() - 1);
        let above = self.colors.split_off(at);
        (self, Self { colors: above })
    }

    fn mean(&self) -> Color {
        let weight = self.weight().max(1);
        let channel = |k: usize| {
            let sum: u64 = self
                .colors
                .iter()
                .map(|(color, count)| u64::from(color[k]) * count)
                .sum();
            u8::try_from((sum + weight / 2) / weight).unwrap_or(u8::MAX)
        };
        [channel(0), channel(1), channel(2)]
    }
}

/// Writes pixels (red, green, blue, alpha in a row) with a palette.
pub fn save(path: &Path, width: u32, height: u32, rgba: &[u8]) -> anyhow::Result<u64> {
    let colors = || {
        rgba.chunks_exact(4)
            .map(|pixel| [pixel[0], pixel[1], pixel[2]])
    };
    let mut counts: BTreeMap<Color, u64> = BTreeMap::new();
    for color in colors() {
        *counts.entry(color).or_default() += 1;
    }
    let mut cells = vec![Cell {
        colors: counts.into_iter().collect(),
    }];
    while cells.len() < MOST {
        let urgent = (0..cells.len())
            .filter(|&k| cells[k].colors.len() > 1)
            .max_by_key(|&k| cells[k].urgency());
        let Some(urgent) = urgent else { break };
        let (below, above) = cells.swap_remove(urgent).cut();
        cells.extend([below, above]);
    }
    let mut index = BTreeMap::new();
    let mut palette = Vec::new();
    for (k, cell) in (0_u8..=u8::MAX).zip(&cells) {
        palette.extend(cell.mean());
        index.extend(cell.colors.iter().map(|(color, _)| (*color, k)));
    }
    let pixels: Vec<u8> = colors().map(|color| index[&color]).collect();
    let file = std::io::BufWriter::new(std::fs::File::create(path)?);
    let mut encoder = png::Encoder::new(file, width, height);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette);
    encoder.set_compression(png::Compression::High);
    encoder.set_filter(png::Filter::NoFilter);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&pixels)?;
    writer.finish()?;
    Ok(std::fs::metadata(path)?.len())
}
