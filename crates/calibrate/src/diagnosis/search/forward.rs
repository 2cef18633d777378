//! Forward selection: one effect at a time, each step followed by swaps and drops, then pairs against pairs; once with
//! names alone and once with shapes added. The likelier result wins, and names are preferred: a shape has to be twenty
//! times likelier than what names can do.
//!
//! A step is taken if noise alone would lead the whole search to as small a p in fewer than
//! [`odds::TAKEN`] of all sessions, if samples that the fit has not seen are predicted better, and if
//! the effect matters in practice.

use crate::diagnosis::evidence::{Fit, Folds, KEPT, Regression, Score, by_odds};
use crate::effects::Term;
use crate::odds;

use super::aliases;
use super::found::SearchResult;
use super::prepare::PreparedSearch;
use crate::diagnosis::candidates::columns::CandidateSubset;
use crate::diagnosis::candidates::compatible;
use crate::diagnosis::candidates::table::CandidateKind;
use crate::diagnosis::evidence::memo::Memo;
use crate::diagnosis::{Cancelled, DiagnoseError, Progress, Watch};

/// An effect matters if its root mean square is above this share of the noise, a tenth of its variance (0.3² ≈ 0.1), …
const LEAST_OF_NOISE: f64 = 0.3;
/// … or above this share of the tolerance.
const LEAST_OF_TOLERANCE: f64 = 0.1;
/// An effect below this is rounding, mm.
const LEAST_MM: f64 = 2e-5;

/// The candidates that may be added in a pass.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Additions {
    Names,
    Everything,
}

impl Additions {
    pub(super) fn among(self) -> CandidateSubset {
        match self {
            Self::Names => CandidateSubset::Names,
            Self::Everything => CandidateSubset::All,
        }
    }
}

pub(crate) struct Search<'s, 'a> {
    pub(crate) regression: &'s Regression<'a>,
    pub(crate) folds: &'s Folds,
    pub(crate) most: usize,
    pub(crate) watch: Watch<'s>,
    /// Errors on unseen samples.
    pub(crate) unseen: Memo<f64>,
}

impl Search<'_, '_> {
    pub(crate) fn run(&self) -> Result<SearchResult, Cancelled> {
        let base = self.regression.fit(&self.regression.base, &[]);
        self.report(&Progress::Searching {
            found: Vec::new(),
            percent: 0,
        })?;
        let mut named_effects_only = self.forward(base.clone(), Additions::Names)?;
        named_effects_only = self.pairs(named_effects_only)?;
        // Names first, then shapes on their residuals; and everything at once from the start.
        let extended = self.forward(named_effects_only.clone(), Additions::Everything)?;
        let work = &self.regression.work;
        let complete = work.ended().is_none();
        let free = self.forward(base, Additions::Everything)?;
        let mut fit = named_effects_only.clone();
        for other in [extended, free] {
            let other = self.pairs(other)?;
            if other.ln_evidence > fit.ln_evidence + 1e-6 {
                fit = other;
            }
        }
        if complete {
            // What the second way left out the first one has searched.
            work.begin_again();
        }
        Ok(SearchResult::of(fit, named_effects_only))
    }

    /// Continues from the end of a search under nearly the same noise.
    pub(crate) fn resume(&self, from: &SearchResult) -> Result<SearchResult, Cancelled> {
        let fit = self.resume_fit(&from.fit, Additions::Everything)?;
        let named_effects_only = if fit.shapes.is_empty() {
            fit.clone()
        } else {
            self.resume_fit(&from.named_effects_only, Additions::Names)?
        };
        let likelier = named_effects_only.ln_evidence > fit.ln_evidence;
        let end = if likelier {
            named_effects_only.clone()
        } else {
            fit
        };
        Ok(SearchResult::of(end, named_effects_only))
    }

    fn resume_fit(&self, end: &Fit, allow: Additions) -> Result<Fit, Cancelled> {
        let fit = self.settle(end.clone(), allow);
        self.pairs(self.forward(fit, allow)?)
    }

    fn report(&self, progress: &Progress) -> Result<(), Cancelled> {
        if (self.watch)(progress) {
            Ok(())
        } else {
            Err(Cancelled)
        }
    }

