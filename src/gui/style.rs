//! Colour, spacing and type of the window, in one place.
//!
//! Colours say one thing each, and no colour says it alone:
//!
//! | meaning | colour | second sign |
//! |---|---|---|
//! | before the model | orange | in charts a ring where after is a disc; the word in every legend, and the place: always first, left of the arrow |
//! | after it | blue | a disc; the word, and the place: always second, right of the arrow |
//! | within the tolerance | green | a disc in plots and tables; the count in words |
//! | outside | magenta | a diamond in plots and tables; the count in words |
//! | worth a look | amber | the word "warning", or a sentence that says what |
//! | went wrong | magenta | the word "error", or a sentence that says what |
//! | can be done next | teal, filled | the only filled button, at the foot of its panel |
//! | chosen | pale teal | heavier type in a switch or step, a frame around a sample |
//! | has the keyboard | teal ring | the ring itself: nothing else has one |
//! | regions | two greys, in turn | number and boundary line of each |
//! | a step is done | filled circle | a tick in place of the number, and a caption in words |
//! | size of a deviation | a scale | ordered by lightness; the legend has numbers, the vector its length |
//!
//! Tests hold text to a contrast of 4.5 : 1 and marks, outlines and the focus ring to 3 : 1 on
//! everything they stand on, in both themes, and pairs of meanings apart for people who see some
//! colours alike (`vision`). No other file of the window has a colour or a size of type in it.

use std::sync::Arc;

use egui::style::{NumericColorSpace, WidgetVisuals};
use egui::{
    Color32, Context, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, Margin, Shadow,
    Stroke, Style, TextStyle, Theme, Ui, Vec2, Visuals,
};

#[cfg(test)]
#[path = "../../tests/support/vision.rs"]
pub(crate) mod testing;

/// What every colour is for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Palette {
    /// Behind everything.
    pub(crate) background: Color32,
    /// Cards and plots.
    pub(crate) surface: Color32,
    /// Fields and quiet buttons.
    pub(crate) inset: Color32,
    /// Hairlines, which say nothing: what they part is apart without them.
    pub(crate) line: Color32,
    /// The edge of what can be pressed or filled in.
    pub(crate) outline: Color32,
    /// Text that is read.
    pub(crate) text: Color32,
    /// Text beside it: units, captions, hints.
    pub(crate) muted: Color32,
    /// What can be done next.
    pub(crate) accent: Color32,
    /// Text on the accent.
    pub(crate) on_accent: Color32,
    /// A chosen row.
    pub(crate) accent_soft: Color32,
    /// The deviation of the nominal robot.
    pub(crate) before: Color32,
    /// The deviation of the model.
    pub(crate) after: Color32,
    /// The nominal path; never text.
    pub(crate) nominal: Color32,
    /// Within the tolerance.
    pub(crate) within: Color32,
    /// Outside the tolerance, and what went wrong.
    pub(crate) outside: Color32,
    /// Worth a look.
    pub(crate) warning: Color32,
    /// Sectors, alternately.
    pub(crate) sectors: [Color32; 2],
    /// What lies over the window behind a sheet or a notice.
    pub(crate) veil: Color32,
    /// What floats throws this.
    pub(crate) shadow: Color32,
    /// From little to much, away from the surface: lightness alone tells the order.
    pub(crate) scale: [Color32; STOPS],
}

/// Colours of a scale; between them it is linear.
pub(crate) const STOPS: usize = 8;

const fn scale(hex: [u32; STOPS]) -> [Color32; STOPS] {
    let mut colors = [Color32::BLACK; STOPS];
    let mut k = 0;
    while k < STOPS {
        colors[k] = rgb(hex[k]);
        k += 1;
    }
    colors
}

const fn rgb(hex: u32) -> Color32 {
    let [_, r, g, b] = hex.to_be_bytes();
    Color32::from_rgb(r, g, b)
}

