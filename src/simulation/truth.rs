//! What was in a simulated session, for whoever checks the answer; the session itself says nothing
//! of it.

use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

use super::scenario::{Noise, NoiseKind};
use crate::document::write_document;
use crate::effects::{Parameter, Term};
use crate::model::Positions;

/// See the module.
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

#[derive(Serialize)]
struct TruthTwin<'a> {
    format: &'static str,
    session: &'a str,
    seed: u64,
    effects: Vec<EffectTwin>,
    noise: Option<NoiseTwin>,
    /// Counted from 1, as the rows of the session.
    outliers: Vec<usize>,
}

#[derive(Serialize)]
struct EffectTwin {
    effect: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    joint: Option<usize>,
    parameters: ParametersTwin,
}

struct ParametersTwin(Vec<Parameter>);

impl Serialize for ParametersTwin {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for parameter in &self.0 {
            map.serialize_entry(parameter.name, &as_given(parameter.value))?;
        }
        map.end()
    }
}

/// Twelve digits: an amplitude and a phase lose their last bits on the way through sine and cosine,
/// and the truth should look as it was given.
fn as_given(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

#[derive(Serialize)]
struct NoiseTwin {
    sigma_mm: f64,
    kind: &'static str,
}

impl NoiseKind {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Gauss => "gauss",
            Self::T4 => "t4",
            Self::Ar1 => "ar1",
        }
    }
}

impl Truth {
    /// The truth as a JSON document, `truepose-truth/1`. Samples are counted from 1 in it, as the
    /// rows of the session.
    ///
    /// # Panics
    /// Never: writing to memory does not fail.
    pub fn to_json(&self) -> String {
        let effect = |term: &Term| {
            let about = term.effect.about();
            EffectTwin {
                effect: about.id,
                joint: about.per_joint.then_some(term.joint + 1),
                parameters: ParametersTwin(term.parameters()),
            }
        };
        let twin = TruthTwin {
            format: "truepose-truth/1",
            session: &self.name,
            seed: self.seed,
            effects: self.effects.iter().map(effect).collect(),
            noise: self.noise.map(|noise| NoiseTwin {
                sigma_mm: noise.sigma_mm,
                kind: noise.kind.name(),
            }),
            outliers: self.outliers.iter().map(|i| i + 1).collect(),
        };
        let mut text = Vec::new();
        write_document(&mut text, &twin).expect("writing to memory does not fail");
        String::from_utf8(text).expect("JSON is UTF-8")
    }
}
