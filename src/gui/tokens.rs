//! Colour, spacing and type of the window, in one place.
//!
//! Colours say one thing each: orange is before, blue is after, magenta is outside the tolerance.
//! They stay apart for people who see red and green alike, every meaning has a shape or a word
//! beside its colour, and a test holds text to a contrast of 4.5 : 1 on everything it stands on.

use std::sync::Arc;

use egui::style::{NumericColorSpace, WidgetVisuals};
use egui::{
    Color32, Context, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, Margin, Shadow,
    Stroke, Style, TextStyle, Theme, Ui, Vec2, Visuals,
};

/// What every colour is for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Palette {
    /// Behind everything.
    pub(crate) background: Color32,
    /// Cards and plots.
    pub(crate) surface: Color32,
    /// Fields and quiet buttons.
    pub(crate) inset: Color32,
    /// Hairlines.
    pub(crate) line: Color32,
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
    /// From little to much, away from the surface: lightness alone tells the order.
    pub(crate) scale: [Color32; STOPS],
    /// Around the circle, from the right over up: opposite directions differ in blue and orange,
    /// or in lightness, which everybody sees.
    pub(crate) cycle: [Color32; STOPS],
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
    text: rgb(0x15202B),
    muted: rgb(0x52606E),
    accent: rgb(0x0B5F7A),
    on_accent: rgb(0xFFFFFF),
    accent_soft: rgb(0xDDEEF3),
    before: rgb(0xA84B06),
    after: rgb(0x0A5CA3),
    nominal: rgb(0x8895A2),
    within: rgb(0x0A6B4F),
    outside: rgb(0xA3195B),
    warning: rgb(0x7A5600),
    sectors: [rgb(0xEEF3F6), rgb(0xE0E9EE)],
    scale: scale([
        0xDDC04E, 0xB9B551, 0x91A85F, 0x669A6E, 0x40887A, 0x2A7082, 0x2A547E, 0x2F3670,
    ]),
    cycle: scale([
        0x1B62B5, 0x2A4878, 0x33333D, 0x7C4D22, 0xC46A0C, 0xC59160, 0xBFB8AB, 0x6F8EB2,
    ]),
};

