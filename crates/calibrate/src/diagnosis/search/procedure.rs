//! The whole search, step by step.

use crate::effects::{Owner, Term};
use crate::fit::noise::Noise;
use crate::odds;
use crate::sessions::Session;
use crate::set_up_errors;
use crate::set_up_errors::CorrectedSession;

use super::found::SearchResult;
use super::prepare::PreparedSearch;
use super::{base_misfit, chosen_again, final_set, free_curve, gross_error, slowest};
use crate::diagnosis::error::DiagnoseError;
use crate::diagnosis::evidence::{FIRST_SEARCH, OTHER_SETS, RIVALS, SECOND_SEARCH, Work};
use crate::diagnosis::options::Options;
use crate::diagnosis::progress::{Cancelled, Progress, Watch};

/// A watcher who is not asked again once the search was stopped, where the result until then is wanted.
pub(crate) fn until_stopped<'w>(
    work: &'w Work,
    options: &Options,
    watch: Watch<'w>,
) -> impl Fn(&Progress) -> bool + use<'w> {
    let keep = options.keep_when_stopped;
    move |progress| {
        if work.was_stopped() || watch(progress) {
            return true;
        }
        if keep {
            work.stop();
        }
        keep
    }
}

/// The session without its set-up errors.
pub(crate) fn checked<'a>(
    session: &'a Session,
    options: &Options,
    watch: Watch,
) -> Result<CorrectedSession<'a>, Cancelled> {
    if !watch(&Progress::Checking) && !options.keep_when_stopped {
        return Err(Cancelled);
    }
    Ok(set_up_errors::corrected(session, options.joint_values))
}

/// The whole search, in five steps, of a prepared session ([`prepared`]). A step may be cut short where its budget is
/// spent ([`Work`]) or the user stops it; the result until then is the answer.
pub(crate) fn searched<'a>(
    mut prepared: PreparedSearch<'a>,
    options: &Options,
    watch: Watch,
) -> Result<(PreparedSearch<'a>, SearchResult), DiagnoseError> {
    let work = prepared.regression.work.clone();
    let keep_going = until_stopped(&work, options, watch);
    let watch: Watch = &keep_going;
    // 1. Forward, swaps, drops and pairs: what exceeds noise family-wise and predicts unseen samples.
    work.up_to(FIRST_SEARCH);
    let mut found = prepared.search(watch)?;
    // 2. Again with the names known: outliers and noise are different then.
    work.up_to(SECOND_SEARCH);
    found = search_again(&mut prepared, found, watch)?;
    // 3. Compared with a slow part of the noise and with free curves: the likelier end wins.
    work.up_to(RIVALS);
    (prepared, found) = compare_with_rivals(prepared, found, watch)?;
    slowest::readings(&prepared, &mut found);
    free_curve::rival(&prepared, &mut found);
    // 4. Each name given the others, and compared with other sets that are as likely.
    work.up_to(OTHER_SETS);
    test_at_the_end(&prepared, &mut found, watch)?;
    slowest::readings(&prepared, &mut found);
    // 5. No name where few values or poses, the geometry, the rows or the set-up are the reason.
    free_curve::withdraw_of_few_values(&prepared, &mut found);
    chosen_again::withdraw(&prepared, &mut found);
    base_misfit::withdraw(&prepared, &mut found);
    gross_error::withdraw(&prepared, &mut found);
    work.up_to(1.0);
    Ok((prepared, found))
}

/// The session made ready to be searched: the samples that count, the robust fit of the base, its noise, and the
/// candidates.
pub(crate) fn prepared<'a>(
    session: &'a Session,
    options: &Options,
    watch: Watch,
) -> Result<PreparedSearch<'a>, DiagnoseError> {
    let goes_on = watch(&Progress::Preparing);
    if !goes_on && !options.keep_when_stopped {
        return Err(DiagnoseError::Cancelled);
    }
    let prepared = PreparedSearch::new(session, options)?;
    if !goes_on {
        // Geometry alone is an answer too.
        prepared.regression.work.stop();
    }
    Ok(prepared)
}

/// The search again where the names show other outliers or another noise, or where it was not finished.
fn search_again(
    prepared: &mut PreparedSearch,
    found: SearchResult,
    watch: Watch,
) -> Result<SearchResult, DiagnoseError> {
    let unfinished = prepared.regression.work.ended().is_some();
    if !(prepared.reconsider(&found) || unfinished) {
        return Ok(found);
    }
    prepared.regression.work.begin_again();
    if unfinished || prepared.may_go_on(&found) {
        prepared.resume(&found, watch)
    } else {
        prepared.search(watch)
    }
}

