//! What colours look like to people who see some of them alike, and how far two colours are apart:
//! for the tests of the tokens and of the scales of the plots.
//!
//! A colour is made linear (IEC 61966-2-1), multiplied by the matrix of the deficiency at full
//! severity (G. M. Machado, M. M. Oliveira, L. A. F. Fernandes: A physiologically-based model for
//! simulation of color vision deficiency, IEEE TVCG 15(6), 2009, table 1), and coded again.
//! Distances are ΔE*ab of CIE 1976 under D65: about 2.3 is just noticeable side by side. Contrast is
//! that of WCAG 2.2.

use egui::Color32;

/// How a person sees colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ColourVision {
    /// As most people do.
    Usual,
    /// Without the cones for long waves.
    Protanopia,
    /// Without those for middle ones.
    Deuteranopia,
    /// Without those for short ones.
    Tritanopia,
}

impl ColourVision {
    pub(crate) const ALL: [Self; 4] = [
        Self::Usual,
        Self::Protanopia,
        Self::Deuteranopia,
        Self::Tritanopia,
    ];

    /// Rows of the matrix on linear red, green and blue.
    fn matrix(self) -> [[f64; 3]; 3] {
        match self {
            Self::Usual => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            Self::Protanopia => [
                [0.152_286, 1.052_583, -0.204_868],
                [0.114_503, 0.786_281, 0.099_216],
                [-0.003_882, -0.048_116, 1.051_998],
            ],
            Self::Deuteranopia => [
                [0.367_322, 0.860_646, -0.227_968],
                [0.280_085, 0.672_501, 0.047_413],
                [-0.011_820, 0.042_940, 0.968_881],
            ],
            Self::Tritanopia => [
                [1.255_528, -0.076_749, -0.178_779],
                [-0.078_411, 0.930_809, 0.147_602],
                [0.004_733, 0.691_367, 0.303_900],
            ],
        }
    }
}

/// Red, green and blue as light, from 0 to 1.
fn linear(color: Color32) -> [f64; 3] {
    [color.r(), color.g(), color.b()].map(|byte| {
        let c = f64::from(byte) / 255.0;
        if c <= 0.04045 {
            c / 12.92
        } else {
            ((c + 0.055) / 1.055).powf(2.4)
        }
    })
}

fn through(matrix: [[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row.iter().zip(v).map(|(m, x)| m * x).sum())
}

/// Light of this colour as it is seen, within what a screen can show.
fn seen(color: Color32, sight: ColourVision) -> [f64; 3] {
    through(sight.matrix(), linear(color)).map(|c| c.clamp(0.0, 1.0))
}

/// L*, a*, b* of light under D65.
fn lab(light: [f64; 3]) -> [f64; 3] {
    const XYZ: [[f64; 3]; 3] = [
        [0.412_456, 0.357_576, 0.180_438],
        [0.212_673, 0.715_152, 0.072_175],
        [0.019_334, 0.119_192, 0.950_304],
    ];
    const WHITE: [f64; 3] = [0.950_47, 1.0, 1.088_83];
    let xyz = through(XYZ, light);
    let f = |k: usize| {
        let t = xyz[k] / WHITE[k];
        if t > 216.0 / 24389.0 {
            t.cbrt()
        } else {
            (24389.0 / 27.0 * t + 16.0) / 116.0
        }
    };
    let (x, y, z) = (f(0), f(1), f(2));
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Perceived distance of two colours, ΔE*ab.
pub(crate) fn colour_distance(a: Color32, b: Color32, sight: ColourVision) -> f64 {
    let (a, b) = (lab(seen(a, sight)), lab(seen(b, sight)));
    let squares = a.iter().zip(b).map(|(a, b)| (a - b).powi(2));
    squares.sum::<f64>().sqrt()
}

/// Perceived lightness of a colour, L*: from 0, black, to 100, white.
pub(crate) fn lightness(color: Color32, sight: ColourVision) -> f64 {
    lab(seen(color, sight))[0]
}

/// Contrast of two colours: from 1, none, to 21, black on white.
pub(crate) fn contrast(a: Color32, b: Color32) -> f64 {
    let luminance = |color| {
        let [r, g, b] = linear(color);
        0.2126 * r + 0.7152 * g + 0.0722 * b
    };
    let (a, b): (f64, f64) = (luminance(a), luminance(b));
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

#[test]
fn greys_look_the_same_to_everybody_and_each_deficiency_takes_its_own_pair_of_colours() {
    let grey = Color32::from_gray(128);
    for sight in ColourVision::ALL {
        let [r, g, b] = seen(grey, sight);
        assert!((r - g).abs() < 1e-4 && (g - b).abs() < 1e-4, "{sight:?}");
    }
    let (red, green) = (
        Color32::from_rgb(200, 60, 40),
        Color32::from_rgb(110, 130, 30),
    );
    let (blue, teal) = (
        Color32::from_rgb(60, 90, 190),
        Color32::from_rgb(0, 120, 130),
    );
    let left =
        |a, b, sight| colour_distance(a, b, sight) / colour_distance(a, b, ColourVision::Usual);
    assert!(left(red, green, ColourVision::Deuteranopia) < 0.5);
    assert!(left(red, green, ColourVision::Protanopia) < 0.7);
    assert!(left(red, green, ColourVision::Tritanopia) > 0.8);
    assert!(left(blue, teal, ColourVision::Tritanopia) < 0.5);
    assert!(left(blue, teal, ColourVision::Deuteranopia) > 0.6);
}

#[test]
fn contrast_and_lightness_are_those_of_their_definitions() {
    let (black, white) = (Color32::BLACK, Color32::WHITE);
    assert!((contrast(black, white) - 21.0).abs() < 1e-9);
    assert!((contrast(Color32::from_gray(0x76), white) - 4.54).abs() < 0.01);
    assert!((lightness(white, ColourVision::Usual) - 100.0).abs() < 1e-2);
    // CIE: a grey of 18 % is half as light as white.
    assert!((lightness(Color32::from_gray(0x77), ColourVision::Usual) - 50.0).abs() < 0.5);
    assert!((colour_distance(black, white, ColourVision::Usual) - 100.0).abs() < 1e-2);
}