/// For a dim one.
pub(crate) const DARK: Palette = Palette {
    background: rgb(0x11161C),
    surface: rgb(0x181E26),
    inset: rgb(0x242C37),
    line: rgb(0x2D3744),
    text: rgb(0xE7ECF1),
    muted: rgb(0x9DAAB8),
    accent: rgb(0x63C4DB),
    on_accent: rgb(0x06222B),
    accent_soft: rgb(0x17333D),
    before: rgb(0xF2A65E),
    after: rgb(0x74B9F4),
    nominal: rgb(0x6C7B8A),
    within: rgb(0x5FCBA4),
    outside: rgb(0xF48FBB),
    warning: rgb(0xE6C05C),
    sectors: [rgb(0x1D252E), rgb(0x232D38)],
    scale: scale([
        0x4C5BA6, 0x4373B0, 0x408AB0, 0x4C9FA4, 0x68B295, 0x93C284, 0xC4D077, 0xF6DE72,
    ]),
    cycle: scale([
        0x4E9CF0, 0x9CC3EC, 0xEDEBE4, 0xF0C392, 0xEF9435, 0xAE8152, 0x6B6B78, 0x5B84B6,
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
    /// Height of fields and buttons.
    pub(crate) const CONTROL: f32 = 28.0;
    /// Rounding of fields, buttons and cards.
    pub(crate) const ROUND: u8 = 6;
}

/// Sizes of type, in points.
pub(crate) mod size {
    /// Captions and axis labels.
    pub(crate) const SMALL: f32 = 11.5;
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
    add(
        "Inter",
        include_bytes!("../../assets/fonts/Inter-Regular.ttf"),
    );
    add(
        "Inter SemiBold",
        include_bytes!("../../assets/fonts/Inter-SemiBold.ttf"),
    );
    let fallback = fonts
        .families
        .get(&FontFamily::Proportional)
        .cloned()
        .unwrap_or_default();
    let with = |first: &str| {
        let mut family = vec![first.to_owned()];
        family.extend(fallback.iter().cloned());
        // The only default font with arrows and mathematical signs in it.
        family.push("Hack".to_owned());
        family
    };
    fonts
        .families
        .insert(FontFamily::Proportional, with("Inter"));
    fonts
        .families
        .insert(FontFamily::Name("strong".into()), with("Inter SemiBold"));
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
    visuals.widgets.inactive = widget(palette.inset, Color32::TRANSPARENT, palette.text);
    visuals.widgets.hovered = widget(hover, palette.nominal, palette.text);
    visuals.widgets.active = widget(palette.accent_soft, palette.accent, palette.text);
    visuals.widgets.open = widget(hover, palette.line, palette.text);
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
        color: Color32::from_black_alpha(40),
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
    use super::*;

    /// Relative luminance as in WCAG 2.2.
    fn luminance(color: Color32) -> f64 {
        let linear = |byte: u8| {
            let c = f64::from(byte) / 255.0;
            if c <= 0.04045 {
                c / 12.92
            } else {
                ((c + 0.055) / 1.055).powf(2.4)
            }
        };
        0.2126 * linear(color.r()) + 0.7152 * linear(color.g()) + 0.0722 * linear(color.b())
    }

    fn contrast(a: Color32, b: Color32) -> f64 {
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn every_text_colour_has_a_contrast_of_at_least_four_and_a_half_to_one() {
        for (theme, p) in [("light", LIGHT), ("dark", DARK)] {
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
            let grounds = [
                p.background,
                p.surface,
                p.inset,
                p.accent_soft,
                p.sectors[1],
            ];
            for (name, text) in texts {
                for ground in grounds {
                    let found = contrast(text, ground);
                    assert!(found >= 4.5, "{theme} {name} on {ground:?}: {found:.2}");
                }
            }
            assert!(contrast(p.on_accent, p.accent) >= 4.5, "{theme} on accent");
        }
    }

    #[test]
    fn a_scale_is_ordered_by_lightness_away_from_the_surface() {
        for (theme, p) in [("light", LIGHT), ("dark", DARK)] {
            let from_surface = p.scale.map(|c| contrast(c, p.surface));
            assert!(from_surface[0] >= 1.7, "{theme}: {from_surface:?}");
            for pair in from_surface.windows(2) {
                assert!(pair[1] > 1.08 * pair[0], "{theme}: {from_surface:?}");
            }
        }
    }

    #[test]
    fn opposite_directions_stay_apart_without_red_and_green() {
        for p in [LIGHT, DARK] {
            for k in 0..STOPS / 2 {
                let (here, there) = (p.cycle[k], p.cycle[k + STOPS / 2]);
                let (a, b) = (seen_without_green(here), seen_without_green(there));
                let apart = (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
                assert!(apart > 60.0, "{k}: {apart}");
            }
        }
    }

    /// Colours as a dichromat sees them (Viénot, Brettel & Mollon 1999, deuteranopia).
    fn seen_without_green(color: Color32) -> [f64; 3] {
        let [r, g, b] = [color.r(), color.g(), color.b()].map(f64::from);
        let linear = |c: f64| (c / 255.0).powf(2.2);
        let (r, g, b) = (linear(r), linear(g), linear(b));
        let yellow = 0.29275 * r + 0.70725 * g;
        let blue = -0.02234 * r + 0.02234 * g + b;
        [yellow, yellow, blue].map(|c| c.max(0.0).powf(1.0 / 2.2) * 255.0)
    }

    #[test]
    fn before_and_after_stay_apart_without_red_and_green() {
        for p in [LIGHT, DARK] {
            let (a, b) = (seen_without_green(p.before), seen_without_green(p.after));
            let apart = (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
            assert!(apart > 60.0, "{apart}");
        }
    }
}
