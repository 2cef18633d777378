//! What the words mean, in the technician's own: one table for the tips beside the numbers and for
//! the sheet that lists them all.

use crate::text::{Template, capital, spoken};

/// A word and what it means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Word {
    pub(crate) name: Template,
    pub(crate) means: Template,
}

impl Word {
    pub(crate) fn name(self) -> String {
        capital(spoken(self.name))
    }

    /// What it means, and what to do with it.
    pub(crate) fn means(self) -> &'static str {
        spoken(self.means)
    }
}

macro_rules! words {
    ($($id:ident, $name:expr, $means:expr $(, [$($before:expr),*])?;)*) => {
        $(pub(crate) const $id: Word = Word {
            name: $name,
            means: $means,
        };)*
        /// All of them, in the order in which the work meets them.
        pub(crate) const ALL: &[Word] = &[$($id),*];
        /// What stands before a number, and the word that explains it.
        const NAMES: &[(&[Template], Word)] = &[$((&[$name $(, $($before),*)?], $id)),*];
    };
}

words! {
    DEVIATION, phrase!("deviation"), phrase!("Where the reflector was measured, minus where the simulation says it should be");
    GAP, phrase!("RMS error"), phrase!("Root mean square of the length of the deviation over all samples. Suspected outliers do not count in it, but they do in the largest deviation"),
        [phrase!("RMS error, nominal robot"), phrase!("RMS error, identified"), phrase!("RMS error, with what was found")];
    TOLERANCE, phrase!("tolerance"), phrase!("How far a measured position may be off. Samples within it are marked with a disc, those outside with a diamond"),
        [phrase!("within tolerance"), phrase!("within tolerance, commands corrected"), phrase!("within tolerance, with the model")];
    NOISE, phrase!("noise, one σ"), phrase!("How much the instrument's own reading scatters along one axis, as its maker or a repeatability check says. Two of three readings are nearer than this. Without it, it is estimated from the samples"),
        [phrase!("noise"), phrase!("Measurement noise")];
    FLOOR, phrase!("noise floor"), phrase!("The RMS error of a perfect model: the scatter of repeated poses, or of the instrument. No model can come below it, and one that comes close has nothing left to explain");
    INTERVAL, phrase!("Interval, ±"), phrase!("The true value lies within it in 19 of 20 calibrations like this one. It shrinks with more samples and with poses that differ more");
    HELD_OUT, phrase!("held out"), phrase!("Samples that no fit has seen. The model has to predict them: an RMS error that falls there too is proof, one that falls only on the others is chance"),
        [phrase!("Cross-validation"), phrase!("RMS error, cross-validated")];
    P_FAMILY, phrase!("By chance"), phrase!("How often noise alone would make some name of the whole list look at least this good. 1 of 2000 is hard evidence, 1 of 20 is not"),
        [phrase!("Evidence")];
    ODDS, phrase!("Odds over the next candidate"), phrase!("How many times more likely this name is than the next best one, given the samples. Below about 20 : 1 both stay possible, and the poses that would decide are listed"),
        [phrase!("Odds")];
    UNEXPLAINED, phrase!("unexplained"), phrase!("Something regular is left that no name of the list fits. It is shown where it is, so that you can look there");
    LIMIT, phrase!("Detection limit"), phrase!("The smallest size of an effect that these samples would have shown. What was not found is smaller than this, not necessarily nothing");
    REGION, phrase!("region"), phrase!("A range of the joint that gets a constant correction of its own, as older controllers want it"),
        [phrase!("regions")];
    CORRECTION, phrase!("Correction"), phrase!("What to add to the command or the position: the deviation with the opposite sign");
    OUTLIER, phrase!("Suspected outlier"), phrase!("A sample so far from the model that it is at least four times likelier to be a mistake of the measurement than noise. It is excluded from the fit, stays on the screen, and is worth measuring again");
    SLOW_NOISE, phrase!("Slow noise"), phrase!("A part of the error that wanders in time, whatever the robot does: a tripod that settles, air, a tracker that warms up. The intervals allow for it, and no effect of the robot is read into it");
    NOT_IDENTIFIABLE, phrase!("Not identifiable"), phrase!("Two causes that do the same to every sample measured so far. Poses that differ more, a second reflector, or both directions usually tell them apart");
    REMAINDER, phrase!("not correctable by joint commands"), phrase!("RMS error that remains when the controller applies the whole table: directions in which moving this joint moves nothing");
    POLAR, phrase!("Polar view"), phrase!("A component of the deviation around the angle of the joint, as circles of a ballbar test are shown (ISO 230-4): on the nominal circle there is none, and one ring stands for the length that is written above. An oval is a tilted or wobbling axis, a shifted circle a wrong centre, two circles play between both directions");
    OVER_TIME, phrase!("Deviation over time"), phrase!("The deviation in the order in which it was measured. A slope is a drift of the machine or the tripod; a step is the moment when one of them was touched");
    OVER_LOAD, phrase!("Deviation over load"), phrase!("The deviation over the weight that the arm carried. A slope is an arm or a joint that gives way; it needs poses measured with different loads");
    OVER_TEMPERATURE, phrase!("Deviation over temperature"), phrase!("The deviation over the temperature that was logged. A slope is a link that grows, or a joint whose zero moves, as the machine gets warm");
    ORDERS, phrase!("Order spectrum"), phrase!("How large the part of the deviation is that comes back once, twice, three times … with every turn of the joint. Once is an eccentric encoder or bearing, twice an oval one, and a gear shows at its number of teeth. Bars below the noise line mean nothing");
    HISTOGRAM, phrase!("histogram"), phrase!("How many samples deviate by how much. If only noise is left, the bars fill the dashed curve; two heaps are two states, as with backlash. A click on a bar marks its samples everywhere");
    EFFECT_CURVE, phrase!("Effect's own curve"), phrase!("What is left when the model knows everything but this one effect, and what the effect does according to its fitted size. Where the curve runs through the points the name is right");
    TOOL, phrase!("Tool pose"), phrase!("Position and orientation of the tool frame in the base frame when every joint is at zero");
    AXIS, phrase!("Axis"), phrase!("The line about which, or along which, a joint moves when every joint is at zero: a direction and any point on it, in the base frame");
}

