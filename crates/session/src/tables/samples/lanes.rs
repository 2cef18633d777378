//! Many bytes at once, one in each lane of a wide register, where the processor has AVX2.
//!
//! A short cell is loaded whole. Comparisons tell digits from the decimal point; a table says, for
//! each length and each place of the point, which lane each digit goes to so that the number stands
//! at the right without its point; three multiplications that add neighbours make one whole number
//! of up to fifteen digits, and the division is the exact one of
//! [`number`](crate::document::number). Nothing branches on how many digits there are.
//!
//! Only the instructions differ from the portable way: the values are the same to the last bit.

use std::arch::x86_64::{
    __m128i, __m256i, _mm_andnot_si128, _mm_cmpeq_epi8, _mm_cmpgt_epi8, _mm_cvtsi128_si64,
    _mm_madd_epi16, _mm_maddubs_epi16, _mm_movemask_epi8, _mm_packus_epi32, _mm_set_epi64x,
    _mm_set1_epi8, _mm_set1_epi16, _mm_set1_epi32, _mm_shuffle_epi8, _mm_subs_epu8,
    _mm256_cmpeq_epi8, _mm256_movemask_epi8, _mm256_or_si256, _mm256_set_m128i, _mm256_set1_epi8,
};

use crate::document::number::ratio;

use super::rows::Rows;
use super::stretch::{SHORT, Tools};

/// As [`Rows::take_with`] the portable way; `None` where the processor cannot.
pub(super) fn take(rows: &mut Rows<'_>, bytes: &[u8], end: usize, last: bool) -> Option<usize> {
    if !(is_x86_feature_detected!("avx2") && is_x86_feature_detected!("bmi2")) {
        return None;
    }
    #[allow(
        unsafe_code,
        reason = "the features were detected just above; measured: a file takes half the \
                  instructions"
    )]
    // SAFETY: the processor has AVX2 and BMI2 (and with it BMI1 and POPCNT, which every such
    // processor has), and that is all that the function asks for.
    Some(unsafe { take_in_lanes(rows, bytes, end, last) })
}

#[target_feature(enable = "avx2,bmi1,bmi2,popcnt")]
fn take_in_lanes(rows: &mut Rows<'_>, bytes: &[u8], end: usize, last: bool) -> usize {
    let tools = Tools {
        mark: |bytes: &[u8; 64]| mark(bytes),
        decimal: |cell: &[u8; SHORT], length| decimal(cell, length),
    };
    rows.take_with(bytes, end, last, &tools)
}

/// See [`Tools::mark`].
#[target_feature(enable = "avx2")]
#[inline]
fn mark(bytes: &[u8; 64]) -> (u64, u64) {
    let (halves, _) = bytes.as_chunks::<32>();
    let half = |bytes: &[u8; 32]| {
        let bytes = load_two(bytes);
        let equal = |byte: u8| _mm256_cmpeq_epi8(bytes, _mm256_set1_epi8(byte.cast_signed()));
        (_mm256_or_si256(equal(b','), equal(b'\n')), equal(b'"'))
    };
    let bits = |found| u64::from(_mm256_movemask_epi8(found).cast_unsigned());
    let [(ends, quotes), (more_ends, more_quotes)] = [half(&halves[0]), half(&halves[1])];
    (
        bits(ends) | bits(more_ends) << 32,
        bits(_mm256_or_si256(quotes, more_quotes)),
    )
}

/// See [`Tools::decimal`].
#[target_feature(enable = "avx2,bmi1,bmi2")]
#[inline]
fn decimal(bytes: &[u8; SHORT], length: usize) -> Option<f64> {
    let cell = load(bytes.first_chunk()?);
    let is = |found| _mm_movemask_epi8(found).cast_unsigned();
    let all = |byte: u8| _mm_set1_epi8(byte.cast_signed());
    let inside = (1u32 << (length & 15)) - 1;
    let digits = inside
        & is(_mm_andnot_si128(
            _mm_cmpgt_epi8(cell, all(b'9')),
            _mm_cmpgt_epi8(cell, all(b'/')),
        ));
    let point = inside & is(_mm_cmpeq_epi8(cell, all(b'.')));
    let minus = u32::from(bytes[0] == b'-');
    let has_two_points = point & point.wrapping_sub(1) != 0;
    if digits | point | minus != inside || has_two_points || digits == 0 {
        return None;
    }
    let whole = (point | (inside + 1)).trailing_zeros() as usize;
    // What is below '0', the minus, saturates to a zero.
    let values = _mm_subs_epu8(cell, all(b'0'));
    let values = _mm_shuffle_epi8(values, load(&TO_THE_RIGHT[length & 15][whole & 15]));
    // In every pair of lanes, the first one times the higher byte or half counts for more.
    let pairs = _mm_maddubs_epi16(values, _mm_set1_epi16(0x010a));
    let fours = _mm_madd_epi16(pairs, _mm_set1_epi32(0x0001_0064));
    let eights = _mm_madd_epi16(_mm_packus_epi32(fours, fours), _mm_set1_epi32(0x0001_2710));
    let eights = _mm_cvtsi128_si64(eights).cast_unsigned();
    let mantissa = (eights & 0xffff_ffff) * 100_000_000 + (eights >> 32);
    let decimals = (length - whole).saturating_sub(1);
    Some(ratio(mantissa, minus as usize, decimals))
}

/// The bytes in lanes, the first one lowest: a single instruction.
#[target_feature(enable = "avx2")]
#[inline]
fn load(bytes: &[u8; 16]) -> __m128i {
    let (halves, _) = bytes.as_chunks::<8>();
    let [low, high] = [halves[0], halves[1]].map(i64::from_le_bytes);
    _mm_set_epi64x(high, low)
}

/// As [`load`], twice as many.
#[target_feature(enable = "avx2")]
#[inline]
fn load_two(bytes: &[u8; 32]) -> __m256i {
    let (halves, _) = bytes.as_chunks::<16>();
    _mm256_set_m128i(load(&halves[1]), load(&halves[0]))
}

/// For a cell of this length (first index) with this many bytes before its point (second; the
/// length itself where it has none): which of its bytes goes to each lane so that the number ends
/// in the last one, without its point. 128 makes the lane zero.
static TO_THE_RIGHT: [[[u8; 16]; 16]; 16] = {
    let mut table = [[[128; 16]; 16]; 16];
    let mut length: u8 = 0;
    while length < 16 {
        let mut whole: u8 = 0;
        while whole <= length {
            let mut lane = 16;
            let mut byte = length;
            while byte > 0 {
                byte -= 1;
                if byte != whole {
                    lane -= 1;
                    table[length as usize][whole as usize][lane] = byte;
                }
            }
            whole += 1;
        }
        length += 1;
    }
    table
};