/// For a bright hall.
pub(crate) const LIGHT: Palette = Palette {
    background: rgb(0xF4F6F8),
    surface: rgb(0xFFFFFF),
    inset: rgb(0xEAEEF2),
    line: rgb(0xDAE0E6),
    outline: rgb(0x7C8A98),
    text: rgb(0x15202B),
    muted: rgb(0x52606E),
    accent: rgb(0x0B5F7A),
    on_accent: rgb(0xFFFFFF),
    accent_soft: rgb(0xDDEEF3),
    before: rgb(0xA84B06),
    after: rgb(0x0A5CA3),
    nominal: rgb(0x6F7D8B),
    within: rgb(0x2F6A3A),
    outside: rgb(0x8B0F72),
    warning: rgb(0x7A5600),
    sectors: [rgb(0xEEF3F6), rgb(0xE0E9EE)],
    veil: Color32::from_black_alpha(90),
    shadow: Color32::from_black_alpha(40),
    scale: scale([
        0xDDC04E, 0xB9B551, 0x91A85F, 0x669A6E, 0x40887A, 0x2A7082, 0x2A547E, 0x2F3670,
    ]),
};

/// For a dim one.
pub(crate) const DARK: Palette = Palette {
    background: rgb(0x11161C),
    surface: rgb(0x181E26),
    inset: rgb(0x242C37),
    line: rgb(0x2D3744),
    outline: rgb(0x6E7D8C),
    text: rgb(0xE7ECF1),
    muted: rgb(0x9DAAB8),
    accent: rgb(0x63C4DB),
    on_accent: rgb(0x06222B),
    accent_soft: rgb(0x17333D),
    before: rgb(0xF2A65E),
    after: rgb(0x74B9F4),
    nominal: rgb(0x7C8B9A),
    within: rgb(0x8FDB9A),
    outside: rgb(0xFA73BF),
    warning: rgb(0xE6C05C),
    sectors: [rgb(0x1D252E), rgb(0x232D38)],
    veil: Color32::from_black_alpha(140),
    shadow: Color32::from_black_alpha(120),
    scale: scale([
        0x4C5BA6, 0x4373B0, 0x408AB0, 0x4C9FA4, 0x68B295, 0x93C284, 0xC4D077, 0xF6DE72,
    ]),
};

impl Palette {
    /// The palette that a panel is drawn with.
    pub(crate) fn of(ui: &Ui) -> Self {
        if ui.visuals().dark_mode { DARK } else { LIGHT }
    }
}

/// Distances, in points: multiples of four.
pub(crate) mod space {
    /// Between things that belong together.
    pub(crate) const TIGHT: f32 = 4.0;
    /// Between rows.
    pub(crate) const ROW: f32 = 8.0;
    /// Inside panels.
    pub(crate) const PANEL: i8 = 16;
    /// Room around what a sheet says: half as much again as in a panel, which has the window's edge beside it.
    pub(crate) const SHEET: i8 = PANEL + PANEL / 2;
    /// Around plots.
    pub(crate) const PLOT: i8 = 12;
    /// Inside cards.
    pub(crate) const CARD: i8 = 14;
    /// Height of fields and buttons.
    pub(crate) const CONTROL: f32 = 28.0;
    /// Height of a row with what stands side by side to be chosen from.
    pub(crate) const ROW_HEIGHT: f32 = 34.0;
    /// Height of the one button that stands out.
    pub(crate) const PRIMARY: f32 = 36.0;
    /// Rounding of fields, buttons and cards.
    pub(crate) const ROUND: u8 = 6;
    /// Width of the ring around what has the keyboard.
    pub(crate) const RING: f32 = 2.0;
    /// Between contents and the edge of their panel: a scroll bar stands in it.
    pub(crate) const GUTTER: f32 = 11.0;
    /// Width of a tip.
    pub(crate) const TIP: f32 = 280.0;
    /// Longer lines of text are hard to read.
    pub(crate) const LINE: f32 = 520.0;
}

