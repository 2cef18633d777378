//! Chances and quantiles of Student's t, of F and of the beta distribution, for any number of degrees
//! of freedom.
//!
//! The continued fraction of the incomplete beta function converges in about √ν terms: statrs stops at
//! 140, and its inverse does not end at ν = 10⁷. Beyond `MANY` degrees of freedom the fraction gets as
//! many terms as it needs, and the quantile of t is its asymptotic expansion, which is exact to more
//! digits there:
//!
//! ```text
//! t_p ≈ z + (z³+z)/4ν + (5z⁵+16z³+3z)/96ν² + (3z⁷+19z⁵+17z³−15z)/384ν³      (Abramowitz & Stegun 26.7.5)
//! I_x(a, b) = xᵃ (1−x)ᵇ / (a B(a, b)) · 1/(1 + d₁/(1 + d₂/(1 + …)))                           (26.5.8)
//! P(F > f) = I_x(ν₂/2, ν₁/2),   x = ν₂ / (ν₂ + ν₁ f)                                           (26.6.2)
//! ```

use statrs::distribution::{ContinuousCDF, Normal, StudentsT};
use statrs::function::beta::beta_reg;
use statrs::function::gamma::ln_gamma;

/// Medians of χ with one, two and three degrees of freedom: of the length of so many coordinates with σ = 1.
pub const CHI_MEDIANS: [f64; 3] = [0.674_49, 1.177_41, 1.538_17];
/// Degrees of freedom from which on statrs is not asked.
const MANY: f64 = 1e4;
/// Terms of the fraction that are enough for 10¹¹ degrees of freedom.
const MOST_TERMS: u32 = 1_000_000;

/// The value below which Student's t with so many degrees of freedom is with this chance.
pub fn t_quantile(chance: f64, freedom: f64) -> f64 {
    if freedom < MANY
        && let Ok(t) = StudentsT::new(0.0, 1.0, freedom)
    {
        return t.inverse_cdf(chance);
    }
    let z = Normal::standard().inverse_cdf(chance);
    let (z2, nu) = (z * z, freedom);
    let first = z * (z2 + 1.0) / 4.0;
    let second = z * (3.0 + z2 * (16.0 + z2 * 5.0)) / 96.0;
    let third = z * (-15.0 + z2 * (17.0 + z2 * (19.0 + z2 * 3.0))) / 384.0;
    z + (first + (second + third / nu) / nu) / nu
}

/// The chance that F with these degrees of freedom is above `f`.
pub fn f_tail(f: f64, above: f64, below: f64) -> f64 {
    if f.is_nan() || f <= 0.0 {
        return 1.0;
    }
    beta_below(0.5 * below, 0.5 * above, (above * f / below).ln_1p())
}

/// `I_x(a, b)` of `x = exp(−minus_ln_x)`: the chance that a beta variable is below x.
pub fn beta_below(a: f64, b: f64, minus_ln_x: f64) -> f64 {
    let x = (-minus_ln_x).exp();
    if 2.0 * a.max(b) < MANY {
        return beta_reg(a, b, x.clamp(0.0, 1.0));
    }
    // Not 1 − x: x is near 1 where a is large.
    let rest = -(-minus_ln_x).exp_m1();
    if rest <= 0.0 || x <= 0.0 {
        return if x > 0.0 { 1.0 } else { 0.0 };
    }
    let ln_front = ln_gamma(a + b) - ln_gamma(a) - ln_gamma(b) - a * minus_ln_x + b * rest.ln();
    let front = ln_front.exp();
    if x < (a + 1.0) / (a + b + 2.0) {
        front * fraction(a, b, x) / a
    } else {
        1.0 - front * fraction(b, a, rest) / b
    }
}

