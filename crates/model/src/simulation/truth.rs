//! The effects of a simulated session, for whoever checks the answer; the session itself does not contain them.

use super::scenario::Noise;
use crate::document::{Member, Value, object, text_of};
use crate::effects::Term;
use crate::model::Positions;

/// Parameters that were put into a simulated session.
#[derive(Debug, Clone, PartialEq)]
pub struct Truth {
    /// Name of the session.
    pub name: String,
    /// The seed that was used.
    pub seed: u64,
    /// The effects, in the order in which they act.
    pub effects: Vec<Term>,
    /// The noise.
    pub noise: Option<Noise>,
    /// Outliers, counted from 0.
    pub outliers: Vec<usize>,
    /// The points without noise, outliers and rounding.
    pub exact: Positions,
}

/// Twelve digits: an amplitude and a phase lose their last bits on the way through sine and cosine,
/// and the truth should look as it was given.
fn as_given(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

impl Truth {
    /// The truth as a JSON document, `truepose-truth/1`. Samples are counted from 1 in it, as the
    /// rows of the session.
    pub fn to_json(&self) -> String {
        let effect = |term: &Term| {
            let about = term.effect.about();
            let mut all = vec![Member::new("effect", about.id)];
            all.extend(
                about
                    .per_joint
                    .then(|| Member::new("joint", term.joint + 1)),
            );
            let own = term.parameters();
            let own = own.iter().map(|p| Member::new(p.name, as_given(p.value)));
            all.push(Member::new("parameters", Value::Object(own.collect())));
            Value::Object(all)
        };
        let noise = |noise: Noise| {
            object! { "sigma_mm": noise.sigma_mm, "kind": noise.kind.name() }
        };
        text_of(&object! {
            "format": "truepose-truth/1",
            "session": &self.name,
            "seed": self.seed,
            "effects": self.effects.iter().map(effect).collect::<Value>(),
            "noise": self.noise.map(noise),
            "outliers": self.outliers.iter().map(|i| i + 1).collect::<Value>(),
        })
    }
}
