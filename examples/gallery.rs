//! Makes the pictures of the README and of the documentation: drives the window through the walk of
//! `docs/walk-through.md`, in both themes, and writes what it shows into `docs/pictures`.
//!
//! `cargo run --example gallery`; with `-- arm` only the pictures of the arm;
//! with `-- languages` only those of a diagnosis in other languages and units; with `-- looks FOLDER [de|zh]` every
//! step of four robots at four sizes into that folder, to be looked at
//!
//! It needs something to draw with (Mesa's lavapipe does); without an adapter it says so and writes
//! nothing.

#![allow(clippy::print_stdout, reason = "it is run by hand")]
#![allow(unreachable_pub, reason = "the parts are modules of one program")]

#[path = "gallery/looks.rs"]
mod looks;
#[path = "gallery/palette.rs"]
mod palette;
#[path = "gallery/report.rs"]
mod report;
#[path = "gallery/walk.rs"]
mod walk;

use std::path::{Path, PathBuf};

use egui::{Key, Theme};
use egui_kittest::kittest::Queryable as _;
use truepose::gui::Language;
use walk::{Window, press, there};

/// Writes pictures of one theme.
struct Gallery {
    folder: PathBuf,
    theme: Theme,
}

impl Gallery {
    /// The window as it is now. In dark the file's name says so.
    fn picture(&self, window: &mut Window, name: &str) -> anyhow::Result<()> {
        window.remove_cursor();
        // Until nothing moves any more.
        window.run_steps(16);
        let image = window.render().map_err(|why| anyhow::anyhow!(why))?;
        let name = match self.theme {
            Theme::Light => format!("{name}.png"),
            Theme::Dark => format!("{name}-dark.png"),
        };
        let path = self.folder.join(&name);
        let (width, height) = image.dimensions();
        let bytes = palette::save(&path, width, height, image.as_raw())?;
        println!("{name}: {width} × {height}, {} kB", bytes.div_ceil(1000));
        Ok(())
    }

    /// The walk, with a picture at each step.
    fn walk(&self) -> anyhow::Result<()> {
        let mut window = walk::window(self.theme, None);
        walk::asked(&mut window);
        self.picture(&mut window, "import")?;
        walk::filled_in(&mut window);
        self.picture(&mut window, "alignment")?;
        press(&mut window, "Import");
        self.picture(&mut window, "session")?;
        press(&mut window, "2 Regions");
        press(&mut window, "Identify by region");
        press(&mut window, "2 Regions");
        self.picture(&mut window, "regions")?;
        walk::identified(&mut window);
        self.picture(&mut window, "identify")?;
        walk::searched(&mut window);
        self.picture(&mut window, "search")?;
        walk::added(&mut window);
        self.picture(&mut window, "gap")?;
        press(&mut window, "5 Export");
        press(&mut window, "LinuxCNC COMP_FILE");
        self.picture(&mut window, "export")?;
        if self.theme == Theme::Light {
            self.report(&mut window, "report.png")?;
        }
        Ok(())
    }

    /// The walk of the arm (`docs/first-arm.md`), in light.
    fn arm_walk(&self) -> anyhow::Result<()> {
        let mut window = walk::window(self.theme, None);
        walk::arm_asked(&mut window);
        self.picture(&mut window, "arm-import")?;
        press(&mut window, "Import");
        self.picture(&mut window, "arm-session")?;
        walk::identified(&mut window);
        self.picture(&mut window, "arm-identify")?;
        walk::searched(&mut window);
        self.picture(&mut window, "arm-search")?;
        walk::added(&mut window);
        press(&mut window, "4 Export");
        window.state_mut().compensate(Path::new("cell.mod"));
        window.run_steps(6);
        press(&mut window, "Tool of the program: the model's tool or base");
        self.picture(&mut window, "arm-compensate")?;
        press(&mut window, "Cancel");
        self.report(&mut window, "arm-report.png")
    }

