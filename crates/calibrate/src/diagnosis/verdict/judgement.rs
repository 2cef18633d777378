//! Whether the residuals are noise: against returns to the same pose (lack of fit, an F test), else against the noise
//! that the instrument's maker states (χ², with the kurtosis of the residuals), on samples that the fit has not seen
//! (`unpredicted`), by their structure, and by whether the search was stopped before its end.
//!
//! ```text
//! F = [(S_fit − S_pure)/(ν − ν_pure)] / [S_pure/ν_pure],   z = (s²/σ² − 1)/√((κ − 1)/ν)
//! ```
//!
//! S and s² are of the white part of the noise: a drift of the frame is an answer in itself and does not change the
//! verdict.

use crate::diagnosis::evidence::SMALLEST;
use crate::distributions::f_tail;
use crate::effects::called;
use crate::sessions::Sigma;
use crate::text::Text;
use crate::text::length;
use crate::{odds, thresholds};

use crate::fit::gap::lengths_mm;
use crate::fit::noise::StatedNoise;
use crate::observations::figures::{ResidualsOfKind, residuals_of_kinds};
use crate::observations::{Layer, kind_in_words};

use super::excess::{Excess, excess_of};
use super::group_excess;
use super::repeatability::robot_mm;
use super::unpredicted;
use super::values::{Values, tails_of};
use super::withheld::{StandIn, stand_in};
use crate::answers::diagnosis::{Floor, FloorFrom, HeldOut, Unexplained, Verdict};
use crate::diagnosis::search::SearchResult;
use crate::diagnosis::search::free_curve;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::diagnosis::search::{PureError, pure_error};

/// Adds the evidence for more than noise to what is unexplained.
pub(crate) fn judge(
    prepared: &PreparedSearch,
    found: &SearchResult,
    values: &Values,
    floor: &Floor,
    held_out: &HeldOut,
    unexplained: &mut Unexplained,
) {
    if !unexplained.present {
        let excess = match floor.from {
            FloorFrom::Repeats => pure_error(prepared).map(|pure| lack_of_fit(values, &pure)),
            FloorFrom::Instrument => over_stated(prepared, values, floor),
            FloorFrom::Estimated => None,
        };
        let capped = prepared.is_capped(found);
        let structure = if capped {
            odds::TAKEN.chance()
        } else {
            SMALLEST
        };
        if unexplained.p <= structure {
            unexplained.present = true;
            if prepared.is_full(found) {
                unexplained.description = text!(
                    "the search stopped at its limit of {limit} effects; {rest}",
                    limit = prepared.cap(),
                    rest = &unexplained.description
                );
            }
        } else if let Some(excess) = excess.filter(Excess::is_more_than_noise) {
            flag(prepared, values, floor, excess, unexplained);
        } else if excess.is_some()
            && let Some(excess) = unseen(prepared, values, floor, held_out)
            && excess.is_more_than_noise()
        {
            flag(prepared, values, floor, excess, unexplained);
        } else if let Some((description, resembles)) =
            without_a_size(prepared, found, values, floor)
        {
            unexplained.present = true;
            unexplained.place = None;
            unexplained.description = description;
            unexplained.resembles.extend(resembles);
        }
        if unexplained.present && unexplained.rms_mm == 0.0 {
            let end = held_out.gaps.map_or(0.0, |g| g.end_mm).max(values.rms_mm());
            unexplained.rms_mm = (end * end - floor.mm * floor.mm).max(0.0).sqrt();
        } else if !unexplained.present {
            // What the search saw last is noise: there is nothing to report of it.
            unexplained.place = None;
            unexplained.description = Text::default();
        }
    }
    if unexplained.noise.is_none() {
        unexplained.noise = against_stated(prepared, values).filter(StatedNoise::differs);
    }
}

/// The evidence for more than noise without a larger error, and the names that only imitate it.
fn without_a_size(
    prepared: &PreparedSearch,
    found: &SearchResult,
    values: &Values,
    floor: &Floor,
) -> Option<(Text, Vec<String>)> {
    if let Some(StandIn { named, withheld }) = stand_in(prepared, &found.fit) {
        let description = text!(
            "{withheld}, which this run leaves out, explains as much as {named}",
            withheld = called(withheld),
            named = called(&named)
        );
        return Some((description, vec![named]));
    }
    if let Some((joint, terms)) = free_curve::as_likely(prepared, &found.fit) {
        let robot = &prepared.regression.base.robot;
        let names: Vec<String> = terms.iter().map(|t| t.name_on(robot)).collect();
        let description = text!(
            "a smooth curve over joint {joint} explains as much as {effects} together",
            joint = joint + 1,
            effects = Text::listed(names.iter().map(|name| called(name)), ", ")
        );
        return Some((description, names));
    }
    let names = prepared.regression.added(&found.fit).len();
    let wander = wanders(values, names, floor);
    let missed = wander.or_else(|| unpredicted::missed(prepared, values, floor))?;
    Some((missed, Vec::new()))
}

