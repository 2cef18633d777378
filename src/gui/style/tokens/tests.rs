//! What the colours are held to.

use std::path::{Path, PathBuf};

use egui::Color32;

use super::{DARK, LIGHT, Palette, STOPS};
use crate::gui::style::vision::{ColourVision, colour_distance, contrast, lightness};

const THEMES: [(&str, Palette); 2] = [("light", LIGHT), ("dark", DARK)];

/// Everything that text and marks stand on.
fn grounds(p: &Palette) -> [(&'static str, Color32); 6] {
    [
        ("background", p.background),
        ("surface", p.surface),
        ("inset", p.inset),
        ("accent soft", p.accent_soft),
        ("even sectors", p.sectors[0]),
        ("odd sectors", p.sectors[1]),
    ]
}

#[test]
fn every_text_colour_has_a_contrast_of_at_least_four_and_a_half_to_one() {
    for (theme, p) in THEMES {
        let texts = [
            ("text", p.text),
            ("muted", p.muted),
            ("accent", p.accent),
            ("before", p.before),
            ("after", p.after),
            ("within", p.within),
            ("outside", p.outside),
            ("warning", p.warning),
        ];
        for (name, text) in texts {
            for (on, ground) in grounds(&p) {
                let found = contrast(text, ground);
                assert!(found >= 4.5, "{theme}, {name} on {on}: {found:.2}");
            }
        }
        let found = contrast(p.on_accent, p.accent);
        assert!(found >= 4.5, "{theme}, on accent: {found:.2}");
    }
}

#[test]
fn marks_outlines_and_the_focus_ring_have_a_contrast_of_at_least_three_to_one() {
    for (theme, p) in THEMES {
        for (on, ground) in grounds(&p) {
            for (name, mark) in [("nominal path", p.nominal), ("focus ring", p.accent)] {
                let found = contrast(mark, ground);
                assert!(found >= 3.0, "{theme}, {name} on {on}: {found:.2}");
            }
        }
        // Controls stand on panels, cards and sheets.
        for (on, ground) in [("background", p.background), ("surface", p.surface)] {
            for (name, mark) in [("outline", p.outline), ("filled button", p.accent)] {
                let found = contrast(mark, ground);
                assert!(found >= 3.0, "{theme}, {name} on {on}: {found:.2}");
            }
        }
    }
}

#[test]
fn pairs_of_meanings_stay_apart_for_everybody() {
    // Ten times the difference that is just noticed side by side; a neighbour in meaning that has
    // a word beside it may be nearer.
    const PAIR: f64 = 23.0;
    const NEIGHBOURS: f64 = 10.0;
    for (theme, p) in THEMES {
        for sight in ColourVision::ALL {
            let held = |name: &str, a: Color32, b: Color32, least: f64| {
                let found = colour_distance(a, b, sight);
                assert!(found >= least, "{theme}, {name}, {sight:?}: {found:.1}");
            };
            held("before and after", p.before, p.after, PAIR);
            held("within and outside", p.within, p.outside, PAIR);
            held("outside and before", p.outside, p.before, NEIGHBOURS);
            held("outside and after", p.outside, p.after, NEIGHBOURS);
            held("within and before", p.within, p.before, NEIGHBOURS);
            held("within and after", p.within, p.after, NEIGHBOURS);
            held("warning and within", p.warning, p.within, NEIGHBOURS);
            held("warning and outside", p.warning, p.outside, NEIGHBOURS);
            held("nominal and before", p.nominal, p.before, NEIGHBOURS);
            held("nominal and after", p.nominal, p.after, NEIGHBOURS);
        }
    }
}

#[test]
fn neighbouring_regions_differ_in_lightness_which_everybody_sees() {
    for (theme, p) in THEMES {
        for sight in ColourVision::ALL {
            let [even, odd] = p.sectors.map(|c| lightness(c, sight));
            assert!((even - odd).abs() > 2.3, "{theme}, {sight:?}: {even} {odd}");
        }
    }
}

#[test]
fn a_scale_is_ordered_by_lightness_away_from_the_surface() {
    for (theme, p) in THEMES {
        let from_surface = p.scale.map(|c| contrast(c, p.surface));
        assert!(from_surface[0] >= 1.7, "{theme}: {from_surface:?}");
        for pair in from_surface.windows(2) {
            assert!(pair[1] > 1.08 * pair[0], "{theme}: {from_surface:?}");
        }
    }
}

#[test]
fn opposite_directions_stay_apart_for_everybody() {
    for (theme, p) in THEMES {
        for sight in ColourVision::ALL {
            for k in 0..STOPS / 2 {
                let found = colour_distance(p.cycle[k], p.cycle[k + STOPS / 2], sight);
                assert!(found > 20.0, "{theme}, {k}, {sight:?}: {found:.1}");
            }
        }
    }
}

/// Files of the window, without this folder and what only tests see.
fn sources() -> Vec<PathBuf> {
    fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
        let entries = std::fs::read_dir(folder).expect("a folder of the window");
        for entry in entries {
            let path = entry.expect("an entry of the folder").path();
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if path.is_dir() {
                if name != "tokens" {
                    walk(&path, found);
                }
            } else if name.ends_with(".rs") && !["tokens.rs", "vision.rs"].contains(&&*name) {
                found.push(path);
            }
        }
    }
    let mut found = Vec::new();
    let window = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/gui");
    walk(&window, &mut found);
    found.sort();
    found
}

/// Whether a line gives a colour or a size of type by number.
fn has_a_literal(line: &str) -> bool {
    const COLOURS: [&str; 7] = [
        "Color32::from_",
        "Color32::BLACK",
        "Color32::WHITE",
        "Color32::GRAY",
        "Color32::RED",
        "Rgba::from_",
        "hex_color!",
    ];
    const TYPE: [&str; 5] = [
        ".size(",
        "FontId::new(",
        "FontId::proportional(",
        "FontId::monospace(",
        "strong(",
    ];
    let number = |text: &str| text.starts_with(|c: char| c.is_ascii_digit());
    let sized = |call: &&str| {
        line.match_indices(*call)
            .any(|(at, _)| number(&line[at + call.len()..]))
    };
    let reckoned = [
        "size::SMALL +",
        "size::SMALL -",
        "size::BODY +",
        "size::BODY -",
    ];
    COLOURS.iter().any(|c| line.contains(c))
        || TYPE.iter().any(sized)
        || reckoned.iter().any(|r| line.contains(r))
}

#[test]
fn no_other_file_of_the_window_has_a_colour_or_a_size_of_type_in_it() {
    let mut found = Vec::new();
    let files = sources();
    assert!(files.len() > 50, "{}", files.len());
    for path in files {
        let text = std::fs::read_to_string(&path).expect("a source file");
        // What stands below the tests' line draws nothing.
        let shown = text.split("#[cfg(test)]").next().unwrap_or_default();
        for (k, line) in shown.lines().enumerate() {
            // A spinner's size is no type.
            if has_a_literal(line) && !line.contains("Spinner") {
                found.push(format!("{}:{}: {}", path.display(), k + 1, line.trim()));
            }
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
    assert!(has_a_literal("text.size(12.0)") && has_a_literal("Color32::from_rgb(1, 2, 3)"));
    assert!(!has_a_literal("text.size(size::SMALL)"));
}
