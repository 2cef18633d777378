//! Every step of one axis, of a positioner and of arms with six and seven joints, in both themes and at four
//! sizes, to be looked at: how each looks, and whether anything is cut. Not for the repository.

use std::path::{Path, PathBuf};

use egui::{Key, Theme, vec2};
use truepose::gui::Language;

use crate::palette;
use crate::walk::{self, Window};

/// Width and height in points, and pixels of a point: the smallest window, the usual one, 1920 × 1080,
/// and 3840 × 2160 at 150 %.
const SIZES: [(f32, f32, f32, &str); 4] = [
    (1024.0, 700.0, 1.0, "1024"),
    (1280.0, 800.0, 1.0, "1280"),
    (1920.0, 1080.0, 1.0, "1920"),
    (2560.0, 1440.0, 1.5, "3840at150"),
];

/// What is looked at; `None`: the bundled session.
const SESSIONS: [(&str, Option<&str>); 4] = [
    ("axis", None),
    ("positioner", Some("tests/data/arms/positioner-60.json")),
    ("six", Some("tests/data/arms/six-60.json")),
    ("seven", Some("tests/data/arms/seven-60.json")),
];

/// Writes all of them into this folder, in the language of this name.
pub fn all(folder: &Path, language: Option<&str>) -> anyhow::Result<()> {
    std::fs::create_dir_all(folder)?;
    let language = match language {
        Some("de") => Language::German,
        Some("zh") => Language::Chinese,
        _ => Language::English,
    };
    for (name, file) in SESSIONS {
        for (theme, called) in [(Theme::Light, "light"), (Theme::Dark, "dark")] {
            let root = Path::new(env!("CARGO_MANIFEST_DIR"));
            let mut window = walk::window_in(language, theme, file.map(|file| root.join(file)));
            let look = Look {
                folder: folder.to_path_buf(),
                name: format!("{name}-{called}"),
            };
            look.steps(&mut window, file.is_none())?;
        }
    }
    Ok(())
}

struct Look {
    folder: PathBuf,
    name: String,
}

impl Look {
    /// The job, with pictures of each step, by keys: the names of steps are those of the language. `axis`:
    /// there is the step Regions.
    fn steps(&self, window: &mut Window, axis: bool) -> anyhow::Result<()> {
        const STEPS: [Key; 4] = [Key::Num2, Key::Num3, Key::Num4, Key::Num5];
        let press = |window: &mut Window, key| {
            window.key_press_modifiers(egui::Modifiers::COMMAND, key);
            window.run_steps(8);
        };
        let mut steps = STEPS.iter().copied();
        let regions = axis.then(|| steps.next()).flatten();
        let work = [Some(Key::I), Some(Key::G), None];
        let mut todo = vec![("1-session", None, None)];
        todo.extend(regions.map(|key| ("2-regions", None, Some(key))));
        let names = ["3-identify", "4-diagnose", "5-export"];
        todo.extend(
            names
                .into_iter()
                .zip(work)
                .zip(steps)
                .map(|((n, w), s)| (n, w, Some(s))),
        );
        for (name, work, step) in todo {
            for key in work.into_iter().chain(step) {
                press(window, key);
            }
            self.at_all_sizes(window, name)?;
        }
        Ok(())
    }

    fn at_all_sizes(&self, window: &mut Window, step: &str) -> anyhow::Result<()> {
        for (width, height, pixels, size) in SIZES {
            window.set_pixels_per_point(pixels);
            // The first frame with another scale has the same pixels, whatever size was asked for.
            window.run_steps(1);
            window.set_size(vec2(width, height));
            window.remove_cursor();
            window.run_steps(12);
            let image = window.render().map_err(|why| anyhow::anyhow!(why))?;
            let path = self.folder.join(format!("{}-{step}-{size}.png", self.name));
            let (width, height) = image.dimensions();
            palette::save(&path, width, height, image.as_raw())?;
        }
        println!("{} {step}", self.name);
        Ok(())
    }
}
