//! Sizes near the detection limit: what is found there is found because noise made it larger, so
//! its size and its interval have to allow for that.

use truepose::diagnosis::{FoundEffect, Options};

use crate::asked::diagnosed_with;
use crate::cells::{in_parallel, row};
use crate::intervals::HOLD;
use crate::known::covered;
use crate::rig::{Hidden, Random};
use crate::{design, hidden, names, single_names};

pub fn near_the_limit(n: usize) {
    let ids: Vec<&str> = single_names().collect();
    for lambda in [16.0, 8.0] {
        let all = in_parallel(ids.len() * n, |cell| {
            let (id, k) = (ids[cell / n], cell % n);
            let mut random = Random(503 + id.len() as u64 + 179_424_673 * k as u64);
            let design = design(&mut random, id);
            let rig = hidden(&design, &[id], lambda, &mut random);
            let answer = diagnosed_with(&rig, &Options::default());
            let alone = names(&answer) == [id];
            let truth = &rig.hidden[0];
            answer.found.first().filter(|_| alone).map(|found| {
                let covered = covered(&found.parameters, &truth.parameters());
                (ratio(found, truth), covered)
            })
        });
        let found: Vec<_> = all.iter().flatten().collect();
        row(
            &format!("near the limit, λ = {lambda}: named exactly"),
            found.len(),
            all.len(),
            "",
        );
        let (good, of) = found
            .iter()
            .fold((0, 0), |sum, f| (sum.0 + f.1.0, sum.1 + f.1.1));
        row("  95 % intervals of those cover", good, of, HOLD);
        let mean = found.iter().map(|f| f.0).sum::<f64>() / found.len().max(1) as f64;
        println!("|   size found over true size, mean of those | {mean:.3} | 0.95–1.05 |");
    }
}

/// Size found over true size: of a wave its amplitude, of a vector the part along the true one.
fn ratio(found: &FoundEffect, truth: &Hidden) -> f64 {
    let setting = |name: &str| matches!(name, "phase_deg" | "time_s");
    let (mut together, mut square) = (0.0, 0.0);
    for (name, value) in truth.parameters().into_iter().filter(|p| !setting(p.0)) {
        let own = found.parameters.iter().find(|p| p.name == name);
        together += own.map_or(0.0, |p| p.value) * value;
        square += value * value;
    }
    together / square
}
