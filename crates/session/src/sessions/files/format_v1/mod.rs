//! Version 1 of the session document, `truepose-session/1`.
//!
//! Reading goes from the tree that knows places ([`document`](crate::document)) straight to the domain
//! types, so that every complaint carries line, column and path; writing goes the same way back, over
//! the same declarations. The document speaks in degrees and mm; conversion happens here and nowhere
//! else. Keys that were not understood on reading are not written.
//!
//! A direction or a quaternion that is of unit length to within rounding is taken as it stands:
//! normalising it again would change its last bit at every saving.

#[doc(hidden)]
pub mod head;
pub(crate) mod inline;
#[doc(hidden)]
pub mod references;
#[doc(hidden)]
pub mod robot;
mod robot_beside;
#[doc(hidden)]
pub mod robot_parts;
#[doc(hidden)]
pub mod robot_source;

/// What the key `format` says.
pub(crate) const FORMAT: &str = "truepose-session/1";

/// The vector at unit length; `None` when it has no length.
pub(crate) fn unit<const N: usize>(vector: [f64; N]) -> Option<[f64; N]> {
    // Squares of very large or very small components would leave the range of a double.
    let largest = vector
        .iter()
        .fold(0.0_f64, |largest, v| largest.max(v.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return None;
    }
    let length_squared: f64 = vector.iter().map(|v| v * v).sum();
    if (length_squared - 1.0).abs() <= 8.0 * f64::EPSILON {
        return Some(vector);
    }
    let scaled = vector.map(|v| v / largest);
    let length = scaled.iter().map(|v| v * v).sum::<f64>().sqrt();
    Some(scaled.map(|v| v / length))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_vector_stays_as_it_is_and_any_other_becomes_one_once() {
        assert_eq!(unit([0.0, 0.0, 1.0]), Some([0.0, 0.0, 1.0]));
        assert_eq!(unit([0.0; 3]), None);
        for vector in [[1.0, 2.0, 3.0], [1e300, 1e300, 0.0], [1e-300, 0.0, 5e-301]] {
            let once = unit(vector).expect("it has a length");
            assert_eq!(unit(once), Some(once));
            assert!((once.iter().map(|v| v * v).sum::<f64>() - 1.0).abs() < 1e-15);
        }
    }
}