/// Sizes of type, in points.
pub(crate) mod size {
    /// A sign within a sign.
    pub(crate) const TINY: f32 = 10.0;
    /// Captions and axis labels.
    pub(crate) const SMALL: f32 = 11.5;
    /// Sentences that explain.
    pub(crate) const NOTE: f32 = 12.0;
    /// Text.
    pub(crate) const BODY: f32 = 13.0;
    /// Headings of panels.
    pub(crate) const HEADING: f32 = 16.0;
    /// The one number that matters.
    pub(crate) const DISPLAY: f32 = 26.0;
}

/// The heavier weight, for headings and numbers that matter.
pub(crate) fn strong(size: f32) -> FontId {
    FontId::new(size, FontFamily::Name("strong".into()))
}

/// Fonts, type sizes, spacing and colours of both themes.
pub(crate) fn apply(ctx: &Context) {
    ctx.set_fonts(fonts());
    ctx.set_style_of(Theme::Light, style(&LIGHT, Visuals::light()));
    ctx.set_style_of(Theme::Dark, style(&DARK, Visuals::dark()));
}

fn fonts() -> FontDefinitions {
    let mut fonts = FontDefinitions::default();
    let mut add = |name: &str, bytes: &'static [u8]| {
        let data = Arc::new(FontData::from_static(bytes));
        fonts.font_data.insert(name.to_owned(), data);
    };
    add("Inter", crate::fonts::INTER);
    add("Inter SemiBold", crate::fonts::INTER_SEMI_BOLD);
    add("Noto Sans SC", crate::fonts::NOTO_SANS_SC);
    add(
        "Phosphor",
        include_bytes!("../../assets/fonts/Phosphor.ttf"),
    );
    let fallback = fonts
        .families
        .get(&FontFamily::Proportional)
        .cloned()
        .unwrap_or_default();
    let with = |first: &str| {
        // Icons before the default fonts, which have others in their places.
        let mut family = vec![first.to_owned(), "Phosphor".to_owned()];
        family.extend(fallback.iter().cloned());
        // The only default font with arrows and mathematical signs in it.
        family.push("Hack".to_owned());
        family.push("Noto Sans SC".to_owned());
        family
    };
    fonts
        .families
        .insert(FontFamily::Proportional, with("Inter"));
    fonts
        .families
        .insert(FontFamily::Name("strong".into()), with("Inter SemiBold"));
    let monospaced = fonts.families.entry(FontFamily::Monospace).or_default();
    monospaced.push("Noto Sans SC".to_owned());
    fonts
}

fn style(palette: &Palette, visuals: Visuals) -> Style {
    let mut style = Style {
        visuals: dressed(palette, visuals),
        ..Style::default()
    };
    let regular = |size| FontId::new(size, FontFamily::Proportional);
    style.text_styles = [
        (TextStyle::Small, regular(size::SMALL)),
        (TextStyle::Body, regular(size::BODY)),
        (TextStyle::Button, regular(size::BODY)),
        (TextStyle::Heading, strong(size::HEADING)),
        (
            TextStyle::Monospace,
            FontId::new(size::SMALL, FontFamily::Monospace),
        ),
    ]
    .into();
    let spacing = &mut style.spacing;
    spacing.item_spacing = Vec2::new(space::ROW, space::ROW);
    spacing.button_padding = Vec2::new(10.0, 5.0);
    spacing.interact_size = Vec2::new(44.0, space::CONTROL);
    spacing.slider_width = 120.0;
    spacing.slider_rail_height = 4.0;
    spacing.icon_width = 16.0;
    spacing.icon_width_inner = 9.0;
    spacing.menu_margin = Margin::same(6);
    spacing.window_margin = Margin::same(20);
    spacing.combo_width = 120.0;
    // What is longer than its panel shows where it goes on.
    let scroll = &mut spacing.scroll;
    scroll.bar_width = 8.0;
    scroll.floating_width = 5.0;
    scroll.floating_allocated_width = space::GUTTER;
    scroll.dormant_handle_opacity = 0.5;
    scroll.active_handle_opacity = 0.7;
    scroll.fade.size = 28.0;
    style.animation_time = 0.08;
    style.interaction.tooltip_delay = 0.15;
    style.interaction.show_tooltips_only_when_still = false;
    style
}