    /// A diagnosis in every language and in millimetres and inches, and the report's pages.
    fn languages(&self) -> anyhow::Result<()> {
        for (language, code, inch) in [
            (Language::English, "", "inch"),
            (Language::German, "-de", "Zoll"),
            (Language::Chinese, "-zh", "英寸"),
        ] {
            let mut window = walk::window_in(language, self.theme, None);
            for key in [Key::I, Key::G, Key::Num4] {
                walk::key(&mut window, key);
            }
            let english = language == Language::English;
            if !english {
                self.picture(&mut window, &format!("diagnose{code}"))?;
                self.report(&mut window, &format!("report{code}.png"))?;
            }
            walk::key(&mut window, Key::Comma);
            press(&mut window, inch);
            window.key_press(Key::Escape);
            window.run_steps(8);
            self.picture(&mut window, &format!("diagnose{code}-inch"))?;
        }
        Ok(())
    }

    /// The paper that is signed; there is one for both themes.
    fn report(&self, window: &mut Window, name: &str) -> anyhow::Result<()> {
        let folder = tempfile::tempdir()?;
        let pdf = folder.path().join("report.pdf");
        window.state_mut().type_path("report", &pdf);
        window.run_steps(4);
        let save = ["Save", "Speichern", "保存"].into_iter();
        let mut save = save.filter(|save| there(window, save));
        press(window, save.next().unwrap_or("Save"));
        window.run_steps(8);
        let out = self.folder.join(name);
        match report::picture(&pdf, [1, 2], &out)? {
            Some(bytes) => println!("{name}: {} kB", bytes.div_ceil(1000)),
            None => println!("report: pdftoppm is not there, the picture stays as it was"),
        }
        Ok(())
    }

    /// An arm in three dimensions, identified, at the pose of a sample.
    fn arm(&self) -> anyhow::Result<()> {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/arms/six-60.json");
        let mut window = walk::window(self.theme, Some(file.into()));
        walk::identified(&mut window);
        let view = window.get_by_label_contains("3-D view, ").rect();
        for row in 0..60_u8 {
            let at = view.center_top() + egui::vec2(30.0, f32::from(row) / 60.0 * view.height());
            window.hover_at(at);
            window.run_steps(2);
            if window.query_all_by_label_contains("card of sample").count() > 0 {
                window.drag_at(at);
                window.run_steps(1);
                window.drop_at(at);
                window.run_steps(3);
                break;
            }
        }
        self.picture(&mut window, "space")
    }

    /// Other views of the same machine: what is not there in this version is passed over.
    fn views(&self) -> anyhow::Result<()> {
        let mut window = walk::window(self.theme, None);
        walk::imported(&mut window);
        walk::identified(&mut window);
        if there(&window, "heat map") {
            press(&mut window, "heat map");
            self.picture(&mut window, "heat-map")?;
            press(&mut window, "heat map");
        }
        press(&mut window, "View");
        press(&mut window, "Polar view");
        self.picture(&mut window, "polar")
    }
}

/// Whether there is an adapter; drawing panics where there is none.
fn can_draw() -> bool {
    let instance = egui_wgpu::wgpu::Instance::default();
    let adapters = instance.enumerate_adapters(egui_wgpu::wgpu::Backends::all());
    !pollster::block_on(adapters).is_empty()
}

fn main() -> anyhow::Result<()> {
    if !can_draw() {
        println!("skipped: no adapter to draw with, no picture was written");
        return Ok(());
    }
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [mode, folder, language @ ..] = &arguments[..]
        && mode == "looks"
    {
        return looks::all(Path::new(folder), language.first().map(String::as_str));
    }
    let only_the_arm = arguments.iter().any(|argument| argument == "arm");
    let only_languages = arguments.iter().any(|argument| argument == "languages");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    // Short names on the sheet, as a person has them who works beside the files.
    let beside = |folder: &str| std::env::set_current_dir(root.join("sessions").join(folder));
    for theme in [Theme::Light, Theme::Dark] {
        let gallery = Gallery {
            folder: root.join("docs/pictures"),
            theme,
        };
        if theme == Theme::Light && (only_languages || !only_the_arm) {
            gallery.languages()?;
        }
        if only_languages {
            continue;
        }
        if !only_the_arm {
            beside("walk-through")?;
            gallery.walk()?;
            gallery.views()?;
        }
        beside("arm")?;
        if theme == Theme::Light {
            gallery.arm_walk()?;
        }
        gallery.arm()?;
    }
    Ok(())
}