/// The message about names together with a drift of the frame: an error above the floor is not explained by them.
/// Without any name the drift is the whole answer.
fn wanders(values: &Values, names: usize, floor: &Floor) -> Option<Text> {
    let over = values.rms_mm() / floor.mm.max(f64::MIN_POSITIVE);
    let stated = floor.from != FloorFrom::Estimated;
    (names > 0 && stated && values.noise_is_slow() && over > thresholds::NOTICEABLE).then(|| {
        text!(
            "the remaining error is {times} times the floor ({floor}): the measuring frame wanders, or something changes as slowly",
            times = format!("{over:.2}"),
            floor = length(floor.mm, 4)
        )
    })
}

/// The verdict: whether no name is found, and whether something is unexplained.
pub(crate) fn of(nothing_found: bool, something_unexplained: bool) -> Verdict {
    match (nothing_found, something_unexplained) {
        (true, false) => Verdict::Noise,
        (false, false) => Verdict::Explained,
        (false, true) => Verdict::PartlyExplained,
        (true, true) => Verdict::Unexplained,
    }
}

fn flag(
    prepared: &PreparedSearch,
    values: &Values,
    floor: &Floor,
    excess: Excess,
    unexplained: &mut Unexplained,
) {
    unexplained.present = true;
    unexplained.p = excess.p.max(f64::MIN_POSITIVE);
    let session = values.problem.session;
    unexplained.place = group_excess::place(session, &lengths_mm(&values.problem, &values.model));
    let times = format!("{:.2}", excess.ratio);
    let returns = floor.from == FloorFrom::Repeats;
    let shared = robot_mm(prepared, values).filter(|_| !returns);
    let size = length(floor.mm, 4);
    unexplained.description = match excess.kind.map(kind_in_words) {
        Some(kind) if returns => text!(
            "the remaining error of {kind} is {times} times what returns to the same pose show, without a structure that the search knows",
            kind,
            times
        ),
        Some(kind) => text!(
            "the remaining error of {kind} is {times} times what is stated for the instrument, without a structure that the search knows",
            kind,
            times
        ),
        None if shared.is_some() => text!(
            "the rows of a pose share an error of {size}: the robot does not repeat, or something is missing that has no name; poses that are reached again tell which",
            size = length(shared.unwrap_or_default(), 4)
        ),
        None if returns => text!(
            "the remaining error is {times} times what returns to the same pose show ({size}), without a structure that the search knows",
            times,
            size
        ),
        None => text!(
            "the remaining error is {times} times what is stated for the instrument ({size}), without a structure that the search knows",
            times,
            size
        ),
    };
    if floor.from == FloorFrom::Instrument {
        unexplained.noise = against_stated(prepared, values);
    }
}

/// Noise as stated and as found.
fn against_stated(prepared: &PreparedSearch, values: &Values) -> Option<StatedNoise> {
    if prepared.problem.observed.is_some() {
        // Every kind states its own; the errors by kind hold both.
        return None;
    }
    let stated = prepared.problem.session.instrument.sigma_mm?;
    let axes = &prepared.regression.rows.axes;
    Some(StatedNoise::of(stated, values.sigma_mm(), axes))
}

/// F of the lack of fit against pure error.
fn lack_of_fit(values: &Values, pure: &PureError) -> Excess {
    let (variance, freedom) = values.expected_of_returns();
    let beyond = freedom - pure.freedom;
    let none = Excess {
        ratio: 1.0,
        p: 1.0,
        kind: None,
    };
    if beyond < 1.0 || pure.variance <= 0.0 {
        return none;
    }
    let lack = (variance * freedom - pure.variance * pure.freedom) / beyond;
    let f = lack / pure.variance;
    if !(beyond > 0.0 && pure.freedom > 0.0) {
        return none;
    }
    Excess {
        ratio: (variance / pure.variance).sqrt(),
        p: f_tail(f, beyond, pure.freedom),
        kind: None,
    }
}