fn dressed(palette: &Palette, mut visuals: Visuals) -> Visuals {
    let round = CornerRadius::same(space::ROUND);
    let widget = |fill: Color32, border: Color32, text: Color32| WidgetVisuals {
        bg_fill: fill,
        weak_bg_fill: fill,
        bg_stroke: Stroke::new(1.0, border),
        corner_radius: round,
        fg_stroke: Stroke::new(1.0, text),
        expansion: 0.0,
    };
    let mix = |a: Color32, b: Color32, t: f32| a.lerp_to_gamma(b, t);
    let hover = mix(palette.inset, palette.text, 0.07);
    visuals.widgets.noninteractive = widget(palette.surface, palette.line, palette.text);
    visuals.widgets.inactive = widget(palette.inset, palette.outline, palette.text);
    visuals.widgets.hovered = widget(hover, palette.text, palette.text);
    visuals.widgets.active = widget(palette.accent_soft, palette.accent, palette.text);
    visuals.widgets.open = widget(hover, palette.outline, palette.text);
    visuals.override_text_color = None;
    visuals.weak_text_color = Some(palette.muted);
    visuals.hyperlink_color = palette.accent;
    visuals.selection.bg_fill = palette.accent_soft;
    visuals.selection.stroke = Stroke::new(1.5, palette.accent);
    visuals.panel_fill = palette.background;
    visuals.window_fill = palette.surface;
    visuals.window_stroke = Stroke::new(1.0, palette.line);
    visuals.window_corner_radius = CornerRadius::same(10);
    visuals.menu_corner_radius = CornerRadius::same(8);
    let shadow = Shadow {
        offset: [0, 6],
        blur: 20,
        spread: 0,
        color: palette.shadow,
    };
    visuals.window_shadow = shadow;
    visuals.popup_shadow = shadow;
    visuals.faint_bg_color = mix(palette.surface, palette.inset, 0.5);
    visuals.extreme_bg_color = palette.surface;
    visuals.text_edit_bg_color = Some(palette.inset);
    visuals.code_bg_color = palette.inset;
    visuals.warn_fg_color = palette.warning;
    visuals.error_fg_color = palette.outside;
    visuals.slider_trailing_fill = true;
    visuals.handle_shape = egui::style::HandleShape::Circle;
    visuals.numeric_color_space = NumericColorSpace::GammaByte;
    visuals
}

#[cfg(test)]
mod tests {
    //! What the colours are held to.

    use std::path::{Path, PathBuf};

    use egui::Color32;

    use super::{DARK, LIGHT, Palette};
    use crate::gui::style::testing::{ColourVision, colour_distance, contrast, lightness};

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

    /// Files of the window, without this one and what only tests see.
    fn sources() -> Vec<PathBuf> {
        fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
            let entries = std::fs::read_dir(folder).expect("a folder of the window");
            for entry in entries {
                let path = entry.expect("an entry of the folder").path();
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                if path.is_dir() {
                    walk(&path, found);
                } else if name.ends_with(".rs") && !path.ends_with("gui/style.rs") {
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
                // A spinner's size is no type, and a picture has its own colours.
                let other = ["Spinner", "Shape::image"].iter().any(|o| line.contains(o));
                if has_a_literal(line) && !other {
                    found.push(format!("{}:{}: {}", path.display(), k + 1, line.trim()));
                }
            }
        }
        assert!(found.is_empty(), "{}", found.join("\n"));
        assert!(has_a_literal("text.size(12.0)") && has_a_literal("Color32::from_rgb(1, 2, 3)"));
        assert!(!has_a_literal("text.size(size::SMALL)"));
    }
}