    /// The progress by what was found; the reported share never falls.
    pub(super) fn report_found(&self, fit: &Fit) -> Result<(), Cancelled> {
        let names = self.regression.added(fit).into_iter();
        self.report(&Progress::Searching {
            found: names
                .map(|term| term.name_on(&self.regression.base.robot))
                .collect(),
            percent: (100.0 * self.regression.work.spent()) as u8,
        })
    }

    pub(super) fn count(&self, fit: &Fit) -> usize {
        self.regression.added(fit).len() + fit.shapes.len()
    }

    /// Adds candidates while they are significant, best first.
    fn forward(&self, start: Fit, allow: Additions) -> Result<Fit, Cancelled> {
        let mut fit = start;
        while self.count(&fit) < self.most && !self.regression.work.is_over() {
            let next = self.step(&fit, allow);
            let next = next.or_else(|| self.of_a_gear(&fit));
            let Some(next) = next.or_else(|| self.two_at_once(&fit, allow)) else {
                break;
            };
            let next = self.settle(next, allow);
            if next.ln_evidence <= fit.ln_evidence + 1e-6 {
                break;
            }
            fit = next;
            self.report_found(&fit)?;
        }
        Ok(fit)
    }

    /// The likeliest candidate that is significant, holds on unseen samples and matters.
    fn step(&self, fit: &Fit, allow: Additions) -> Option<Fit> {
        let mut scores = self.regression.scan(fit, allow.among());
        self.retain_compatible(fit, allow, &mut scores);
        by_odds(&mut scores);
        let unseen = self.unseen(fit);
        let mattering = scores.iter().filter(|s| self.matters(s.gain, fit));
        // Nearly equal candidates: the first few are looked at closely.
        for (score, next) in self.possible(fit, mattering).take(4) {
            let found = score.minus_ln_p;
            if self
                .regression
                .reached_by_noise(found, odds::TAKEN.chance(), &next)
            {
                continue;
            }
            if self.unseen(&next) < unseen {
                return Some(next);
            }
        }
        None
    }

    /// All orders at once that follow from the gear ratio of a joint, where none of them gains enough alone: as likely
    /// by their odds as a step has to be by its p.
    fn of_a_gear(&self, fit: &Fit) -> Option<Fit> {
        let regression = self.regression;
        let there = regression.added(fit);
        let joints = 0..regression.base.robot.joints.len();
        let fits = joints.filter_map(|joint| {
            let candidates = regression.table.candidates.iter();
            let terms = candidates.filter_map(|c| c.what.term());
            let own =
                |t: &&Term| t.joint == joint && regression.is_stated(t) && compatible(&there, t);
            let own: Vec<&Term> = terms.filter(own).collect();
            if own.len() < 2 || self.count(fit) + own.len() > self.most {
                return None;
            }
            let model = own
                .into_iter()
                .fold(fit.model.clone(), |m, t| m.with_term(t.clone()));
            Some(regression.fit(&model, &fit.shapes))
        });
        let least = -odds::TAKEN.chance().ln();
        let proven = fits.filter(|next| {
            next.ln_evidence > fit.ln_evidence + least
                && self.matters(fit.rss - next.rss, fit)
                && self.unseen(next) < self.unseen(fit)
        });
        proven.max_by(|a, b| a.ln_evidence.total_cmp(&b.ln_evidence))
    }

    /// Two names at once, where neither gains enough without the other: as likely by their odds as a step has to be by
    /// its p. Each is tested given the other at the end.
    fn two_at_once(&self, fit: &Fit, allow: Additions) -> Option<Fit> {
        if allow != Additions::Names || self.count(fit) + 2 > self.most {
            return None;
        }
        let least = -odds::TAKEN.chance().ln();
        let mut pairs = aliases::with_pairs(self.regression, fit, least);
        pairs.find(|next| {
            next.ln_evidence > fit.ln_evidence + least
                && self.matters(fit.rss - next.rss, fit)
                && self.unseen(next) < self.unseen(fit)
        })
    }

