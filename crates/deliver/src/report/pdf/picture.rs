//! The logo above the head of the first page.

use crate::report::logo::{LOGO, Logo};
use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::{Content, Filter, Name, Pdf, Ref};

use super::flow::{LEFT, PAGE, TOP};

/// Its name among what a page draws.
pub(super) const NAME: Name<'_> = Name(b"Logo");

/// Writes its pixels as an object of this number.
pub(super) fn pixels(pdf: &mut Pdf, picture: Ref, logo: &Logo) -> Ref {
    let [width, height] = logo
        .size
        .map(|side| i32::try_from(side).unwrap_or(i32::MAX));
    let packed = compress_to_vec_zlib(&logo.rgb, 7);
    let mut image = pdf.image_xobject(picture, &packed);
    image.width(width).height(height).bits_per_component(8);
    image.color_space().device_rgb();
    image.filter(Filter::FlateDecode);
    picture
}

/// The operators that draw it.
pub(super) fn drawn(logo: &Logo) -> Vec<u8> {
    let [width, height] = logo.within(LOGO).map(f32_of);
    let foot = f32_of(PAGE[1] - TOP) - height;
    let mut out = Content::new();
    out.save_state();
    out.transform([width, 0.0, 0.0, height, f32_of(LEFT), foot]);
    out.x_object(NAME);
    out.restore_state();
    let mut operators = vec![b'\n'];
    operators.extend(out.finish().into_vec());
    operators
}

/// A hundredth of a point is finer than any printer; what is not finite is put at the corner.
#[allow(clippy::cast_possible_truncation, reason = "places on a page")]
pub(super) fn f32_of(value: f64) -> f32 {
    if value.is_finite() {
        ((value.clamp(-1e5, 1e5) * 100.0).round() / 100.0) as f32
    } else {
        0.0
    }
}
