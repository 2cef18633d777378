//! Samples are worked on in blocks of [`LANES`], so that one virtual call serves many samples and
//! the compiler can turn the loops into vector instructions.

/// Samples in a block.
pub const LANES: usize = 64;
/// Sums that run side by side, so that they do not wait for one another.
pub const TOGETHER: usize = 8;

/// One number for each sample of a block.
pub type Lanes = [f64; LANES];

/// A vector for each sample of a block: x, y and z lanes.
pub type Lanes3 = [Lanes; 3];

/// Cross product of two vectors.
#[inline]
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Scalar product of two vectors.
#[inline]
pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `a + b·k`.
#[inline]
pub fn add_scaled(a: [f64; 3], b: [f64; 3], k: f64) -> [f64; 3] {
    [a[0] + b[0] * k, a[1] + b[1] * k, a[2] + b[2] * k]
}

/// `a − b`.
#[inline]
pub fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `a·k`.
#[inline]
pub fn scaled(a: [f64; 3], k: f64) -> [f64; 3] {
    [a[0] * k, a[1] * k, a[2] * k]
}

/// `m·v`, m by rows.
#[inline]
pub fn times(m: [[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    [dot(m[0], v), dot(m[1], v), dot(m[2], v)]
}

/// The vector turned about a unit axis by the angle whose sine and cosine are given (Rodrigues).
#[inline]
pub fn turned(v: [f64; 3], axis: [f64; 3], sin: f64, cos: f64) -> [f64; 3] {
    let along = dot(axis, v) * (1.0 - cos);
    let across = cross(axis, v);
    [
        v[0] * cos + across[0] * sin + axis[0] * along,
        v[1] * cos + across[1] * sin + axis[1] * along,
        v[2] * cos + across[2] * sin + axis[2] * along,
    ]
}

/// A vector of every lane [`turned`] about one axis by a separate angle.
#[inline(always)]
#[allow(clippy::inline_always, reason = "a part of wide loops")]
pub fn turn_lanes(v: &mut Lanes3, axis: [f64; 3], sin: &Lanes, cos: &Lanes) {
    let [x, y, z] = v;
    for i in 0..LANES {
        [x[i], y[i], z[i]] = turned([x[i], y[i], z[i]], axis, sin[i], cos[i]);
    }
}

/// `a + b·k` in every lane, with a separate factor.
#[inline(always)]
#[allow(clippy::inline_always, reason = "as turn_lanes")]
pub fn add_scaled_lanes(a: &mut Lanes3, b: [f64; 3], k: impl Fn(usize) -> f64) {
    let [x, y, z] = a;
    for i in 0..LANES {
        [x[i], y[i], z[i]] = add_scaled([x[i], y[i], z[i]], b, k(i));
    }
}

/// One vector in every lane.
#[inline(always)]
#[allow(clippy::inline_always, reason = "as turn_lanes")]
pub fn in_all_lanes(v: [f64; 3]) -> Lanes3 {
    v.map(|v| [v; LANES])
}
