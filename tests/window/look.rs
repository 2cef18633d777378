//! Pictures to be looked at, not for the repository.
use egui::{Key, Modifiers, Theme};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use truepose::gui::{App, Runner};

use crate::window::{go_to, press};

fn picture(window: &mut Harness<'static, App>, name: &str) {
    window.remove_cursor();
    window.run_steps(16);
    let image = window.render().expect("drawn");
    let (w, h) = image.dimensions();
    std::fs::create_dir_all("/tmp/lib/look").unwrap();
    let file = std::fs::File::create(format!("/tmp/lib/look/{name}.png")).unwrap();
    let mut encoder = png::Encoder::new(file, w, h);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder
        .write_header()
        .unwrap()
        .write_image_data(image.as_raw())
        .unwrap();
}

#[test]
fn look() {
    for (theme, called) in [(Theme::Light, "light"), (Theme::Dark, "dark")] {
        for (size, at) in [([1280.0, 800.0], "1280"), ([1024.0, 700.0], "1024")] {
            let mut window = Harness::builder()
                .with_size(size)
                .with_theme(theme)
                .wgpu()
                .build_eframe(|cc| App::new(&cc.egui_ctx, None, Runner::AtOnce).at_home(None));
            window.run_steps(4);
            picture(&mut window, &format!("0-session-{at}-{called}"));
            press(&mut window, "Robots…");
            picture(&mut window, &format!("1-robots-{at}-{called}"));
            window.get_by_label("Find a robot").type_text("ur 5e");
            window.run_steps(4);
            picture(&mut window, &format!("2-ur5e-{at}-{called}"));
            window.key_press_modifiers(Modifiers::COMMAND, Key::A);
            window.run_steps(1);
            window.get_by_label("Find a robot").type_text("stäubli");
            window.run_steps(4);
            picture(&mut window, &format!("3-staubli-{at}-{called}"));
            window.key_press(Key::Enter);
            window.run_steps(4);
            window.get_by_label("Add an effect").click();
            window.run_steps(4);
            press(&mut window, "Backlash");
            picture(&mut window, &format!("4-simulate-{at}-{called}"));
            press(&mut window, "Simulate");
            picture(&mut window, &format!("5-session-{at}-{called}"));
            go_to(&mut window, "Diagnose");
            press(&mut window, "Run diagnosis");
            press(&mut window, "Show what was hidden");
            picture(&mut window, &format!("6-hidden-{at}-{called}"));
        }
    }
}
