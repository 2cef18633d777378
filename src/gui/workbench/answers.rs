//! What the background has worked out about the document, and what is asked of it next.

use std::path::PathBuf;
use std::sync::Arc;

use nalgebra::{Isometry3, Vector3};

use crate::compensation::decision::FittedErrors;
use crate::diagnosis::Diagnosis;
use crate::effects::Term;
use crate::explain::{Detail, Section, diagnosis};
use crate::gui::cache::heat::Heat;
use crate::gui::cache::{
    ExportPreview, IdentifiedAnswer, PlotInputs, PreviewRequest, figures, preview,
};
use crate::gui::charts::Scene;
use crate::gui::charts::effect::sketches;
use crate::gui::core::answer::{Answer, LoadedModel, Question};
use crate::gui::core::document::Method;
use crate::gui::core::overview::{FEW, measuring_from_base};
use crate::gui::core::search::{Search, term_of};
use crate::gui::jobs::{Kind, Slot, Watch};
use crate::gui::view::{Facing, Message, Sorting, Step};
use crate::gui::workbench::{Derived, Workbench};
use crate::present::numbers::{grouped, notation, write_numbers};
use crate::text::current;

/// Not shown, and not cancelled.
pub(super) const QUIETLY: (Kind, &str) = (Kind::Quiet, "");

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
    pub(crate) fn question(&self) -> Option<Question> {
        let question = self.document().question()?;
        Some(match &self.derived.searched {
            Some(search) => question.found_by(search),
            None => question,
        })
    }

    /// The newest answer for the present session, or why there is none. While a newer question is
    /// being answered it is the answer to the one before.
    pub(crate) fn identified(&self) -> Option<&IdentifiedAnswer> {
        let (_, made) = self.derived.identified.made()?;
        let asked = self.document().question()?;
        let of_this = Arc::ptr_eq(&made.question.loaded_session, &asked.loaded_session);
        let [asked, answered] = [&asked, &made.question].map(|q| std::mem::discriminant(&q.asks));
        (of_this && asked == answered).then_some(&**made)
    }

    /// The newest answer, to be held where it is one that is shown.
    pub(super) fn shown_outcome(&self) -> Option<Arc<IdentifiedAnswer>> {
        let (_, newest) = self.derived.identified.made()?;
        self.answer().map(|_| Arc::clone(newest))
    }

    /// The newest answer.
    pub(crate) fn answer(&self) -> Option<&Answer> {
        self.identified().and_then(|o| o.answer.as_ref().ok())
    }

    /// Whether plots leave out the deviation before, so that what is left can be seen.
    pub(crate) fn only_after(&self) -> bool {
        self.view.only_after && self.answer().is_some()
    }

    /// What plots are worked out of.
    pub(super) fn plot_inputs(&self) -> PlotInputs {
        PlotInputs {
            loaded_session: Arc::clone(self.loaded_session()),
            identified: self.shown_outcome(),
        }
    }

    /// The identified pose of the base in the measuring frame, where the instrument stands in a frame
    /// of its own, and the nominal robot was not seen from there: then deviations before are mostly
    /// those of the frame.
    pub(crate) fn found_base(&self) -> Option<Isometry3<f64>> {
        /// Part of the workspace that is far.
        const FAR: f64 = 0.05;
        if self.loaded_session().base.is_some() {
            return None;
        }
        let reach_mm = self.loaded_session().overview.reach_mm;
        measuring_from_base(&self.answer()?.calibration.model, FAR * reach_mm)
    }

    /// Where the base is drawn in the measuring frame: in space where the session's setups put it, or
    /// as it was identified, once that is shown.
    pub(crate) fn base(&self) -> Isometry3<f64> {
        let in_space = self.view.in_space;
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
        let ((of, plane), heat) = self.derived.heat.made()?;
        let of_this = Arc::ptr_eq(&of.loaded_session, self.loaded_session());
        let shown = of_this && self.shows_heat() && *plane == self.view.plane;
        heat.as_ref().filter(|_| shown)
    }

    fn shows_heat(&self) -> bool {
        self.view.heat && !self.view.in_space
    }

    /// The export as it would be written, or why there is none. While a newer one of the same table is being made it
    /// is the one before; the figures of another format say nothing of this one.
    pub(crate) fn export(&self) -> Option<Result<&Arc<ExportPreview>, &String>> {
        self.answer()?;
        let (of, made) = self.derived.preview.made()?;
        let PreviewRequest {
            identified, choice, ..
        } = of;
        let same = Arc::ptr_eq(&identified.question.loaded_session, self.loaded_session())
            && choice.is_of_the_table(&self.document().export);
        same.then_some(made.as_ref())
    }

    /// The RMS error that the controller is left with by the table of what is shown, mm; `None` until that is made.
    pub(crate) fn left_by_table_mm(&self) -> Option<f64> {
        let made = self.export()?.ok()?;
        let (of, _) = self.derived.preview.made()?;
        let is_of_this = Arc::ptr_eq(&self.derived.identified.made()?.1, &of.identified);
        let error = made.error.filter(|_| made.export.robot.is_none());
        error.filter(|_| is_of_this).map(|error| error.rms_mm)
    }

    /// Whether the preparation of the export was cancelled: it is not begun again by itself.
    pub(crate) fn is_unprepared(&self) -> bool {
        let choice = &self.document().export;
        let cancelled = self.derived.preview.declined();
        cancelled.is_some_and(|wanted| wanted.choice.is_of_the_table(choice))
    }

    /// The files that were exported from the model that is shown, the newest last: a table of another
    /// model is another step's work.
    pub(crate) fn exported(&self) -> impl DoubleEndedIterator<Item = &PathBuf> {
        let shown = self.question();
        let all = self.file_state.exported.iter();
        all.filter_map(move |one| (shown.as_ref() == Some(&one.of)).then_some(&one.path))
    }

    /// Whether the identification was cancelled: it is not repeated by itself.
    pub(crate) fn is_declined(&self) -> bool {
        let declined = self.derived.identified.declined();
        declined.is_some() && self.question().as_ref() == declined
    }

    /// A search of the open session: it begins where the identification ends, and goes with it where that is undone.
    pub(super) fn search_of_this(&self) -> Option<&Arc<Search>> {
        let search = self.derived.searched.as_ref()?;
        let of_this = Arc::ptr_eq(&search.loaded_session, self.loaded_session());
        (of_this && self.document().identified).then_some(search)
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
        let found = diagnosis.found.iter().filter_map(|f| term_of(diagnosis, f));
        found.filter(|term| !self.is_added(term)).collect()
    }

    /// What predicts without a name and is not in the model.
    pub(crate) fn predicting_not_added(&self) -> Vec<Term> {
        let all = self.diagnosis().map(Diagnosis::unnamed_terms);
        let mut all = all.unwrap_or_default();
        all.retain(|term| !self.is_added(term));
        all
    }

    fn is_added(&self, term: &Term) -> bool {
        let mut added = self.document().added.iter();
        added.any(|a| a.term.same_column(term))
    }

    /// A search begins where the exact identification ends.
    pub(crate) fn search(&mut self) {
        if self.loaded_session().is_empty() {
            let first = say!("Open a session that was measured on this robot");
            return self.complain(first, None::<&str>);
        }
        // Asked for by its key it is seen as well.
        self.view.step = Step::Gap;
        let document = self.document();
        let exact = document.identified
            && document.method == Method::Exact
            && document.loaded_model.is_none();
        if !exact {
            let title = say!(
                "The diagnosis starts from the full model, which takes the place of what is identified now. Undo brings that back"
            );
            let replaced = document.loaded_model.is_some() || document.identified;
            self.view.message = replaced.then(|| Message::done(title, Vec::new()));
            self.identify(Some(Method::Exact));
        }
        if self.searching().is_some() {
            return;
        }
        let session = Arc::clone(self.loaded_session());
        self.derived.stopped = None;
        self.derived.searching = Some(Arc::clone(&session));
        self.jobs.start(
            Kind::Searches,
            say!("Diagnosis is running"),
            move |watch| Search::of(session, watch),
            // What is in the model may be just what was found, with the search's values.
            |bench: &mut Self, search| {
                bench.derived.searching = None;
                bench.derived.searched = Some(Arc::new(search));
            },
        );
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
        let wanted = PreviewRequest {
            identified: outcome,
            choice: self.document().export.clone(),
            name: self.saved_as(),
        };
        let how = (Kind::Prepares, say!("The table is being prepared"));
        self.derive(
            how,
            |derived| &mut derived.preview,
            wanted,
            |of, _| preview(of),
        );
    }

    /// The samples in the order of their rows; `None`: as they were measured.
    pub(crate) fn order(&self) -> Option<Arc<[u32]>> {
        let sorting = self.view.sorting;
        if sorting == Sorting::default() {
            return None;
        }
        let of = self.plot_inputs();
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
        let after = self.answer().map(|a| a.after.length_mm[sample]);
        match self.view.sorting.by {
            0 => sample as f64,
            1 => loaded_session.q(sample),
            2 => before,
            3 => after.unwrap_or(f64::NAN),
            // How far outside the tolerance.
            _ => after.unwrap_or(before),
        }
    }

    /// Asks for what the plots stand on, if it is not there and not on its way.
    pub(crate) fn keep_drawing(&mut self) {
        if self.shows_heat() {
            let of = (self.plot_inputs(), self.view.plane);
            self.derive(
                QUIETLY,
                |derived| &mut derived.heat,
                of,
                |(of, plane), _| Heat::of(&of.loaded_session, of.answer(), *plane).map(Arc::new),
            );
        }
        if self.shows_figures() {
            let of = (self.plot_inputs(), self.diagnosis().map(FittedErrors::from));
            let figures = |(of, diagnosed): &_, _: &Watch| figures(of, *diagnosed);
            self.derive(QUIETLY, |derived| &mut derived.figures, of, figures);
        }
        let search = self.search_of_this().cloned();
        if let Some(search) = search.filter(|_| self.view.step == Step::Gap) {
            let scene = self.scene();
            self.derive(
                QUIETLY,
                |derived| &mut derived.sketches,
                search,
                move |_, _| sketches(&scene),
            );
        }
        let (kind, scene) = (self.kind(), Arc::new(self.scene()));
        // Of a few samples it is there in the same frame.
        let few = scene.usable().len() <= FEW;
        let of = (kind.id, scene);
        let chart = move |(_, scene): &(_, Arc<Scene>)| {
            // As the window writes them.
            write_numbers(scene.written.1);
            Arc::new((kind.show)(scene))
        };
        if !few {
            self.derive(
                QUIETLY,
                |derived| &mut derived.chart,
                of,
                move |of, _| chart(of),
            );
        } else if self.derived.chart.want(&of) {
            let made = chart(&of);
            self.derived.chart.take(of, made);
        }
    }

    /// Works something out in the background of this, where it is wanted and neither there nor on its way.
    pub(super) fn derive<K: PartialEq + Clone + Send + 'static, V: Send + 'static>(
        &mut self,
        (kind, says): (Kind, &str),
        slot: fn(&mut Derived) -> &mut Slot<K, V>,
        of: K,
        work: impl FnOnce(&K, &Watch) -> V + Send + 'static,
    ) {
        if !slot(&mut self.derived).want(&of) {
            return;
        }
        let work = move |watch: &Watch| {
            let made = work(&of, watch);
            (of, made)
        };
        self.jobs
            .start(kind, says, work, move |bench: &mut Self, (of, made)| {
                let before = slot(&mut bench.derived).take(of, made);
                bench.let_go(before);
            });
    }

    /// Asks for the answer that the document wants, if it is not there and not on its way.
    pub(super) fn refresh_answer(&mut self) {
        if let Some(question) = self.question() {
            let samples = say!(one "{count} sample", "{count} samples", count = grouped(question.loaded_session.len()));
            let says = say!("identifying, {samples}", samples);
            let identify = |question: &Question, watch: &Watch| {
                Arc::new(IdentifiedAnswer::to(question.clone(), watch))
            };
            let how = (Kind::Identifies, &*says);
            self.derive(how, |derived| &mut derived.identified, question, identify);
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
