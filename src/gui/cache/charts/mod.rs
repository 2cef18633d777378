//! What a chart of samples is made of, worked out once in the background when something changes:
//! no frame looks at all samples.

pub(crate) mod effect;
pub(crate) mod envelope;
pub(crate) mod histogram;
pub(crate) mod orders;
pub(crate) mod over;
mod sums;

use crate::gui::core::answer::Answer;
use crate::gui::core::loaded_session::{Component, Subject};
use crate::gui::core::scale::FEW;

use crate::gui::cache::charts::effect::EffectCurve;
use crate::gui::cache::charts::envelope::Envelope;
use crate::gui::cache::charts::histogram::Histogram;
use crate::gui::cache::charts::orders::Spectrum;
use crate::gui::cache::charts::over::{Over, Variable};

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Asked {
    /// It stands on the samples themselves, or on none.
    Nothing,
    /// The extremes of many samples.
    Over(Over),
    /// The orders over the angle of a joint; those of known gears with their neighbours.
    Orders(usize, Vec<usize>),
    /// How many samples deviate by how much.
    Histogram,
    /// The curve of a found effect.
    Effect(effect::Asked),
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Charted {
    /// The extremes of many samples.
    Over(Envelope),
    Orders(Spectrum),
    /// How many samples deviate by how much; `None` where there is none.
    Histogram(Option<Histogram>),
    /// The curve of a found effect, if it is there still.
    Effect(Option<EffectCurve>),
}

impl Asked {
    /// Whether there is anything to work out.
    pub(crate) fn any(&self, subject: &Subject) -> bool {
        match self {
            Self::Nothing => false,
            Self::Over(_) => subject.overview.usable.len() > FEW,
            Self::Orders(..) | Self::Histogram | Self::Effect(_) => true,
        }
    }
}

impl Charted {
    /// Works it out. Takes its time with many samples.
    pub(crate) fn of(
        asked: &Asked,
        subject: &Subject,
        answer: Option<&Answer>,
        component: Component,
    ) -> Option<Self> {
        if !asked.any(subject) {
            return None;
        }
        match asked {
            Asked::Nothing => None,
            Asked::Over(over) => Some(Self::Over(Envelope::of(subject, answer, component, *over))),
            Asked::Orders(joint, gears) => {
                let over = Over {
                    variable: Variable::Joint,
                    joint: *joint,
                };
                let angle = |i: usize| over.of(subject, i);
                let usable = subject.overview.usable.iter().map(|i| *i as usize);
                let usable: Vec<usize> = usable.filter(|i| angle(*i).is_finite()).collect();
                let angles: Vec<f64> = usable.iter().map(|i| angle(*i)).collect();
                let [before, after] = values(subject, answer, component, &usable);
                let before = before.unwrap_or_default();
                let spectrum = Spectrum::new(&angles, &before, after.as_deref(), gears);
                Some(Self::Orders(spectrum))
            }
            Asked::Histogram => {
                let usable = subject.overview.usable.iter().map(|i| *i as usize);
                let usable: Vec<usize> = usable.collect();
                let [before, after] = values(subject, answer, component, &usable);
                let length = component == Component::Length;
                let before = before.unwrap_or_default();
                let histogram = Histogram::new(&before, after.as_deref(), length);
                Some(Self::Histogram(histogram))
            }
            Asked::Effect(asked) => Some(Self::Effect(EffectCurve::of(subject, asked, component))),
        }
    }
}

/// A component of the deviations before, and after where it is known.
fn values(
    subject: &Subject,
    answer: Option<&Answer>,
    component: Component,
    samples: &[usize],
) -> [Option<Vec<f64>>; 2] {
    let of = |deviation: &dyn Fn(usize) -> [f64; 3]| {
        let value = |i: &usize| subject.component(deviation(*i), *i, component);
        samples.iter().map(value).collect::<Vec<f64>>()
    };
    [
        Some(of(&|i| subject.deviation_before(i))),
        answer.map(|answer| of(&|i| answer.deviation_after(i))),
    ]
}
