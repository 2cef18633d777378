//! The units of effects' parameters: how a person writes them, and what they are inside.

/// A unit of a parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// As it is written behind a number.
    pub symbol: &'static str,
    /// Inner units (mm, rad, s, kg, K, N·m) in one of it.
    pub scale: f64,
    /// The largest plausible value, inner units: a turn of one radian, a metre, a scale of two. What is uncertain
    /// within this range is not determined.
    pub reach: f64,
    /// Whether a coefficient in it turns what is behind it.
    pub turns: bool,
    /// A size that can be seen in a simulation, in this unit.
    pub example: f64,
}

/// One degree in rad.
pub(crate) const DEGREE: f64 = std::f64::consts::PI / 180.0;
/// One part in a million.
const PPM: f64 = 1e-6;
/// One milliradian in rad.
pub(crate) const MILLIRADIAN: f64 = 1e-3;

impl Unit {
    const fn new(symbol: &'static str, inner: f64, reach: f64, example: f64) -> Self {
        Self {
            symbol,
            scale: inner,
            reach,
            turns: false,
            example,
        }
    }

    const fn turning(self) -> Self {
        Self {
            turns: true,
            ..self
        }
    }

    /// The same with another size for a simulation.
    #[must_use]
    pub const fn with_example(self, example: f64) -> Self {
        Self { example, ..self }
    }

    /// Degrees.
    pub const DEGREE: Self = Self::new("°", DEGREE, 1.0, 0.05).turning();
    /// Milliradians.
    pub const MILLIRADIAN: Self = Self::new("mrad", MILLIRADIAN, 1.0, 1.0).turning();
    /// Radians.
    pub const RADIAN: Self = Self::new("rad", 1.0, 1.0, 0.001).turning();
    /// Millimetres.
    pub const MM: Self = Self::new("mm", 1.0, 1000.0, 0.2);
    /// Parts in a million.
    pub const PPM: Self = Self::new("ppm", PPM, 1.0, 50.0);
    /// Seconds.
    pub const SECOND: Self = Self::new("s", 1.0, 100.0, 0.01);
    /// A number without a unit: a ratio, an order.
    pub const ONE: Self = Self::new("", 1.0, 1000.0, 0.001);
    /// A component of a direction.
    pub const DIRECTION: Self = Self::new("", 1.0, 1000.0, 0.001).turning();
    /// Degrees per kelvin.
    pub const DEGREE_PER_KELVIN: Self = Self::new("°/°C", DEGREE, 1.0, 0.002);
    /// Millimetres per kelvin.
    pub const MM_PER_KELVIN: Self = Self::new("mm/°C", 1.0, 1.0, 0.002);
    /// Parts in a million per kelvin.
    pub const PPM_PER_KELVIN: Self = Self::new("ppm/°C", PPM, 1.0, 50.0);
    /// Millimetres per hour.
    pub const MM_PER_HOUR: Self = Self::new("mm/h", 1.0 / 3600.0, 1000.0, 0.2);
    /// Millimetres per kilogram.
    pub const MM_PER_KG: Self = Self::new("mm/kg", 1.0, 1000.0, 0.2);
    /// Microradians per newton metre.
    pub const MICRORADIAN_PER_NM: Self = Self::new("µrad/(N·m)", 1e-6, 1.0, 50.0);

    /// Units by how the name of a parameter in them ends.
    const BY_ENDING: [(&str, Self); 12] = [
        ("deg", Self::DEGREE),
        ("mrad", Self::MILLIRADIAN),
        ("rad", Self::RADIAN),
        ("mm", Self::MM),
        ("ppm", Self::PPM),
        ("s", Self::SECOND),
        ("deg_per_degc", Self::DEGREE_PER_KELVIN),
        ("mm_per_degc", Self::MM_PER_KELVIN),
        ("ppm_per_degc", Self::PPM_PER_KELVIN),
        ("mm_per_h", Self::MM_PER_HOUR),
        ("mm_per_kg", Self::MM_PER_KG),
        ("urad_per_nm", Self::MICRORADIAN_PER_NM),
    ];

    /// The quantity in the name of a parameter (empty where it is a unit alone), and its unit.
    pub fn of_name(name: &str) -> (&str, Self) {
        let named = Self::BY_ENDING.into_iter().find_map(|(ending, unit)| {
            let stem = name.strip_suffix(ending)?;
            let is_all = stem.is_empty();
            Some((stem.strip_suffix('_').or(is_all.then_some(""))?, unit))
        });
        named.unwrap_or((name, Self::ONE))
    }
}
