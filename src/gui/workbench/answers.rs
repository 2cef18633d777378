//! What the background has worked out about the document, and what is asked of it next.

use std::path::PathBuf;
use std::sync::Arc;

use egui::TextureHandle;
use nalgebra::{Isometry3, Vector3};

use crate::diagnosis::Diagnosis;
use crate::effects::Term;
use crate::explain::{Detail, Section, diagnosis};
use crate::gui::cache::cloud::{Heat, Remainder};
use crate::gui::cache::{
    AnswerSummary, ExportPreview, IdentifiedAnswer, Made, PlotInputs, Preview, PreviewRequest,
    Work, WorkKey,
};
use crate::gui::core::answer::{Answer, LoadedModel, Question, Search, term_of};
use crate::gui::core::document::Method;
use crate::gui::core::overview::measuring_from_base;
use crate::gui::jobs::{Kind, Slot};
use crate::gui::view::{Facing, Message, Sorting, Step};
use crate::gui::workbench::{HeatLook, Workbench};
use crate::present::numbers::{grouped, notation};
use crate::text::current;

impl Workbench {
    /// Whether a model can be held against the open session: both are of the same robot. The
    /// session that the window began with counts only where the model came from it.
    pub(super) fn has_a_session_for(&self, loaded_model: &LoadedModel) -> bool {
        let loaded_session = self.loaded_session();
        if Arc::ptr_eq(loaded_session, &self.first) {
            loaded_model.came_from(&loaded_session.session)
        } else {
            !loaded_session.is_empty() && loaded_model.is_of(&loaded_session.session)
        }
    }

    /// What the answer depends on; `None` while nothing is to be identified. What was searched answers
    /// for itself.
    pub(super) fn question(&self) -> Option<Question> {
        let question = self.document().question()?;
        Some(match &self.derived.searched {
            Some(search) => question.found_by(search),
            None => question,
        })
    }

    /// The newest answer for the present session, or why there is none. While a newer question is
    /// being answered it is the answer to the one before.
    pub(crate) fn identified(&self) -> Option<&IdentifiedAnswer> {
        let document = self.document();
        self.derived
            .identified
            .made()
            .map(|made| &**made)
            .filter(|outcome| {
                let question = &outcome.question;
                document.identified
                    && Arc::ptr_eq(&question.loaded_session, &document.loaded_session)
                    && document.question().is_some_and(|asked| {
                        std::mem::discriminant(&asked.asks)
                            == std::mem::discriminant(&question.asks)
                    })
            })
    }

    /// The newest answer, to be held where it is one that is shown.
    pub(super) fn shown_outcome(&self) -> Option<Arc<IdentifiedAnswer>> {
        let newest = self.derived.identified.made().cloned();
        newest.filter(|_| self.answer().is_some())
    }

    /// The newest answer.
    pub(crate) fn answer(&self) -> Option<&Answer> {
        self.identified().and_then(|o| o.answer.as_ref().ok())
    }

    /// Whether plots leave out the deviation before, so that what is left can be seen.
    pub(crate) fn only_after(&self) -> bool {
        self.view.only_after && self.answer().is_some()
    }

    /// What follows from the newest answer, for drawing.
    pub(crate) fn after(&self) -> Option<&AnswerSummary> {
        self.identified().and_then(|o| o.after.as_ref())
    }

    /// What came of a work, for the newest answer that it was worked out for.
    pub(super) fn made(&self, work: &Work) -> Option<&Made> {
        let mut plots = self.derived.plots.iter();
        let (_, slot) = plots.find(|(key, _)| *key == work.key)?;
        let of_this =
            |made: &&Made| Arc::ptr_eq(&made.inputs.loaded_session, self.loaded_session());
        slot.made().map(|made| &**made).filter(of_this)
    }

    /// The identified pose of the base in the measuring frame, where the instrument stands in a frame
    /// of its own, and the nominal robot was not seen from there: then deviations before are mostly
    /// those of the frame.
    pub(crate) fn found_base(&self) -> Option<Isometry3<f64>> {
        if self.loaded_session().base.is_some() {
            return None;
        }
        let model = &self.answer()?.calibration.model;
        measuring_from_base(model, self.far_mm())
    }

