//! How a session was identified, as far as that outlives the window.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::effects::{self, CATALOGUE, Term, form_with};
use crate::gui::core::document::{Added, Document, Method};
use crate::gui::core::loaded_session::LoadedSession;
use crate::kinematics::Robot;
use crate::text::Template;

/// Names that no effect has do not count.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Choices {
    identified: bool,
    regional: bool,
    /// Effects of the exact fit.
    effects: Vec<String>,
    /// Effects that a search found and that were added to it.
    #[serde(default)]
    added: Vec<SavedTerm>,
}

/// An effect that was added, as it is kept. A smooth correction is not: its curve belongs to a search.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct SavedTerm {
    effect: String,
    joint: usize,
    setting: f64,
    coefficients: Vec<f64>,
    on: bool,
}

impl SavedTerm {
    fn of(added: &Added) -> Option<Self> {
        let term = &added.term;
        (term.curve.is_none() && term.rest.is_none()).then(|| Self {
            effect: term.effect.about().id.to_owned(),
            joint: term.joint,
            setting: term.setting,
            coefficients: term.coefficients.clone(),
            on: added.on,
        })
    }

    /// The effect on this robot; `None` where it cannot be one of its.
    fn added(&self, robot: &Robot) -> Option<Added> {
        let effect = effects::find(&self.effect)?;
        let effect = form_with(effect, |form| {
            form.about().form.coefficients() == self.coefficients.len()
        });
        let mut term = Term::absent(effect, self.joint, self.setting);
        let fits = self.joint < robot.joints.len()
            && self.coefficients.len() == term.coefficients.len()
            && self.coefficients.iter().all(|c| c.is_finite())
            && self.setting.is_finite();
        term.coefficients.clone_from(&self.coefficients);
        fits.then_some(Added { term, on: self.on })
    }
}

impl Document {
    /// How it is identified; a model that was read from a file stands in that.
    pub(crate) fn choices(&self) -> Choices {
        Choices {
            identified: self.identified && self.loaded_model.is_none(),
            regional: self.method == Method::Regional,
            effects: self.effects.iter().map(|e| (*e).to_owned()).collect(),
            added: self.added.iter().filter_map(SavedTerm::of).collect(),
        }
    }

    /// What a window that is gone has left behind, with the choices that were made.
    pub(crate) fn recover(
        &mut self,
        loaded_session: Arc<LoadedSession>,
        kept: &Choices,
    ) -> Template {
        self.open(loaded_session);
        self.loaded_model = None;
        self.identified = kept.identified;
        if kept.regional && self.loaded_session.single_revolute() {
            self.method = Method::Regional;
        }
        let all = CATALOGUE.iter().map(|effect| effect.about().id);
        let chosen = all.filter(|id| kept.effects.iter().any(|e| e == id));
        self.effects = chosen.collect();
        let robot = &self.loaded_session.session.robot;
        let added = kept.added.iter().filter_map(|one| one.added(robot));
        self.added = added.collect();
        phrase!("restore")
    }
}