/// Compares what was found with its rivals that are no names. After a search that was cut short names may be missing:
/// then neither a slow part of the noise nor a free curve is compared with those it has, and the verdict reports that
/// something is unexplained.
fn compare_with_rivals<'a>(
    prepared: PreparedSearch<'a>,
    found: SearchResult,
    watch: Watch,
) -> Result<(PreparedSearch<'a>, SearchResult), DiagnoseError> {
    if prepared.is_capped(&found) {
        return Ok((prepared, found));
    }
    let work = prepared.regression.work.clone();
    let likelier = against_rivals(&prepared, found, watch)?;
    // What the comparison spent does not count as left out of the search.
    work.begin_again();
    Ok(likelier)
}

/// Tests the remaining names, once more where one is exchanged, and keeps those that can be reported.
fn test_at_the_end(
    prepared: &PreparedSearch,
    found: &mut SearchResult,
    watch: Watch,
) -> Result<(), DiagnoseError> {
    final_set::test(prepared, found, watch)?;
    if final_set::exchanged(prepared, found) {
        final_set::test(prepared, found, watch)?;
    }
    final_set::test_as_reported(prepared, found, watch)?;
    Ok(())
}

/// The likeliest of what was found, a slow part of the noise and a free curve.
fn against_rivals<'a>(
    prepared: &PreparedSearch<'a>,
    mut found: SearchResult,
    watch: Watch,
) -> Result<(PreparedSearch<'a>, SearchResult), DiagnoseError> {
    let slow = prepared.slow_noise();
    let instead = prepared.slow_noise_instead(&found.fit);
    let instead = instead.filter(|n| slow.as_ref().is_none_or(|s| !s.whitens_like(n)));
    let noise = &prepared.regression.noise;
    let white = noise.slow.map(|_| noise.made_white());
    let (mut prepared, fit) = prepared.settled(&found.fit);
    found.fit = fit;
    let mut others = Vec::new();
    for noise in white.into_iter().chain(slow).chain(instead) {
        let known = &prepared.regression.noise;
        let (rival, end) = settled_search(prepared.with_noise(noise), known, watch)?;
        let loser =
            if comparable_ln_evidence(&rival, &end) > comparable_ln_evidence(&prepared, &found) {
                prepared = rival;
                std::mem::replace(&mut found, end)
            } else {
                end
            };
        others.push(loser.fit);
    }
    let noise = prepared.regression.noise.clone();
    if noise.slow.is_some() {
        // A curve may explain a part of the slow noise, or all of it: that shows where its values come back.
        let white = prepared.with_noise(noise.made_white());
        if let Some(curve) = free_curve::instead_of_slow(&white, &found, |_| true) {
            (prepared, found) = (white, curve);
        }
        // Of several joints one may have values that come back by chance.
        let white = prepared.with_noise(noise.without_slow());
        let single = white.survey.joints.len() == 1;
        let comes_back = |joint: usize| single && free_curve::comes_back(&white, joint);
        if let Some(curve) = free_curve::instead_of_slow(&white, &found, comes_back) {
            (prepared, found) = (white, curve);
        }
    }
    let least = found.fit.ln_evidence - odds::OPEN.nats();
    others.retain(|other| other.shapes.is_empty() && other.ln_evidence > least);
    found.other_ends = others;
    Ok((prepared, found))
}

/// The evidence of an end of a search for comparison with others. A step or a drift of the measuring frame is a
/// movement of the frame as a slow part of the noise is, and no set of equivalent names can contain the noise: such a
/// name is kept unless the noise rules it out.
fn comparable_ln_evidence(prepared: &PreparedSearch, end: &SearchResult) -> f64 {
    let names = prepared.regression.added(&end.fit);
    let of_the_frame = |t: &&Term| t.effect.about().owner == Owner::Session;
    let only = !names.is_empty() && names.iter().all(of_the_frame);
    let favour = prepared.regression.noise.slow.is_none() && only && end.fit.shapes.is_empty();
    end.fit.ln_evidence + if favour { odds::OPEN.nats() } else { 0.0 }
}

/// A search whose noise is estimated given what it finds, until the noise no longer changes, or is one that was
/// searched already.
fn settled_search<'a>(
    mut prepared: PreparedSearch<'a>,
    searched: &Noise,
    watch: Watch,
) -> Result<(PreparedSearch<'a>, SearchResult), DiagnoseError> {
    let mut found = prepared.search(watch)?;
    for _ in 0..3 {
        let (settled, fit) = prepared.settled(&found.fit);
        let noise = &settled.regression.noise;
        let same = noise.whitens_like(&prepared.regression.noise);
        let known = noise.whitens_like(searched);
        (prepared, found.fit) = (settled, fit);
        if same || known {
            break;
        }
        found = prepared.resume(&found, watch)?;
    }
    Ok((prepared, found))
}