/// The white noise that was found against the stated one.
fn over_stated(prepared: &PreparedSearch, values: &Values, floor: &Floor) -> Option<Excess> {
    if let Some(layer) = &values.problem.observed {
        return by_kind(layer, values, floor);
    }
    let stated = prepared.problem.session.instrument.sigma_mm?;
    let axes = &prepared.regression.rows.axes;
    let (_, freedom, kurtosis) = values.white();
    let sigma = values.sigma_mm();
    let mean = |of: &dyn Fn(usize) -> f64| {
        axes.iter().map(|a| of(*a)).sum::<f64>() / axes.len().max(1) as f64
    };
    let ratio2 = match stated {
        Sigma::Overall(s) => mean(&|a| (sigma[a] / s).powi(2)),
        Sigma::PerAxis(s) => mean(&|a| (sigma[a] / s[a]).powi(2)),
    };
    // A few far samples are tails, of which thirty samples do not show enough to know them: of a
    // larger noise the bulk is larger as well.
    let bulk = ratio2.sqrt() * values.bulk() / values.white().0.sqrt().max(f64::MIN_POSITIVE);
    let counts = is_of_the_bulk(bulk, values, floor);
    counts.then(|| excess_of(ratio2, freedom, f64::INFINITY, kurtosis))
}

/// Whether an excess counts. Where the bulk of the residuals is no larger than stated, a small excess is taken for
/// heavy tails; a whole group of samples that is off does not change the bulk either, and is no tail: then the RMS
/// error itself is above the floor. (A variance per degree of freedom is above it as well where priors hold a robot
/// that is farther off.)
fn is_of_the_bulk(bulk: f64, values: &Values, floor: &Floor) -> bool {
    bulk > 1.0 || values.rms_mm() > thresholds::NOTICEABLE * floor.mm
}

/// The same of every kind whose noise is stated: the clearest of them, its chance that of as much in any.
fn by_kind(layer: &Layer, values: &Values, floor: &Floor) -> Option<Excess> {
    let of_kind = residuals_of_kinds(layer, &values.model);
    let tried = of_kind.len() as f64;
    let all: usize = of_kind.iter().map(|kind| kind.squares.len()).sum();
    let spent = values.rank() / all.max(1) as f64;
    let one = |kind: &ResidualsOfKind| {
        let rows = kind.squares.len() as f64;
        // Every kind pays for the coefficients with its share of the rows.
        let freedom = (rows * (1.0 - spent)).max(1.0);
        let ratio2 = kind.squares.iter().sum::<f64>() / freedom;
        let (kurtosis, bulk) = tails_of(kind.squares.iter().map(|s| s.sqrt()).collect());
        let bulk = bulk / (freedom / rows).sqrt();
        let own = excess_of(ratio2, freedom, f64::INFINITY, kurtosis);
        is_of_the_bulk(bulk, values, floor).then(|| Excess {
            p: (own.p * tried).min(1.0),
            kind: (tried > 1.0).then_some(kind.name),
            ..own
        })
    };
    let excesses = of_kind.iter().filter_map(one);
    excesses.min_by(|a, b| a.p.total_cmp(&b.p))
}

/// The error on unseen samples against the floor: p predicted coordinates have the error of the fit in addition to
/// their own noise. A slow part of the noise is not the model's.
fn unseen(
    prepared: &PreparedSearch,
    values: &Values,
    floor: &Floor,
    held_out: &HeldOut,
) -> Option<Excess> {
    let gaps = held_out.gaps?;
    // One row of an observation has little information compared with the coefficients that it depends on: their error
    // is not the same everywhere, and the residuals of every kind decide alone.
    let of_kinds = values.problem.observed.is_some();
    if of_kinds || floor.from == FloorFrom::Estimated || values.noise_is_slow() {
        return None;
    }
    let axes = prepared.regression.rows.axes.len() as f64;
    let (_, freedom, kurtosis) = values.white();
    let m = freedom + values.rank();
    let factor = (m + values.rank()) / m.max(1.0);
    let ratio2 = (gaps.end_mm / floor.mm).powi(2) / factor;
    let count = (held_out.samples as f64 * axes).min(m);
    let known_from = match floor.from {
        FloorFrom::Repeats => pure_error(prepared)?.freedom,
        _ => f64::INFINITY,
    };
    Some(excess_of(ratio2, count, known_from, kurtosis))
}

#[cfg(test)]
mod tests {
    use super::*;
    use statrs::distribution::ContinuousCDF;
    use statrs::distribution::FisherSnedecor;

    #[test]
    fn a_floor_from_few_returns_says_less_than_a_stated_one() {
        // 504 coordinates 11 % above a floor that is stated, and one from 36 returns along three axes.
        let stated = excess_of(1.235, 504.0, f64::INFINITY, 3.0);
        let returns = excess_of(1.235, 504.0, 108.0, 3.0);
        assert!(stated.is_more_than_noise(), "{stated:?}");
        assert!(!returns.is_more_than_noise(), "{returns:?}");
        // The same chances as F has.
        let f = FisherSnedecor::new(504.0, 108.0).unwrap();
        assert!((returns.p / f.sf(1.235) - 1.0).abs() < 0.03, "{returns:?}");
    }
}
