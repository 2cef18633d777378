//! Samples that lack a condition which the others have: the side from which a joint came, a speed,
//! the load, the temperature.
//!
//! An effect of that condition cannot act on them, so that in a model with it they look like outliers, and a handful
//! of them looks like something that no name explains. They are few as a rule and are left out with a message. Where
//! they are many the column itself is at fault, and they are kept. Where only sides are lacking and the model that is
//! handed out hardly depends on them, the search is repeated with all samples: a sweep of the first joint has no sides
//! of the joints that have not moved yet, and determines much of the geometry.

use crate::effects::Inputs;
use crate::fit::problem::Problem;
use crate::model::Model;
use crate::sessions::Samples;
use crate::sessions::measuring_order::measuring_order;

use crate::set_up_errors::DataProblem;

/// Beyond this share of the samples, those that lack a condition stay.
const MOST: f64 = 0.25;

/// Leaves out the samples that lack a condition; what was done, in words.
pub(crate) fn leave_out(problem: &mut Problem) -> Option<DataProblem> {
    let samples = &problem.session.samples;
    let conditions = conditions(samples);
    let lacks = |sample: usize| conditions.iter().any(|c| c.lacks(sample));
    let fitted: Vec<usize> = (0..problem.fit.len()).filter(|i| problem.fit[*i]).collect();
    let lacking: Vec<usize> = fitted.iter().copied().filter(|i| lacks(*i)).collect();
    if lacking.is_empty() || lacking.len() as f64 > MOST * fitted.len() as f64 {
        return None;
    }
    let columns: Vec<&str> = conditions
        .iter()
        .filter(|c| lacking.iter().any(|i| c.lacks(*i)))
        .map(|c| c.name.as_str())
        .collect();
    let left_out: Vec<bool> = (0..problem.fit.len())
        .map(|i| lacking.contains(&i))
        .collect();
    problem.leave_out(&left_out);
    if is_the_beginning(samples, &lacking) {
        return None;
    }
    let shown: Vec<String> = lacking
        .iter()
        .take(8)
        .map(|i| (i + 1).to_string())
        .collect();
    let more = if lacking.len() > shown.len() {
        ", …"
    } else {
        ""
    };
    Some(DataProblem {
        what: text!(
            one "{count} of {all} samples lacks {columns}", "{count} of {all} samples lack {columns}",
            count = lacking.len(),
            all = fitted.len(),
            columns = columns.join(", ")
        ),
        evidence: text!(
            "samples {samples}; the others have a value there, and what depends on it cannot be told from these",
            samples = format!("{}{more}", shown.join(", "))
        ),
        proposal: text!("they were excluded from the diagnosis; fill in the cells to use them"),
        samples: lacking,
        mend: None,
    })
}

/// Whether the side from which a joint came changes what a model predicts of the samples that were left out by less
/// than the noise, mm, and nothing else is lacking: then their error grows by less than a factor of √2 without it.
pub(crate) fn only_sides_that_matter_little(
    problem: &Problem,
    lacking: &DataProblem,
    model: &Model,
    noise_mm: f64,
) -> bool {
    let left_out = lacking.samples.as_slice();
    let all = conditions(&problem.session.samples);
    let sides_only = |sample: &usize| all.iter().all(|c| c.zero_is_unknown || !c.lacks(*sample));
    let from = |side: f64| {
        let mut inputs = problem.inputs.select(left_out);
        set_unknown_sides(&mut inputs, side);
        model.predict(&inputs)
    };
    if !left_out.iter().all(sides_only) {
        return false;
    }
    let (below, above) = (from(-1.0), from(1.0));
    let squares = (0..left_out.len()).flat_map(|k| {
        let (below, above) = (below.get(k), above.get(k));
        (0..3).map(move |axis| (0.5 * (above[axis] - below[axis])).powi(2))
    });
    squares.sum::<f64>() <= noise_mm.powi(2) * left_out.len() as f64
}

/// Sides that are not known become this one.
fn set_unknown_sides(inputs: &mut Inputs, side: f64) {
    for dir in inputs.dir.iter_mut().flatten() {
        for own in dir.to_mut().iter_mut().filter(|own| **own == 0.0) {
            *own = side;
        }
    }
}

/// Whether only the sample that was measured first lacks something, and that is the side from which it came: it never
/// has one, so that nothing is reported.
fn is_the_beginning(samples: &Samples, lacking: &[usize]) -> bool {
    let order = measuring_order(samples.time_s.as_deref());
    let first = order.as_ref().and_then(|order| order.first().copied());
    let sides_only = |sample: usize| {
        let mut all = conditions(samples).into_iter();
        all.all(|c| c.zero_is_unknown || !c.lacks(sample))
    };
    lacking == [first.unwrap_or(0)] && lacking.iter().all(|sample| sides_only(*sample))
}

/// A column of a condition and which of its cells are empty.
struct Condition<'a> {
    name: String,
    values: &'a [f64],
    /// A side of 0 is an unknown one.
    zero_is_unknown: bool,
}

impl Condition<'_> {
    fn lacks(&self, sample: usize) -> bool {
        let value = self.values[sample];
        value.is_nan() || self.zero_is_unknown && value == 0.0
    }

    /// Whether the known values differ: a condition that never changes shows nothing, and is not
    /// missed.
    fn varies(&self) -> bool {
        let mut known = (0..self.values.len()).filter(|i| !self.lacks(*i));
        known
            .next()
            .is_some_and(|first| known.any(|i| self.values[i] != self.values[first]))
    }
}

fn conditions(samples: &Samples) -> Vec<Condition<'_>> {
    let sides = samples.dir.iter().enumerate();
    let speeds = samples.speed.iter().enumerate();
    let columns = sides
        .map(|(joint, dir)| (format!("dir{}", joint + 1), dir, true))
        .chain(speeds.map(|(joint, speed)| (format!("speed{}", joint + 1), speed, false)))
        .chain([
            ("load_kg".to_owned(), &samples.load_kg, false),
            ("temperature_c".to_owned(), &samples.temperature_c, false),
        ]);
    let there = columns.filter_map(|(name, values, zero_is_unknown)| {
        values.as_deref().map(|values| Condition {
            name,
            values,
            zero_is_unknown,
        })
    });
    there.filter(Condition::varies).collect()
}