    fn far_mm(&self) -> f64 {
        /// Part of the workspace.
        const FAR: f64 = 0.05;
        FAR * self.loaded_session().overview.reach_mm
    }

    /// Where the base is drawn in the measuring frame: in space where the session's setups put it, or
    /// as it was identified, once that is shown.
    pub(crate) fn base(&self) -> Isometry3<f64> {
        let in_space = self.view.in_space();
        let shown = in_space && self.view.blend > 0.0;
        let found = self.found_base().filter(|_| shown);
        let own = self.loaded_session().base.filter(|_| in_space);
        found.or(own).unwrap_or_else(Isometry3::identity)
    }

    /// The axes of the view of the workspace, in the measuring frame. In space z of the base is up.
    pub(crate) fn facing(&self) -> Facing {
        let turn = self.base().rotation;
        self.view
            .facing()
            .map(|axis| (turn * Vector3::from(axis)).into())
    }

    /// The heat map, if it is shown. While a newer one is being made it is the one before.
    pub(crate) fn heat(&self) -> Option<&Arc<Heat>> {
        let wanted = self.view.heat && !self.view.in_space();
        let work = wanted.then(|| Work::heat(self.view.plane))?;
        let made: &Option<Arc<Heat>> = self.made(&work)?.result.downcast_ref()?;
        made.as_ref()
    }

    /// The heat map as it is looked at, made anew where it changes.
    pub(crate) fn heat_picture(
        &self,
        of: HeatLook,
        make: impl FnOnce() -> TextureHandle,
    ) -> TextureHandle {
        self.derived.heat_picture.get(of, make)
    }

    /// What is left of the deviations, as it is uploaded.
    pub(crate) fn remainder(&self) -> Option<Arc<Remainder>> {
        self.after().map(|after| Arc::clone(&after.remainder))
    }

    /// The export as it would be written, or why there is none. While a newer one of the same table is being made it
    /// is the one before; the figures of another format say nothing of this one.
    pub(crate) fn export(&self) -> Option<Result<&ExportPreview, &String>> {
        self.answer()?;
        let preview = self.derived.preview.made()?;
        let PreviewRequest {
            identified, choice, ..
        } = &preview.wanted;
        let same = Arc::ptr_eq(&identified.question.loaded_session, self.loaded_session())
            && choice.is_of_the_table(self.document().export);
        same.then_some(preview.made.as_ref())
    }

    /// The RMS error that the controller is left with by the table of what is shown, mm; `None` until that is made.
    pub(crate) fn left_by_table_mm(&self) -> Option<f64> {
        let made = self.export()?.ok()?;
        let of = &self.derived.preview.made()?.wanted.identified;
        let is_of_this = Arc::ptr_eq(self.derived.identified.made()?, of);
        let error = made.error.filter(|_| made.export.robot.is_none());
        error.filter(|_| is_of_this).map(|error| error.rms_mm)
    }

    /// Whether the preparation of the export was cancelled: it is not begun again by itself.
    pub(crate) fn is_unprepared(&self) -> bool {
        let choice = self.document().export;
        let cancelled = self.derived.preview.declined();
        cancelled.is_some_and(|wanted| wanted.choice.is_of_the_table(choice))
    }

    /// The files that were exported from the model that is shown, the newest last: a table of another
    /// model is another step's work.
    pub(crate) fn exported(&self) -> impl DoubleEndedIterator<Item = &PathBuf> {
        let shown = self.question();
        let of_this = self
            .file_state
            .exported
            .iter()
            .filter(move |(_, of)| *of == shown);
        of_this.map(|(path, _)| path)
    }

    /// Whether the identification was cancelled: it is not repeated by itself.
    pub(crate) fn is_declined(&self) -> bool {
        let declined = self.derived.identified.declined();
        declined.is_some() && self.question().as_ref() == declined
    }

