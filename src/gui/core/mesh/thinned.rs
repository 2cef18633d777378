//! A mesh with fewer triangles that looks the same from afar: corners of one cell of a grid become one
//! (Rossignac & Borrel 1993), and triangles that lie in fewer than three cells go.

use std::collections::BTreeMap;

use super::parts::Triangle;

/// Cells along the longest side of the box around a mesh, at first.
const CELLS: f32 = 192.0;

/// At most about so many of these triangles; the grid gets coarser until they are.
pub(crate) fn thinned(triangles: Vec<Triangle>, most: usize) -> Vec<Triangle> {
    if triangles.len() <= most {
        return triangles;
    }
    let all = || triangles.iter().flatten();
    let end = |axis: usize, pick: fn(f32, f32) -> f32, start: f32| {
        all().map(|corner| corner[axis]).fold(start, pick)
    };
    let low: [f32; 3] = std::array::from_fn(|k| end(k, f32::min, f32::INFINITY));
    let side = (0..3).map(|k| end(k, f32::max, f32::NEG_INFINITY) - low[k]);
    let longest = side.fold(0.0, f32::max).max(f32::MIN_POSITIVE);
    let mut cells = CELLS;
    loop {
        let mut first: BTreeMap<[u16; 3], [f32; 3]> = BTreeMap::new();
        let mut kept = Vec::new();
        for triangle in &triangles {
            #[allow(clippy::cast_possible_truncation, reason = "at most CELLS")]
            #[allow(clippy::cast_sign_loss, reason = "at least 0")]
            let cell = |corner: &[f32; 3]| -> [u16; 3] {
                std::array::from_fn(|k| ((corner[k] - low[k]) / longest * cells) as u16)
            };
            let [a, b, c] = [0, 1, 2].map(|k| cell(&triangle[k]));
            if a != b && b != c && c != a {
                let at = [a, b, c].into_iter().zip(triangle);
                let at = at.map(|(cell, corner)| *first.entry(cell).or_insert(*corner));
                kept.extend(Triangle::try_from(at.collect::<Vec<_>>()));
            }
        }
        if kept.len() <= most || cells < 4.0 {
            kept.truncate(most);
            return kept;
        }
        cells *= 0.7;
    }
}

#[cfg(test)]
#[test]
fn a_fine_ball_becomes_a_coarse_one_of_the_same_size() {
    let at = |i: u16, j: u16| -> [f32; 3] {
        let (sin, cos) = (f32::from(i) * std::f32::consts::PI / 200.0).sin_cos();
        let (along, across) = (f32::from(j) * std::f32::consts::TAU / 400.0).sin_cos();
        [100.0 * sin * across, 100.0 * sin * along, 100.0 * cos]
    };
    let mut ball = Vec::new();
    for i in 0..200 {
        for j in 0..400 {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            ball.extend([[a, b, c], [a, c, d]]);
        }
    }
    assert_eq!(ball.len(), 160_000);
    let coarse = thinned(ball.clone(), 5_000);
    assert!((1_000..=5_000).contains(&coarse.len()), "{}", coarse.len());
    for corner in coarse.iter().flatten() {
        let far = corner.iter().map(|v| v * v).sum::<f32>().sqrt();
        assert!((far - 100.0).abs() < 0.01, "{far}");
    }
    let area = |triangles: &[Triangle]| {
        let area = |[a, b, c]: &Triangle| {
            let [a, b, c] = [a, b, c].map(|p| nalgebra::Vector3::from(*p));
            0.5 * (b - a).cross(&(c - a)).norm()
        };
        triangles.iter().map(area).sum::<f32>()
    };
    assert!((area(&coarse) / area(&ball) - 1.0).abs() < 0.05);
    assert_eq!(thinned(coarse.clone(), 5_000), coarse);
}
