//! What the words mean, in the technician's own: one table for the tips beside the numbers and for
//! the sheet that lists them all.

/// A word and what it means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Word {
    pub(crate) name: &'static str,
    /// What it means, and what to do with it.
    pub(crate) means: &'static str,
}

macro_rules! words {
    ($($id:ident, $name:literal, $means:literal;)*) => {
        $(pub(crate) const $id: Word = Word { name: $name, means: $means };)*
        /// All of them, in the order in which the work meets them.
        pub(crate) const ALL: &[Word] = &[$($id),*];
    };
}

words! {
    DEVIATION, "Deviation",
        "Where the reflector was measured, minus where the simulation says it should be";
    GAP, "RMS error",
        "Root mean square of the length of the deviation over all samples. Suspected outliers do not count in it, but they do in the largest deviation";
    LARGEST, "Largest deviation",
        "The one sample that is furthest off, suspected outliers included";
    TOLERANCE, "Tolerance",
        "How far a measured position may be off. Samples within it are marked with a disc, those outside with a diamond";
    NOISE, "Noise, one σ",
        "How much the instrument's own reading scatters along one axis, as its maker or a repeatability check says. Two of three readings are nearer than this. Without it, it is estimated from the samples";
    FLOOR, "Noise floor",
        "The RMS error of a perfect model: the scatter of repeated poses, or of the instrument. No model can come below it, and one that comes close has nothing left to explain";
    INTERVAL, "Interval, ±",
        "The true value lies within it in 19 of 20 calibrations like this one. It shrinks with more samples and with poses that differ more";
    HELD_OUT, "Held out",
        "Samples that no fit has seen. The model has to predict them: an RMS error that falls there too is proof, one that falls only on the others is chance";
    P_FAMILY, "By chance",
        "How often noise alone would make some name of the whole list look at least this good. 1 of 2000 is hard evidence, 1 of 20 is not";
    ODDS, "Odds over the next candidate",
        "How many times more likely this name is than the next best one, given the samples. Below about 20 : 1 both stay possible, and the poses that would decide are listed";
    SHARE, "Share",
        "Which part of what the identification left over this name explains";
    UNEXPLAINED, "Unexplained",
        "Something regular is left that no name of the list fits. It is shown where it is, so that somebody can look there";
    LIMIT, "Detection limit",
        "The smallest size of an effect that these samples would have shown. What was not found is smaller than this, not necessarily nothing";
    REGION, "Region",
        "A range of the joint that gets a constant correction of its own, as older controllers want it";
    CORRECTION, "Correction",
        "What to add to the command or the position: the deviation with the opposite sign";
    EXACT, "Exact fit",
        "One model for the whole range: all parameters at once, in the frame of the instrument";
    OUTLIER, "Suspected outlier",
        "A sample so far from the model that it is at least four times likelier to be a mistake of the measurement than noise. It is excluded from the fit, stays on the screen, and is worth measuring again";
    SLOW_NOISE, "Slow noise",
        "A part of the error that wanders in time, whatever the robot does: a tripod that settles, air, a tracker that warms up. The intervals allow for it, and no effect of the robot is read into it";
    NOT_IDENTIFIABLE, "Not identifiable",
        "Two causes that do the same to every sample measured so far. Poses that differ more, a second reflector, or both directions usually tell them apart";
    TARGETS, "Compensated targets",
        "Targets of a table or a program whose numbers were changed, so that the real tool goes where the nominal robot would. A target that is singular, beyond the limits or ambiguous is named and left as it is";
    PREDICTED, "Position error, as the model predicts it",
        "How far the real tool, as the model knows it, is from the targets of the file: with their numbers as they are, and with the corrected ones";
    LANGUAGE, "Read as",
        "The language of the file, by its ending, else by what it looks like";
    REMAINDER, "Not correctable by joint commands",
        "RMS error that remains when the controller applies the whole table: directions in which moving this joint moves nothing";
    PLANAR, "Planar session",
        "Only x and y were measured; nothing can be said about what happens along z";
    DIRECTION, "Direction",
        "The side from which the joint came to the pose. Approaching from both sides is what makes backlash visible";
    POLAR, "Polar view",
        "A component of the deviation around the angle of the joint, as circles of a ballbar test are shown (ISO 230-4): on the nominal circle there is none, and one ring stands for the length that is written above. An oval is a tilted or wobbling axis, a shifted circle a wrong centre, two circles play between both directions";
    DRAWN_ROBOT, "The robot in the workspace",
        "The nominal robot in outline at the sample that is chosen or under the pointer, and beside it as a line the real one, as it was measured or identified, displaced as many times as is written beside it. Without a choice it stands faintly at a sample in the middle";
    OVER_TIME, "Deviation over time",
        "The deviation in the order in which it was measured. A slope is a drift of the machine or the tripod; a step is the moment when somebody touched one of them";
    OVER_LOAD, "Deviation over load",
        "The deviation over the weight that the arm carried. A slope is an arm or a joint that gives way; it needs poses measured with different loads";
    OVER_TEMPERATURE, "Deviation over temperature",
        "The deviation over the temperature that was logged. A slope is a link that grows, or a joint whose zero moves, as the machine gets warm";
    ORDERS, "Order spectrum",
        "How large the part of the deviation is that comes back once, twice, three times … with every turn of the joint. Once is an eccentric encoder or bearing, twice an oval one, and a gear shows at its number of teeth. Bars below the noise line mean nothing";
    HISTOGRAM, "Histogram",
        "How many samples deviate by how much. If only noise is left, the bars fill the dashed curve; two heaps are two states, as with backlash. A click on a bar marks its samples everywhere";
    EFFECT_CURVE, "Effect's own curve",
        "What is left when the model knows everything but this one effect, and what the effect does according to its fitted size. Where the curve runs through the points the name is right";
    SETUP, "Setup",
        "One position of the instrument. Each has a measuring frame of its own, which is fitted";
    TOOL, "Tool pose",
        "Position and orientation of the tool frame in the base frame when every joint is at zero";
    ROBOT, "Robot",
        "The description that the session was measured on: axes, reflectors and links as the drawing has them. Everything is measured against it";
    SAMPLES, "Samples",
        "Poses that were measured. More of them, and poses that differ more, make every number surer";
    REFLECTORS, "Reflectors",
        "Points on the tool that the instrument sees. A second one at another radius tells causes apart that one alone cannot";
    INSTRUMENT, "Instrument",
        "What the positions were measured with. Its noise is the smallest RMS error that any model can reach";
    COMPENSATED, "Compensated",
        "The commands were already corrected by a table while this was measured: what is seen here is what that table left";
    RANGE, "Measured range",
        "The smallest and the largest position of the joint that was measured. Outside it nothing is known, and a table holds its end values there";
    HOLE, "Widest hole",
        "A part of the range, much wider than the other steps, in which there is no sample. Whatever happens there stays unseen: measure a few poses in it";
    SPEED, "Speed",
        "How fast the joint moved while it was measured. Lag behind the command shows only at different speeds";
    LOAD, "Load",
        "The mass at the tool while it was measured. Bending of links and joints shows only at different loads";
    TEMPERATURE, "Temperature",
        "Of the robot while it was measured. Growth with warmth shows only where it changes by some degrees";
    TOOK, "Time it took",
        "From the first sample to the last. What drifts, or was knocked, shows only where samples have a time";
    SHOWS, "Testable effects",
        "How many of the physical causes that this program knows would leave a trace in these samples. What cannot be tested can be there all the same";
    WITHOUT, "Without it",
        "RMS error of the nominal robot: what remains if nothing is corrected";
    MODELLED, "Model and measurement",
        "RMS error between the measurement and the identified model: what a perfect controller could reach if every direction could be corrected";
    CORRECTED, "With corrected commands",
        "RMS error that remains on this session when the commands are corrected by the model";
    ENTRIES, "Entries",
        "Lines of the table. More of them follow the curve more closely; a controller may allow only so many";
    SOURCE, "Where it comes from",
        "The file, and the session that the model was identified from. A model is worth what its session covers";
    PLACE, "Where",
        "The part of the range, or the number of cycles per turn, at which what is left stands out: look at the machine there";
    CURVE, "Largest of the curve",
        "The most that the smooth correction moves the point, in this direction";
    AXIS, "Axis",
        "The line about which, or along which, a joint moves when every joint is at zero: a direction and any point on it, in the base frame";
}