/// What is said about this name of a number, where something is.
pub(crate) fn about(name: &str) -> Option<Word> {
    let same = |one: &str| one.len() == name.len() && capital(one) == capital(name);
    let is_named = |all: &[Template]| all.iter().any(|one| same(spoken(*one)));
    let found = NAMES.iter().find(|(keys, _)| is_named(keys));
    found.map(|(_, word)| *word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_is_explained_once_and_reads_like_the_rest_of_the_window() {
        for (k, word) in ALL.iter().enumerate() {
            assert!(
                ALL[..k].iter().all(|w| w.name() != word.name()),
                "{}",
                word.name()
            );
            assert!(word.means().len() > 40, "{}", word.name());
            assert!(!word.means().ends_with('.'), "{}", word.name());
        }
    }

    #[test]
    fn the_glossary_has_these_words() {
        let page = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/numbers.md");
        let page = std::fs::read_to_string(page).expect("the page");
        let (_, page) = page.split_once("\n## Glossary\n").expect("the glossary");
        for word in ALL {
            let row = format!("| {} | {} |\n", word.name(), word.means());
            assert!(page.contains(&row), "docs/numbers.md lacks: {row}");
        }
    }

    /// Names that stand before a number in a source file: `fact(say!(…), …)`.
    fn names_in(source: &str) -> Vec<&str> {
        let calls = source.split("fact(").skip(1);
        calls
            .filter_map(|rest| {
                let rest = rest.trim_start();
                let said = rest
                    .strip_prefix("say!(")
                    .or_else(|| rest.strip_prefix("phrase!("));
                let key = said.unwrap_or(rest).trim_start();
                key.strip_prefix('"')?.split('"').next()
            })
            .collect()
    }

    /// What these are their own words say.
    const PLAIN: [&str; 20] = [
        "file",
        "robot",
        "joint",
        "joints",
        "samples",
        "measured",
        "reflectors",
        "instrument",
        "coordinates",
        "compensated",
        "largest",
        "largest deviation",
        "entries",
        "identified from",
        "last saved",
        "kind",
        "reach, load",
        "repeatability (ISO 9283)",
        "geometry from",
        "read as",
    ];

    #[test]
    fn every_number_that_stands_in_a_panel_is_explained_or_plain() {
        let window = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/gui");
        let mut folders = vec![window.join("views"), window.join("dialogs")];
        let mut files = Vec::new();
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(folder).expect("the views") {
                let path = entry.expect("a view").path();
                if path.is_dir() {
                    folders.push(path);
                } else {
                    files.push(path);
                }
            }
        }
        let mut seen = 0;
        for path in files {
            let source = std::fs::read_to_string(&path).expect("its source");
            for name in names_in(&source) {
                seen += 1;
                let said = about(name).is_some() || PLAIN.contains(&name);
                assert!(said, "{name} in {}", path.display());
            }
        }
        assert!(seen > 20, "{seen}");
    }
}