    /// A fit with each candidate, except those whose own values rule them out: a compliance that is not significantly
    /// positive as long as other effects are missing is no argument against the others.
    pub(super) fn possible<'f>(
        &'f self,
        fit: &'f Fit,
        scores: impl Iterator<Item = &'f Score>,
    ) -> impl Iterator<Item = (&'f Score, Fit)> {
        let fitted = scores.map(move |score| {
            let what = self.regression.refined(fit, score.candidate);
            (score, self.regression.with(fit, &what))
        });
        fitted.filter(|(_, next)| next.ln_evidence.is_finite())
    }

    pub(super) fn unseen(&self, fit: &Fit) -> f64 {
        let work = || self.folds.rms(self.regression, fit);
        self.unseen.of(fit, work)
    }

    /// The candidates that are compatible with the terms of a fit.
    pub(super) fn retain_compatible(&self, fit: &Fit, allow: Additions, scores: &mut Vec<Score>) {
        let there = self.regression.added(fit);
        let candidates = &self.regression.table.candidates;
        scores.retain(|score| match &candidates[score.candidate].what {
            CandidateKind::Named(term) => compatible(&there, term),
            CandidateKind::Anonymous(_) => allow == Additions::Everything,
        });
    }

    /// Whether a fall of the sum of squares by `gain` matters in practice.
    pub(crate) fn matters(&self, gain: f64, fit: &Fit) -> bool {
        let regression = self.regression;
        let n = regression.rows.samples.len() as f64;
        let in_noise = (gain / n).sqrt() / regression.scale(fit).max(1e-300);
        let mean_sigma = mean_sigma_mm(regression);
        let rms_mm = (gain / n).sqrt() * mean_sigma;
        let of_tolerance = regression
            .problem
            .session
            .tolerance_mm
            .is_some_and(|t| rms_mm > LEAST_OF_TOLERANCE * t);
        rms_mm > LEAST_MM && (in_noise > LEAST_OF_NOISE || of_tolerance)
    }
}

/// Root mean square of σ over the measured axes, mm.
pub(crate) fn mean_sigma_mm(regression: &Regression) -> f64 {
    let rows = &regression.rows;
    if let Some(length) = rows.noise_mm(&regression.noise) {
        // A sample has so many rows.
        return length / (regression.m() / rows.samples.len().max(1) as f64).sqrt();
    }
    let axes = &rows.axes;
    let sum: f64 = axes
        .iter()
        .map(|a| regression.noise.sigma_mm[*a].powi(2))
        .sum();
    (sum / axes.len().max(1) as f64).sqrt()
}

impl<'a> PreparedSearch<'a> {
    pub(crate) fn search(&self, watch: Watch) -> Result<SearchResult, DiagnoseError> {
        Ok(self.searcher(watch).run()?)
    }

    /// Continues from the end of a search under nearly the same noise.
    pub(crate) fn resume(
        &self,
        from: &SearchResult,
        watch: Watch,
    ) -> Result<SearchResult, DiagnoseError> {
        let refitted = |fit: &Fit| self.refitted(fit);
        let from = SearchResult::of(refitted(&from.fit), refitted(&from.named_effects_only));
        Ok(self.searcher(watch).resume(&from)?)
    }

    fn searcher<'s>(&'s self, watch: Watch<'s>) -> Search<'s, 'a> {
        Search {
            regression: &self.regression,
            folds: &self.folds,
            most: self.cap(),
            watch,
            unseen: Memo::new(KEPT),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Additions, KEPT, Search, by_odds};
    use crate::diagnosis::Options;
    use crate::diagnosis::evidence::memo::Memo;
    use crate::diagnosis::search::prepare::PreparedSearch;
    use crate::simulation::{parse_scenario, simulate, unwatched};

