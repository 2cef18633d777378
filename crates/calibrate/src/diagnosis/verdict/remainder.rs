//! The residuals that no name explains: how large, where, and which names only imitate them.

use crate::kinematics::JointKind;
use crate::sessions::Session;
use crate::text::Text;

use crate::answers::diagnosis::Unexplained;
use crate::diagnosis::candidates::columns::CandidateSubset;
use crate::diagnosis::candidates::table::CandidateKind;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::evidence::Regression;
use crate::diagnosis::search::SearchResult as SearchEnd;
use crate::diagnosis::search::floor;
use crate::diagnosis::search::mean_sigma_mm;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::diagnosis::search::residual_mm;
use crate::linear::Basis;
use crate::model::shapes::{Shape, Variable, Where};

pub(crate) fn unexplained(
    prepared: &PreparedSearch,
    end: &SearchEnd,
    session: &Session,
) -> Unexplained {
    let regression = &prepared.regression;
    let fit = &end.fit;
    if end.base_misfit {
        return of_the_base(prepared, end);
    }
    if fit.shapes.is_empty() {
        return without_shapes(prepared, fit);
    }
    let names = |fit: &Fit| -> Vec<String> {
        let added = regression.added(fit);
        added.iter().map(|t| t.name_on(&session.robot)).collect()
    };
    let kept = names(fit);
    let mut resembles: Vec<String> = names(&end.named_effects_only)
        .into_iter()
        .chain(end.withdrawn.iter().map(|t| t.name_on(&session.robot)))
        .filter(|n| !kept.contains(n))
        .collect();
    resembles.sort();
    resembles.dedup();
    // The largest shape comes first.
    let gain = |index: usize| regression.without_shape(fit, index).rss - fit.rss;
    let mut order: Vec<(usize, f64)> = (0..fit.shapes.len()).map(|i| (i, gain(i))).collect();
    order.sort_by(|a, b| b.1.total_cmp(&a.1));
    let (main, main_gain) = order[0];
    let shape = fit.shapes[main].shape;
    let range = regression.table.space.range(shape.variable);
    let reduced = regression.without_shape(fit, main);
    let freedom = (regression.m() - fit.basis.rank() as f64).max(1.0);
    let k = fit.shapes[main].white.ncols();
    let test = crate::diagnosis::evidence::Significance::new(k, freedom);
    let minus_ln_p = test.of(main_gain / reduced.rss.max(1e-300))
        - 0.5 * shape.tried.max(1.0).ln()
        - 3.0_f64.ln();
    Unexplained {
        present: true,
        p: regression.family_p(minus_ln_p, fit).p,
        rms_mm: of_the_shapes_mm(regression, fit),
        place: Some(place_of(&shape, range, prepared)),
        resembles,
        description: text!(
            "{shape}; no effect of the catalogue explains it",
            shape = shape.describe()
        ),
        shapes: order
            .iter()
            .map(|(i, _)| {
                let placed = &fit.shapes[*i];
                (placed.shape, placed.coefficients.iter().copied().collect())
            })
            .collect(),
        noise: None,
    }
}

/// The place of a shape; of a target with its name.
fn place_of(shape: &Shape, range: (f64, f64), prepared: &PreparedSearch) -> Where {
    let session = prepared.problem.session;
    let slides = |j: usize| session.robot.joints[j].kind == JointKind::Prismatic;
    let mut place = shape.place(range, slides);
    if let (Variable::Target(index), Where::Range { variable, .. }) = (shape.variable, &mut place)
        && let Some(target) = session.targets.get(index as usize)
    {
        *variable = format!("target {}", target.name);
    }
    place
}

/// The part of the shapes of a fit that its names could not imitate: root mean square length over the samples, mm.
fn of_the_shapes_mm(regression: &Regression, fit: &Fit) -> f64 {
    let n = regression.rows.samples.len().max(1) as f64;
    if regression.noise.is_white() || regression.rows.observed().is_some() {
        let names = regression.fit(&fit.model, &[]);
        let gain = (names.rss - fit.rss).max(0.0);
        return (gain / n).sqrt() * mean_sigma_mm(regression);
    }
    // Whitened by a slow noise, a sum of squares is in units of one sample's innovation, not of mm.
    let shapes = fit.shapes.iter();
    let moved = shapes.map(|s| &*s.raw * &s.coefficients);
    let Some(mut moved) = moved.reduce(|sum, one| sum + one) else {
        return 0.0;
    };
    let (_, columns) = regression.raw(&fit.model);
    let same = Basis::new(&columns).solve(&moved);
    moved.gemv(-1.0, &columns, &same, 1.0);
    moved.norm() / n.sqrt()
}

/// The residuals of a base model that does not fit.
fn of_the_base(prepared: &PreparedSearch, end: &SearchEnd) -> Unexplained {
    let unexplained = without_shapes(prepared, &end.fit);
    // Estimated from the residuals of the base, the floor would be all of them.
    let floor_mm = floor(prepared, &end.named_effects_only).mm;
    let residual_mm = residual_mm(prepared, &end.fit);
    let robot = &prepared.problem.session.robot;
    let names = prepared.regression.added(&end.named_effects_only);
    Unexplained {
        present: true,
        rms_mm: (residual_mm * residual_mm - floor_mm * floor_mm)
            .max(0.0)
            .sqrt(),
        resembles: names.iter().map(|t| t.name_on(robot)).collect(),
        description: text!(
            "the base model does not fit: axes, tool or masses; {rest}",
            rest = &unexplained.description
        ),
        ..unexplained
    }
}

/// The residuals of names alone: how much like noise they are, and what they look most like.
pub(crate) fn without_shapes(prepared: &PreparedSearch, fit: &Fit) -> Unexplained {
    let regression = &prepared.regression;
    let scores = regression.scan(fit, CandidateSubset::All);
    let largest = scores.iter().map(|s| s.minus_ln_p).fold(0.0, f64::max);
    // The place where it would be, were it more than noise.
    let likeliest = scores
        .iter()
        .filter_map(|s| match &regression.table.candidates[s.candidate].what {
            CandidateKind::Anonymous(shape) => Some((s.ln_odds, shape)),
            CandidateKind::Named(_) => None,
        })
        .max_by(|a, b| a.0.total_cmp(&b.0));
    Unexplained {
        present: false,
        p: regression.family_p(largest, fit).p,
        rms_mm: 0.0,
        place: likeliest.map(|(_, shape)| {
            let range = regression.table.space.range(shape.variable);
            place_of(shape, range, prepared)
        }),
        resembles: Vec::new(),
        description: likeliest.map_or_else(Text::default, |(_, shape)| {
            text!(
                "what is left looks most like {shape}",
                shape = shape.describe()
            )
        }),
        shapes: Vec::new(),
        noise: None,
    }
}