/// The continued fraction, by Lentz's method.
fn fraction(a: f64, b: f64, x: f64) -> f64 {
    let away_from_zero = |v: f64| if v.abs() < 1e-290 { 1e-290 } else { v };
    let mut c = 1.0;
    let mut d = 1.0 / away_from_zero(1.0 - (a + b) * x / (a + 1.0));
    let mut value = d;
    for term in 1..MOST_TERMS {
        let m = f64::from(term);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        let before = value;
        for step in [even, odd] {
            d = 1.0 / away_from_zero(1.0 + step * d);
            c = away_from_zero(1.0 + step / c);
            value *= c * d;
        }
        if (value - before).abs() <= 4.0 * f64::EPSILON * value.abs() {
            break;
        }
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn student_is_continuous_where_the_expansion_begins_and_right_beyond() {
        for chance in [0.6, 0.975, 0.9995, 0.025] {
            let below = t_quantile(chance, MANY * (1.0 - 1e-12));
            let above = t_quantile(chance, MANY);
            assert!((below / above - 1.0).abs() < 1e-9, "{below} {above}");
        }
        // scipy.stats.t.ppf(0.975, [1e5, 1e7, 3e9])
        for (freedom, t) in [
            (1e5, 1.959_987_707_534_609),
            (1e7, 1.959_964_221_767_205),
            (3e9, 1.959_963_985_330_811),
        ] {
            let found = t_quantile(0.975, freedom);
            assert!((found - t).abs() < 1e-9, "{freedom}: {found}");
        }
        assert!((t_quantile(0.975, f64::INFINITY) - 1.959_963_984_540_054).abs() < 1e-9);
    }

    #[test]
    fn f_is_continuous_and_right_for_few_and_for_many_degrees_of_freedom() {
        // scipy.stats.f.sf
        for (f, above, below, chance) in [
            (1.235, 504.0, 108.0, 0.089_846_812_268_990),
            (5.0, 3.0, 1e7, 0.001_816_657_939_558),
            (4.0, 3.0, 2.1e4, 0.007_393_930_231_164),
            (1.001, 1e7, 1e7, 0.057_013_514_704_194),
            (1.002, 3e6, 8e6, 0.018_430_220_493_089),
            (1.03, 2.1e4, 2.1e4, 0.016_109_853_386_898),
            (1.2, 500.0, 3e4, 0.001_510_240_460_476),
            (1.2, 3e4, 500.0, 0.002_922_065_309_509),
            (1.1, 1e6, 1e3, 0.018_676_227_141_136),
            (1.3, 300.0, 1e7, 0.000_353_690_730_165),
            (1.02, 5e4, 4e4, 0.018_478_663_202_352),
            (0.99, 1e5, 1e6, 0.983_762_867_198_665),
            (1.5, 1e7, 50.0, 0.033_602_452_250_649),
            (2.0, 10.0, 19_999.0, 0.029_309_452_795_614),
        ] {
            let found = f_tail(f, above, below);
            assert!(
                (found / chance - 1.0).abs() < 1e-6,
                "{f} {above} {below}: {found} instead of {chance}"
            );
        }
        let near = |above: f64, below: f64, f: f64| {
            let step = 1.0 + 1e-9;
            let (one, other) = (
                f_tail(f, above / step, below / step),
                f_tail(f, above, below),
            );
            assert!(
                (one / other - 1.0).abs() < 1e-4,
                "{above} {below}: {one} {other}"
            );
        };
        near(3.0, MANY, 5.0);
        near(MANY, MANY, 1.03);
        near(500.0, MANY, 1.2);
        near(MANY, 500.0, 1.2);
        near(MANY, 3.0, 9.0);
        assert!(f_tail(0.0, 3.0, 1e7) == 1.0 && f_tail(f64::NAN, 3.0, 1e7) == 1.0);
    }

    #[test]
    fn the_beta_distribution_is_continuous_where_the_expansion_begins() {
        for b in [0.5, 1.5, 4.0] {
            for x in [0.3, 2.0, 40.0] {
                let a = 0.5 * MANY + 1.0;
                let (exact, near) = (beta_reg(a, b, (-x / a).exp()), beta_below(a, b, x / a));
                assert!((near / exact - 1.0).abs() < 1e-8, "{b} {x}: {near} {exact}");
            }
        }
    }
}