    /// Links of unknown masses sag under loads that hardly differ: the moments explain the residual, and the
    /// compliance, which only the loads determine, is not significantly positive. The likeliest candidate is ruled out
    /// by its own values, and the next ones are tried: the eccentric encoder is found nevertheless.
    #[test]
    fn a_candidate_that_its_own_values_rule_out_does_not_end_the_search() {
        let stops = (0..120).map(|k| {
            // Spread over both ranges (Kronecker's sequence).
            let turn = |by: f64| 300.0 * (f64::from(k) * by).fract() - 150.0;
            format!(
                r#"{{"q_deg":[{},{}]}}"#,
                turn(0.754_877_666),
                turn(0.569_840_291)
            )
        });
        let scenario = format!(
            r#"{{"format":"truepose-scenario/1","name":"heavy links","robot":{{"name":"r",
            "gravity_m_s2":[0,0,-9.81],"joints":[
            {{"name":"tilt","kind":"revolute","axis":[0,1,0],"point_mm":[0,0,0],"limits":[-170,170],
            "mass_kg":20,"centre_mm":[150,60,40]}},
            {{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,100],"limits":[-170,170],
            "mass_kg":5,"centre_mm":[300,80,200]}}],
            "tool":{{"position_mm":[400,100,300],"quaternion_wxyz":[1,0,0,0]}}}},"targets":{{"T1":[0,0,0]}},
            "instrument":{{"name":"tracker","sigma_mm":0.03}},
            "poses":{{"list":[{}]}},"conditions":{{"load_kg":[3,3.2]}},
            "effects":[{{"effect":"joint-compliance","joint":1,"parameters":{{"compliance_urad_per_nm":40}}}},
            {{"effect":"encoder-eccentricity","joint":2,"parameters":{{"amplitude_deg":0.03,"phase_deg":40}}}}],
            "noise":{{"sigma_mm":0.03,"kind":"gauss"}},"seed":4}}"#,
            stops.collect::<Vec<_>>().join(",")
        );
        let scenario = parse_scenario(scenario.as_bytes()).unwrap().scenario;
        let mut session = simulate(&scenario, 1, unwatched).unwrap().0;
        for joint in &mut session.robot.joints {
            joint.link = None;
        }
        let prepared = PreparedSearch::new(&session, &Options::default()).unwrap();
        let regression = &prepared.regression;
        let search = Search {
            regression,
            folds: &prepared.folds,
            most: 5,
            watch: &|_| true,
            unseen: Memo::new(KEPT),
        };
        let base = regression.fit(&regression.base, &[]);
        let mut scores = regression.scan(&base, Additions::Names.among());
        search.retain_compatible(&base, Additions::Names, &mut scores);
        by_odds(&mut scores);
        let first = search.regression.refined(&base, scores[0].candidate);
        let first = regression.with(&base, &first);
        assert_eq!(first.ln_evidence, f64::NEG_INFINITY);
        let next = search.step(&base, Additions::Names).unwrap();
        assert!(next.ln_evidence > base.ln_evidence);
    }

    /// Loads of 2 and 6 kg on a link that droops, and a base that is higher by as much as it droops in the mean: the
    /// droop alone explains a fifth of what both explain together, and the base nothing.
    #[test]
    fn two_that_cancel_each_other_but_for_the_rest_are_found_together() {
        let stops = (0..120).map(|k| {
            let turn = 300.0 * (f64::from(k) * 0.754_877_666).fract() - 150.0;
            format!(r#"{{"q_deg":[{turn}]}}"#)
        });
        let scenario = format!(
            r#"{{"format":"truepose-scenario/1","name":"heavy","robot":{{"name":"r",
            "gravity_m_s2":[0,0,-9.81],"joints":[
            {{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0],"limits":[-170,170]}}],
            "tool":{{"position_mm":[400,0,300],"quaternion_wxyz":[1,0,0,0]}}}},"targets":{{"T1":[0,0,0]}},
            "instrument":{{"name":"tracker","sigma_mm":0.02}},
            "poses":{{"list":[{}]}},"conditions":{{"load_kg":[2,6]}},
            "effects":[{{"effect":"link-droop","parameters":{{"mm_per_kg":0.0078}}}},
            {{"effect":"base-offset","parameters":{{"x_mm":0,"y_mm":0,"z_mm":0.0312}}}}],
            "noise":{{"sigma_mm":0.02,"kind":"gauss"}},"seed":1}}"#,
            stops.collect::<Vec<_>>().join(",")
        );
        let scenario = parse_scenario(scenario.as_bytes()).unwrap().scenario;
        let session = simulate(&scenario, 1, unwatched).unwrap().0;
        let prepared = PreparedSearch::new(&session, &Options::default()).unwrap();
        let found = prepared.search(&|_| true).unwrap();
        let names = prepared.regression.added(&found.fit);
        let names: Vec<&str> = names.iter().map(|t| t.effect.about().id).collect();
        // At one height an instrument's scale is equivalent to a higher base.
        let higher = names.contains(&"base-offset") || names.contains(&"instrument-scale");
        assert!(
            names.len() == 2 && names.contains(&"link-droop") && higher,
            "{names:?}"
        );
    }
}
