//! The whole search.

use crate::effects::{Owner, Term};
use crate::fit::noise::Noise;
use crate::sessions::Session;
use crate::set_up_errors;
use crate::set_up_errors::Mended;

use super::error::DiagnoseError;
use super::options::Options;
use super::prepare::Prepared;
use super::progress::{Cancelled, Progress, Watch};
use super::work::{FIRST_SEARCH, OTHER_SETS, RIVALS, SECOND_SEARCH, Work};
use super::{base_misfit, final_set, found, free_curve, gross, rival, smooth_rival};

/// A watcher who is not asked again once the search was stopped, where what is proven until then is wanted.
pub(super) fn until_stopped<'w>(
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

/// The session without its blunders.
pub(crate) fn checked<'a>(
    session: &'a Session,
    options: &Options,
    watch: Watch,
) -> Result<Mended<'a>, Cancelled> {
    if !watch(&Progress::Checking) && !options.keep_when_stopped {
        return Err(Cancelled);
    }
    Ok(set_up_errors::mended(session, options.joint_values))
}

/// The search, done again once with the names known: outliers and noise look different then. Where
/// a slow part of the noise may explain as much, it is searched beside that as well, and the
/// likelier end wins. What is found is tested again at the end.
pub(crate) fn searched<'a>(
    session: &'a Session,
    options: &Options,
    watch: Watch,
) -> Result<(Prepared<'a>, found::Found), DiagnoseError> {
    let goes_on = watch(&Progress::Preparing);
    if !goes_on && !options.keep_when_stopped {
        return Err(DiagnoseError::Cancelled);
    }
    let mut prepared = Prepared::new(session, options)?;
    let work = prepared.regression.work.clone();
    if !goes_on {
        // Geometry alone is an answer too.
        work.stop();
    }
    let told = until_stopped(&work, options, watch);
    let watch: Watch = &told;
    work.up_to(FIRST_SEARCH);
    let mut found = prepared.search(watch)?;
    work.up_to(SECOND_SEARCH);
    let unfinished = work.ended().is_some();
    if prepared.reconsider(&found) || unfinished {
        work.begin_again();
        found = if unfinished || prepared.may_go_on(&found) {
            prepared.search_on(&found, watch)?
        } else {
            prepared.search(watch)?
        };
    }
    work.up_to(RIVALS);
    // A search that may not go on leaves names unsaid: neither a slow part of the noise nor a free
    // curve is held against those it has, and the verdict says that something is left.
    if !prepared.is_capped(&found) {
        (prepared, found) = against_rivals(&prepared, found, watch)?;
        // What was held against the end was not left out of it.
        work.begin_again();
    }
    work.up_to(OTHER_SETS);
    final_set::test(&prepared, &mut found, watch)?;
    if final_set::exchanged(&prepared, &mut found) {
        final_set::test(&prepared, &mut found, watch)?;
    }
    final_set::as_said(&prepared, &mut found, watch)?;
    base_misfit::withdraw(&prepared, &mut found);
    gross::withdraw(&prepared, &mut found);
    work.up_to(1.0);
    Ok((prepared, found))
}

/// What was found against a slow part of the noise and a free curve: the likeliest of them.
fn against_rivals<'a>(
    prepared: &Prepared<'a>,
    mut found: found::Found,
    watch: Watch,
) -> Result<(Prepared<'a>, found::Found), DiagnoseError> {
    let slow = prepared.slow_noise();
    let instead = prepared.slow_noise_instead(&found.fit);
    let instead = instead.filter(|n| slow.as_ref().is_none_or(|s| !s.whitens_like(n)));
    let noise = &prepared.regression.noise;
    let white = noise.slow.map(|_| noise.made_white());
    let (mut prepared, fit) = prepared.settled(&found.fit);
    found.fit = fit;
    free_curve::rival(&prepared, &mut found);
    smooth_rival::rival(&prepared, &mut found);
    let mut others = Vec::new();
    for noise in white.into_iter().chain(slow).chain(instead) {
        let known = &prepared.regression.noise;
        let (rival, end) = settled_search(prepared.with_noise(noise), known, watch)?;
        let loser = if standing(&rival, &end) > standing(&prepared, &found) {
            prepared = rival;
            std::mem::replace(&mut found, end)
        } else {
            end
        };
        others.push(loser.fit);
    }
    if prepared.regression.noise.slow.is_some() {
        let white = prepared.with_noise(prepared.regression.noise.made_white());
        if let Some(curve) = free_curve::instead_of_slow(&white, &found) {
            (prepared, found) = (white, curve);
        }
    }
    let least = found.fit.ln_evidence - rival::UNDECIDED;
    others.retain(|other| other.shapes.is_empty() && other.ln_evidence > least);
    found.other_ends = others;
    Ok((prepared, found))
}

/// How likely an end of a search is beside the others. A step or a drift of the measuring frame is a
/// movement of the frame as a slow part of the noise is, and no set of equivalent names can hold the
/// noise: such a name stands unless the noise rules it out.
fn standing(prepared: &Prepared, end: &found::Found) -> f64 {
    let names = prepared.regression.added(&end.fit);
    let of_the_frame = |t: &&Term| t.effect.about().owner == Owner::Session;
    let only = !names.is_empty() && names.iter().all(of_the_frame);
    let favour = prepared.regression.noise.slow.is_none() && only && end.fit.shapes.is_empty();
    end.fit.ln_evidence + if favour { rival::UNDECIDED } else { 0.0 }
}

/// A search whose noise is estimated beside what it finds, until that is the same, or one that was searched
/// already.
fn settled_search<'a>(
    mut prepared: Prepared<'a>,
    searched: &Noise,
    watch: Watch,
) -> Result<(Prepared<'a>, found::Found), DiagnoseError> {
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
        found = prepared.search_on(&found, watch)?;
    }
    free_curve::rival(&prepared, &mut found);
    smooth_rival::rival(&prepared, &mut found);
    Ok((prepared, found))
}
