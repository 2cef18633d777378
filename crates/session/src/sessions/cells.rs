//! Cells of the workspace: samples that lie near one another, for tests on places that a fit has not
//! seen. The points are halved at their median along their widest extent, again and again.

/// For each point the number of its cell; cells are as many as `count` rounded down to a power of two
/// and hold the same number of points within one.
pub fn cells(points_mm: &[[f64; 3]], count: usize) -> Vec<usize> {
    let mut groups: Vec<Vec<usize>> = vec![(0..points_mm.len()).collect()];
    while 2 * groups.len() <= count && groups.iter().all(|g| g.len() >= 2) {
        groups = groups
            .into_iter()
            .flat_map(|group| halves(points_mm, group))
            .collect();
    }
    let mut of = vec![0; points_mm.len()];
    for (cell, group) in groups.iter().enumerate() {
        for point in group {
            of[*point] = cell;
        }
    }
    of
}

/// For each point the fold that it is in, where points belong to groups: each group is cut into cells
/// by itself and spread over all folds, as what it refers to may be known from it alone.
pub fn folds_of_groups(points_mm: &[[f64; 3]], groups: &[usize], folds: usize) -> Vec<usize> {
    let mut fold = vec![0; points_mm.len()];
    let mut known: Vec<usize> = groups.to_vec();
    known.sort_unstable();
    known.dedup();
    for (k, group) in known.into_iter().enumerate() {
        let own: Vec<usize> = (0..points_mm.len())
            .filter(|i| groups[*i] == group)
            .collect();
        let at: Vec<[f64; 3]> = own.iter().map(|i| points_mm[*i]).collect();
        let wanted = (own.len() / 2).clamp(folds, 4 * folds);
        for (i, cell) in own.into_iter().zip(cells(&at, wanted)) {
            fold[i] = (cell + k) % folds;
        }
    }
    fold
}

fn halves(points_mm: &[[f64; 3]], mut group: Vec<usize>) -> [Vec<usize>; 2] {
    let extent = |axis: usize| {
        let values = group.iter().map(|i| points_mm[*i][axis]);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| {
            (a.min(v), b.max(v))
        });
        high - low
    };
    let widest = (0..3).max_by(|a, b| extent(*a).total_cmp(&extent(*b)));
    let axis = widest.unwrap_or(0);
    group.sort_by(|a, b| {
        points_mm[*a][axis]
            .total_cmp(&points_mm[*b][axis])
            .then(a.cmp(b))
    });
    let upper = group.split_off(group.len() / 2);
    [group, upper]
}

#[cfg(test)]
mod tests {
    use super::cells;

    #[test]
    fn cells_hold_neighbours_and_as_many_points_each() {
        let points: Vec<[f64; 3]> = (0..64)
            .map(|i| [f64::from(i % 8), f64::from(i / 8), 0.0])
            .collect();
        let of = cells(&points, 20);
        for cell in 0..16 {
            let own: Vec<[f64; 3]> = (0..64)
                .filter(|i| of[*i] == cell)
                .map(|i| points[i])
                .collect();
            assert_eq!(own.len(), 4);
            for axis in 0..2 {
                let values = own.iter().map(|p| p[axis]);
                let (low, high) =
                    values.fold((9.0_f64, -9.0_f64), |(a, b), v| (a.min(v), b.max(v)));
                assert!(high - low <= 1.0, "{own:?}");
            }
        }
        // Points at one place are no cell: each fold has some of every group.
        let groups: Vec<usize> = (0..64).map(|i| i % 2).collect();
        let fold = super::folds_of_groups(&[[0.0; 3]; 64], &groups, 5);
        for (group, of) in (0..2).flat_map(|g| (0..5).map(move |f| (g, f))) {
            let count = (0..64)
                .filter(|i| groups[*i] == group && fold[*i] == of)
                .count();
            assert!((1..=16).contains(&count), "{group} {of} {count}");
        }
        assert_eq!(cells(&[], 4), Vec::<usize>::new());
        assert_eq!(cells(&[[f64::NAN; 3]], 4), [0]);
    }
}
