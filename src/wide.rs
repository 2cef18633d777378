//! Lets hot loops use the processor's wide vectors where it has them.
//!
//! A program that has to start on every x86-64 processor is compiled for vectors of two doubles.
//! [`wide`] compiles what it is given a second time for vectors of four, and takes that way where
//! the processor says that it can. Every operation is the same one, element by element and in the
//! same order (no fused multiply-add), so both ways give the same bits.

/// Runs a loop with the widest vectors that the processor has.
#[inline]
pub fn wide<R>(work: impl FnOnce() -> R) -> R {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx2")]
        fn with_four_lanes<R>(work: impl FnOnce() -> R) -> R {
            work()
        }

        if std::arch::is_x86_feature_detected!("avx2") {
            #[allow(
                unsafe_code,
                reason = "the feature was detected on the line above; measured: the paper's \
                          identification of a million samples takes half the time"
            )]
            // SAFETY: the processor has AVX2, which is all that `with_four_lanes` asks for.
            return unsafe { with_four_lanes(work) };
        }
    }
    work()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ways_give_the_same_bits() {
        let angles: Vec<f64> = (0..4096).map(|k| f64::from(k) * 0.37 - 700.0).collect();
        let sum = |angles: &[f64]| {
            angles.iter().fold([0.0; 4], |mut sums, angle| {
                let (s, c) = crate::sincos::sin_cos_small(*angle);
                sums[0] += s * c;
                sums[1] += s / (2.0 + c);
                sums[2] += (s + 1.5).sqrt();
                sums[3] += c;
                sums
            })
        };
        let narrow = sum(&angles);
        assert_eq!(wide(|| sum(&angles)), narrow);
    }
}
