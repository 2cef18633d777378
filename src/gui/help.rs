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
    LARGEST, phrase!("largest deviation"), phrase!("The one sample that is furthest off, suspected outliers included"),
        [phrase!("largest")];
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
    SHARE, phrase!("Share"), phrase!("Which part of what the identification left over this name explains"),
        [phrase!("Share of what was explained")];
    UNEXPLAINED, phrase!("unexplained"), phrase!("Something regular is left that no name of the list fits. It is shown where it is, so that you can look there");
    LIMIT, phrase!("Detection limit"), phrase!("The smallest size of an effect that these samples would have shown. What was not found is smaller than this, not necessarily nothing");
    REGION, phrase!("region"), phrase!("A range of the joint that gets a constant correction of its own, as older controllers want it"),
        [phrase!("regions")];
    CORRECTION, phrase!("Correction"), phrase!("What to add to the command or the position: the deviation with the opposite sign");
    EXACT, phrase!("full model"), phrase!("One model for the whole range: all parameters at once, in the frame of the instrument");
    OUTLIER, phrase!("Suspected outlier"), phrase!("A sample so far from the model that it is at least four times likelier to be a mistake of the measurement than noise. It is excluded from the fit, stays on the screen, and is worth measuring again");
    SLOW_NOISE, phrase!("Slow noise"), phrase!("A part of the error that wanders in time, whatever the robot does: a tripod that settles, air, a tracker that warms up. The intervals allow for it, and no effect of the robot is read into it");
    NOT_IDENTIFIABLE, phrase!("Not identifiable"), phrase!("Two causes that do the same to every sample measured so far. Poses that differ more, a second reflector, or both directions usually tell them apart");
    TARGETS, phrase!("Compensated targets"), phrase!("Targets of a table or a program whose numbers were changed, so that the real tool goes where the nominal robot would. One that is singular, beyond the limits, ambiguous or unseen is named and left"),
        [phrase!("targets corrected")];
    PREDICTED, phrase!("Position error, as the model predicts it"), phrase!("How far the real tool, as the model knows it, is from the targets of the file: with their numbers as they are, and with the corrected ones"),
        [phrase!("RMS position error"), phrase!("largest position error")];
    LANGUAGE, phrase!("read as"), phrase!("The language of the file, by its ending, else by what it looks like");
    REMAINDER, phrase!("not correctable by joint commands"), phrase!("RMS error that remains when the controller applies the whole table: directions in which moving this joint moves nothing");
    PLANAR, phrase!("Planar session"), phrase!("Only x and y were measured; nothing can be said about what happens along z"),
        [phrase!("coordinates")];
    DIRECTION, phrase!("direction"), phrase!("The side from which the joint came to the pose. Approaching from both sides is what makes backlash visible");
    POLAR, phrase!("Polar view"), phrase!("A component of the deviation around the angle of the joint, as circles of a ballbar test are shown (ISO 230-4): on the nominal circle there is none, and one ring stands for the length that is written above. An oval is a tilted or wobbling axis, a shifted circle a wrong centre, two circles play between both directions");
    OVER_TIME, phrase!("Deviation over time"), phrase!("The deviation in the order in which it was measured. A slope is a drift of the machine or the tripod; a step is the moment when one of them was touched");
    OVER_LOAD, phrase!("Deviation over load"), phrase!("The deviation over the weight that the arm carried. A slope is an arm or a joint that gives way; it needs poses measured with different loads");
    OVER_TEMPERATURE, phrase!("Deviation over temperature"), phrase!("The deviation over the temperature that was logged. A slope is a link that grows, or a joint whose zero moves, as the machine gets warm");
    ORDERS, phrase!("Order spectrum"), phrase!("How large the part of the deviation is that comes back once, twice, three times … with every turn of the joint. Once is an eccentric encoder or bearing, twice an oval one, and a gear shows at its number of teeth. Bars below the noise line mean nothing");
    HISTOGRAM, phrase!("histogram"), phrase!("How many samples deviate by how much. If only noise is left, the bars fill the dashed curve; two heaps are two states, as with backlash. A click on a bar marks its samples everywhere");
    EFFECT_CURVE, phrase!("Effect's own curve"), phrase!("What is left when the model knows everything but this one effect, and what the effect does according to its fitted size. Where the curve runs through the points the name is right");
    SETUP, phrase!("Setup"), phrase!("One position of the instrument. Each has a measuring frame of its own, which is fitted");
    TOOL, phrase!("Tool pose"), phrase!("Position and orientation of the tool frame in the base frame when every joint is at zero");
    ROBOT, phrase!("robot"), phrase!("The description that the session was measured on: axes, reflectors and links of the nominal model. Everything is measured against it"),
        [phrase!("joint"), phrase!("joints")];
    SAMPLES, phrase!("samples"), phrase!("Poses that were measured. More of them, and poses that differ more, make every number surer");
    REFLECTORS, phrase!("reflectors"), phrase!("Points on the tool that the instrument sees. A second one at another radius tells causes apart that one alone cannot");
    INSTRUMENT, phrase!("instrument"), phrase!("What the positions were measured with. Its noise is the smallest RMS error that any model can reach");
    COMPENSATED, phrase!("compensated"), phrase!("The commands were already corrected by a table while this was measured: what is seen here is what that table left");
    RANGE, phrase!("Measured range"), phrase!("The smallest and the largest position of the joint that was measured. Outside it nothing is known, and a table holds its end values there"),
        [phrase!("measured")];
    SHOWS, phrase!("testable effects"), phrase!("How many of the physical causes that this program knows would leave a trace in these samples. What cannot be tested can be there all the same");
    WITHOUT, phrase!("Without it"), phrase!("RMS error of the nominal robot: what remains if nothing is corrected"),
        [phrase!(in "export", "without it")];
    MODELLED, phrase!("model and measurement"), phrase!("RMS error between the measurement and the identified model: what a perfect controller could reach if every direction could be corrected");
    CORRECTED, phrase!("with corrected commands"), phrase!("RMS error that remains on this session when the commands are corrected by the model");
    ENTRIES, phrase!("entries"), phrase!("Lines of the table. More of them follow the curve more closely; a controller may allow only so many");
    SOURCE, phrase!("Where it comes from"), phrase!("The file, and the session that the model was identified from. A model is worth what its session covers"),
        [phrase!("file"), phrase!("identified from")];
    PLACE, phrase!("Where"), phrase!("The part of the range, or the number of cycles per turn, at which what is left stands out: look at the machine there");
    AXIS, phrase!("Axis"), phrase!("The line about which, or along which, a joint moves when every joint is at zero: a direction and any point on it, in the base frame");
    LIBRARY, phrase!("Robot of the library"), phrase!("A maker's robot with its nominal geometry: its kind by its axes, reach and load by its data sheet, repeatability as ISO 9283 defines it, and where its link lengths were read. A real one differs by what a calibration finds"),
        [phrase!("kind"), phrase!("reach, load"), phrase!("repeatability (ISO 9283)"), phrase!("geometry from")];
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
        // A heading, its line, and a row each.
        assert_eq!(page.matches("\n| ").count(), ALL.len() + 2);
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

    #[test]
    fn every_number_that_stands_in_a_panel_is_explained() {
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
                // Names of files are what they are.
                if ["file", "last saved"].contains(&name) {
                    continue;
                }
                seen += 1;
                assert!(about(name).is_some(), "{name} in {}", path.display());
            }
        }
        assert!(seen > 25, "{seen}");
    }
}