    /// Whether the answer that is shown belongs to the document as it is.
    #[cfg(any(test, debug_assertions))]
    pub(crate) fn settled(&self) -> bool {
        match (self.question(), self.derived.identified.made()) {
            (None, _) => true,
            (Some(asked), Some(outcome)) => outcome.question == asked,
            (Some(_), None) => false,
        }
    }

    /// A search of the open session: it begins where the identification ends, and goes with it where that is undone.
    pub(super) fn search_of_this(&self) -> Option<&Arc<Search>> {
        let search = self
            .derived
            .searched
            .as_ref()
            .filter(|_| self.document().identified)?;
        Arc::ptr_eq(&search.loaded_session, self.loaded_session()).then_some(search)
    }

    /// What it found, or why it found nothing out.
    pub(crate) fn searched(&self) -> Option<Result<&Diagnosis, &String>> {
        Some(self.search_of_this()?.answer.as_ref())
    }

    /// The diagnosis of the open session.
    pub(crate) fn diagnosis(&self) -> Option<&Diagnosis> {
        self.searched().and_then(Result::ok)
    }

    /// What was found and is not in the model.
    pub(crate) fn not_added(&self) -> Vec<Term> {
        let Some(diagnosis) = self.diagnosis() else {
            return Vec::new();
        };
        let there = |term: &Term| {
            let mut added = self.document().added.iter();
            added.any(|a| a.term.same_column(term))
        };
        let found = diagnosis.found.iter().filter_map(|f| term_of(diagnosis, f));
        found.filter(|term| !there(term)).collect()
    }

    /// A search begins where the exact identification ends.
    pub(crate) fn search(&mut self) {
        if self.loaded_session().is_empty() {
            return self.complain(
                say!("There is nothing to search yet"),
                [say!("Open a session that was measured on this robot")],
            );
        }
        // Asked for by its key it is seen as well.
        self.view.step = Step::Gap;
        let document = self.document();
        let exact = document.identified
            && document.method == Method::Exact
            && document.loaded_model.is_none();
        if !exact {
            let title = match &document.loaded_model {
                Some(_) => Some(say!(
                    "Identified with the full model in place of the model from a file"
                )),
                None if document.identified => Some(say!(
                    "Identified with the full model in place of the identification by region"
                )),
                None => None,
            };
            self.view.message = title.map(|title| {
                let undo =
                    say!("The diagnosis starts from the full model; undo brings the other back");
                Message::done(title.to_owned(), vec![undo.to_owned()])
            });
            self.identify(Some(Method::Exact));
        }
        self.search_in(Arc::clone(self.loaded_session()));
    }

    /// Prepares the export whose preparation was cancelled.
    pub(crate) fn prepare_again(&mut self) {
        self.derived.preview.resume();
    }

    /// Asks for the preview that the export step shows.
    pub(super) fn keep_preparing(&mut self) {
        // A model by itself has nothing to show but its table.
        let shown = self.view.step == Step::Export || self.loaded_session().is_empty();
        let Some(outcome) = self.shown_outcome().filter(|_| shown) else {
            return;
        };
        let choice = self.document().export;
        let saved = self
            .file_state
            .saved_as
            .as_ref()
            .filter(|(of, _)| *of == choice);
        let wanted = PreviewRequest {
            identified: outcome,
            choice,
            name: saved.map(|(_, name)| name.clone()),
        };
        if self.derived.preview.want(&wanted) {
            self.jobs.start(
                Kind::Prepares,
                say!("preparing the table"),
                move |_| Preview::to(wanted),
                |bench: &mut Self, preview| drop(bench.derived.preview.take(preview)),
            );
        }
    }

