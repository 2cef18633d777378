//! Lets hot loops use the processor's wide vectors where it has them.
//!
//! A program that has to start on every x86-64 processor is compiled for vectors of two doubles. [`wide`] compiles its
//! argument for vectors of four and of eight as well, and takes the widest way that the processor supports. Every
//! operation is the same one, element by element and in the same order (no fused multiply-add), so all ways give the
//! same bits.

/// A hot loop. `run` has to be `#[inline(always)]`, and what it calls inlined as well: only code inside the caller is
/// compiled for wide vectors.
pub trait Loop {
    /// Its result.
    type Output;
    fn run(self) -> Self::Output;
}

/// Runs a loop with the widest vectors that the processor has.
#[inline]
pub fn wide<L: Loop>(work: L) -> L::Output {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx2")]
        fn with_four_lanes<L: Loop>(work: L) -> L::Output {
            work.run()
        }
        #[target_feature(enable = "avx512f,avx512vl,avx512dq")]
        fn with_eight_lanes<L: Loop>(work: L) -> L::Output {
            work.run()
        }

        if std::arch::is_x86_feature_detected!("avx512f")
            && std::arch::is_x86_feature_detected!("avx512vl")
            && std::arch::is_x86_feature_detected!("avx512dq")
        {
            #[allow(
                unsafe_code,
                reason = "the features were detected on the lines above; the sums of a product are one \
                          vector of eight"
            )]
            // SAFETY: the processor has all that `with_eight_lanes` asks for.
            return unsafe { with_eight_lanes(work) };
        }
        if std::arch::is_x86_feature_detected!("avx2") {
            #[allow(
                unsafe_code,
                reason = "the feature was detected on the line above; measured: the sums of the \
                          paper's identification take half the time"
            )]
            // SAFETY: the processor has AVX2, which is all that `with_four_lanes` asks for.
            return unsafe { with_four_lanes(work) };
        }
    }
    work.run()
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Sum<'a>(&'a [f64]);
    impl Loop for Sum<'_> {
        type Output = [f64; 4];
        #[inline(always)]
        #[allow(clippy::inline_always, reason = "see Loop")]
        fn run(self) -> [f64; 4] {
            self.0.iter().fold([0.0; 4], |mut sums, angle| {
                let (s, c) = crate::sincos::sin_cos_small(*angle);
                sums[0] += s * c;
                sums[1] += s / (2.0 + c);
                sums[2] += (s + 1.5).sqrt();
                sums[3] += c;
                sums
            })
        }
    }

    #[test]
    fn both_ways_give_the_same_bits() {
        let angles: Vec<f64> = (0..4096).map(|k| f64::from(k) * 0.37 - 700.0).collect();
        assert_eq!(wide(Sum(&angles)), Sum(&angles).run());
    }
}