/// What is said about this name of a number, where something is.
pub(crate) fn about(name: &str) -> Option<Word> {
    let word = match name {
        "RMS error" | "nominal robot" | "identified" | "with found effects" | "what is left" => GAP,
        "largest deviation" | "largest" | "largest then" => LARGEST,
        "tolerance" | "within tolerance" => TOLERANCE,
        "noise, one σ" | "noise" | "noise σ, stated" | "noise σ, as found" => NOISE,
        "noise floor" => FLOOR,
        "held out" | "cross-validated RMS error" | "cross-validated RMS error, corrected" => {
            HELD_OUT
        }
        "read as" => LANGUAGE,
        "targets corrected" => TARGETS,
        "RMS position error" | "largest position error" => PREDICTED,
        "regions" => REGION,
        "coordinates" => PLANAR,
        "not correctable by joint commands" => REMAINDER,
        "robot" | "joint" | "joints" => ROBOT,
        "samples" => SAMPLES,
        "reflectors" => REFLECTORS,
        "instrument" => INSTRUMENT,
        "compensated" => COMPENSATED,
        "measured range" | "measured" => RANGE,
        "widest hole" => HOLE,
        "came from" => DIRECTION,
        "speed" => SPEED,
        "load" => LOAD,
        "temperature" => TEMPERATURE,
        "took" => TOOK,
        "testable effects" => SHOWS,
        "without it" => WITHOUT,
        "model and measurement" | "measured and model" => MODELLED,
        "with corrected commands" => CORRECTED,
        "entries" => ENTRIES,
        "file" | "identified from" => SOURCE,
        "where" => PLACE,
        "largest along the motion" | "largest along the radius" | "largest along the axis" => CURVE,
        _ => return None,
    };
    Some(word)
}