    /// The samples in the order of their rows; `None`: as they were measured.
    pub(crate) fn order(&self) -> Option<Arc<[u32]>> {
        let sorting = self.view.sorting;
        if sorting == Sorting::default() {
            return None;
        }
        let of = PlotInputs {
            loaded_session: Arc::clone(self.loaded_session()),
            identified: self.shown_outcome(),
        };
        let sorted = || {
            let n = u32::try_from(self.loaded_session().len()).unwrap_or(u32::MAX);
            let keyed = (0..n).map(|i| (self.sorted_by(i as usize), i));
            let mut keyed: Vec<(f64, u32)> = keyed.collect();
            keyed.sort_by(|(a, _), (b, _)| {
                let up = a.total_cmp(b);
                let values = if sorting.descending { up.reverse() } else { up };
                // What has no value stands last either way.
                a.is_nan().cmp(&b.is_nan()).then(values)
            });
            keyed.into_iter().map(|(_, i)| i).collect()
        };
        Some(self.derived.order.get((of, sorting), sorted))
    }

    /// What a sample is sorted by.
    fn sorted_by(&self, sample: usize) -> f64 {
        let loaded_session = self.loaded_session();
        let before = loaded_session.before.length_mm[sample];
        let after = self.answer().map(|a| a.lengths_mm[sample]);
        match self.view.sorting.by {
            0 => sample as f64,
            1 => loaded_session.q(sample),
            2 => before,
            3 => after.unwrap_or(f64::NAN),
            // How far outside the tolerance.
            _ => after.unwrap_or(before),
        }
    }

    /// So many samples can be drawn at once.
    pub(crate) fn draw_at_most(&mut self, most: usize) {
        self.view.most_drawn = most;
    }

    /// Asks for what the plots stand on, if it is not there and not on its way.
    pub(super) fn keep_drawing(&mut self) {
        let newest = self.derived.identified.made().cloned();
        let inputs = PlotInputs {
            loaded_session: Arc::clone(self.loaded_session()),
            identified: newest.filter(|_| self.identified().is_some()),
        };
        let works = self.works();
        let plots = &mut self.derived.plots;
        plots.retain(|(key, slot)| {
            let of = slot.made().map(|made| &made.inputs);
            let of_this = of.is_some_and(|of| of.loaded_session == inputs.loaded_session);
            // Other steps say the figures of the export step as well, of the same answer.
            let figures = matches!(key, WorkKey::Figures(_)) && of == Some(&inputs);
            slot.busy() || of_this && (figures || works.iter().any(|work| work.key == *key))
        });
        for work in works {
            let here = plots.iter().position(|(key, _)| *key == work.key);
            let here = here.unwrap_or_else(|| {
                plots.push((work.key.clone(), Slot::default()));
                plots.len() - 1
            });
            if plots[here].1.want(&inputs) {
                let (key, inputs) = (work.key.clone(), inputs.clone());
                self.jobs.quietly(
                    move || work.made(inputs),
                    move |bench: &mut Self, made| {
                        let mut plots = bench.derived.plots.iter_mut();
                        let slot = plots.find(|(one, _)| *one == key);
                        let before = slot.and_then(|(_, slot)| slot.take(made));
                        bench.let_go(before);
                    },
                );
            }
        }
    }

    /// Asks for the answer that the document wants, if it is not there and not on its way.
    pub(super) fn refresh_answer(&mut self) {
        let Some(question) = self.question() else {
            return;
        };
        if self.derived.identified.want(&question) {
            let samples = say!(one "{count} sample", "{count} samples", count = grouped(question.loaded_session.len()));
            self.jobs.start(
                Kind::Identifies,
                say!("identifying, {samples}", samples),
                move |watch| IdentifiedAnswer::to(question, watch),
                |bench: &mut Self, answer| {
                    let before = bench.derived.identified.take(answer);
                    bench.let_go(before);
                },
            );
        }
    }

    /// What the diagnosis of the open session says; nothing where there is none.
    pub(crate) fn diagnosis_sections(&self) -> Arc<[Section]> {
        let (Some(search), Some(found)) = (self.search_of_this(), self.diagnosis()) else {
            return Arc::default();
        };
        let units = self.units();
        let of = (Arc::clone(search), (units, current(), notation()));
        let say = || diagnosis(found, Detail::window(units)).into();
        self.derived.sections.get(of, say)
    }
}