/// What a figure of the standards says, by its symbol there.
pub(crate) fn figure(symbol: &str) -> Option<&'static str> {
    let means = match symbol {
        "A" => {
            "Accuracy: from the lowest to the highest deviation anywhere on the axis, with twice the scatter on both sides"
        }
        "A↑" | "A↓" => {
            "The same for one direction of approach only: what is left where a program always comes from one side"
        }
        "E" => {
            "Systematic deviation: from the lowest to the highest mean deviation, without the scatter. This is what a table can remove"
        }
        "E↑" | "E↓" | "R↑" | "R↓" => "The same for one direction of approach only",
        "M" => {
            "From the lowest to the highest mean of both directions: the shape of the error along the axis"
        }
        "R" => {
            "Repeatability: how far returns to one position scatter at worst, both directions together. No table can remove it"
        }
        "B" => {
            "Reversal: how far the two directions of approach differ at worst. Backlash and lost motion show here"
        }
        "B mean" => "The same on average along the axis",
        "AP" => "Pose accuracy: from the commanded point to the middle of the measured ones",
        "RP" => {
            "Pose repeatability: the radius of the sphere that holds the returns to one pose, mean plus three standard deviations"
        }
        "vAP" => "How far the middles differ when one pose is approached from different sides",
        _ => return None,
    };
    Some(means)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_is_explained_once_and_reads_like_the_rest_of_the_window() {
        for (k, word) in ALL.iter().enumerate() {
            assert!(
                ALL[..k].iter().all(|w| w.name != word.name),
                "{}",
                word.name
            );
            assert!(word.means.len() > 40, "{}", word.name);
            assert!(!word.means.ends_with('.'), "{}", word.name);
        }
    }

    /// Names that stand before a number in a source file: `fact(ui, "name", …)`.
    fn names_in(source: &str) -> Vec<&str> {
        let calls = source.split("fact(").skip(1);
        calls
            .filter_map(|rest| {
                let rest = rest.trim_start().strip_prefix("ui,")?.trim_start();
                rest.strip_prefix('"')?.split('"').next()
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
                if ["its file", "kept"].contains(&name) {
                    continue;
                }
                seen += 1;
                assert!(about(name).is_some(), "{name} in {}", path.display());
            }
        }
        assert!(seen > 40, "{seen}");
    }

    #[test]
    fn every_figure_of_the_standards_is_explained() {
        for symbol in [
            "A", "A↑", "A↓", "E", "E↑", "E↓", "M", "R", "R↑", "R↓", "B", "B mean", "AP", "RP",
            "vAP",
        ] {
            assert!(figure(symbol).is_some(), "{symbol}");
        }
    }
}
