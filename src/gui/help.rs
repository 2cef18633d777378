//! What the words mean, in the technician's own: one table for the tips beside the numbers and for
//! the sheet that lists them all.

use crate::gui::language::text;

/// A word and what it means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Word {
    /// The keys of its texts.
    pub(crate) name: &'static str,
    pub(crate) means: &'static str,
}

impl Word {
    pub(crate) fn name(self) -> &'static str {
        text(self.name)
    }

    /// What it means, and what to do with it.
    pub(crate) fn means(self) -> &'static str {
        text(self.means)
    }
}

macro_rules! words {
    ($($id:ident, $key:literal;)*) => {
        $(pub(crate) const $id: Word = Word {
            name: concat!("word-", $key),
            means: concat!("word-", $key, "-means"),
        };)*
        /// All of them, in the order in which the work meets them.
        pub(crate) const ALL: &[Word] = &[$($id),*];
    };
}

words! {
    DEVIATION, "deviation";
    GAP, "gap";
    LARGEST, "largest";
    TOLERANCE, "tolerance";
    NOISE, "noise";
    FLOOR, "floor";
    INTERVAL, "interval";
    HELD_OUT, "held-out";
    P_FAMILY, "p-family";
    ODDS, "odds";
    SHARE, "share";
    UNEXPLAINED, "unexplained";
    LIMIT, "limit";
    REGION, "region";
    CORRECTION, "correction";
    EXACT, "exact";
    OUTLIER, "outlier";
    SLOW_NOISE, "slow-noise";
    NOT_IDENTIFIABLE, "not-identifiable";
    TARGETS, "targets";
    PREDICTED, "predicted";
    LANGUAGE, "language";
    REMAINDER, "remainder";
    UNCERTAINTY, "uncertainty";
    PLANAR, "planar";
    DIRECTION, "direction";
    POLAR, "polar";
    DRAWN_ROBOT, "drawn-robot";
    OVER_TIME, "over-time";
    OVER_LOAD, "over-load";
    OVER_TEMPERATURE, "over-temperature";
    ORDERS, "orders";
    HISTOGRAM, "histogram";
    EFFECT_CURVE, "effect-curve";
    SETUP, "setup";
    TOOL, "tool";
    ROBOT, "robot";
    SAMPLES, "samples";
    REFLECTORS, "reflectors";
    INSTRUMENT, "instrument";
    COMPENSATED, "compensated";
    RANGE, "range";
    HOLE, "hole";
    SPEED, "speed";
    LOAD, "load";
    TEMPERATURE, "temperature";
    TOOK, "took";
    SHOWS, "shows";
    WITHOUT, "without";
    MODELLED, "modelled";
    CORRECTED, "corrected";
    ENTRIES, "entries";
    SOURCE, "source";
    PLACE, "place";
    CURVE, "curve";
    AXIS, "axis";
}

/// Names of numbers, by key, and what explains them.
const NAMES: &[(&[&str], Word)] = &[
    (
        &[
            "common-rms-error",
            "diagnose-nominal-robot",
            "common-identified",
            "diagnose-with-found-effects",
            "unexplained-what-is-left",
        ],
        GAP,
    ),
    (
        &[
            "coverage-largest-deviation",
            "results-largest",
            "model-largest-then",
        ],
        LARGEST,
    ),
    (&["common-tolerance", "common-within-tolerance"], TOLERANCE),
    (
        &[
            "session-noise-one",
            "common-noise",
            "diagnosis-noise-stated",
            "diagnosis-noise-as-found",
        ],
        NOISE,
    ),
    (&["common-noise-floor"], FLOOR),
    (
        &[
            "common-held-out",
            "found-cross-validated-rms-error",
            "unexplained-cross-validated-rms-error-corrected",
        ],
        HELD_OUT,
    ),
    (&["compensation-read-as"], LANGUAGE),
    (&["compensation-targets-corrected"], TARGETS),
    (
        &[
            "compensation-rms-position-error",
            "compensation-largest-position-error",
        ],
        PREDICTED,
    ),
    (&["common-regions"], REGION),
    (&["session-coordinates"], PLANAR),
    (&["common-not-correctable-by-joint-commands"], REMAINDER),
    (&["common-robot", "common-joint", "common-joints"], ROBOT),
    (&["common-samples"], SAMPLES),
    (&["coverage-came-from"], DIRECTION),
    (&["coverage-speed"], SPEED),
    (&["common-load"], LOAD),
    (&["common-temperature"], TEMPERATURE),
    (&["session-reflectors"], REFLECTORS),
    (&["common-instrument-2"], INSTRUMENT),
    (&["session-compensated"], COMPENSATED),
    (&["coverage-measured-range", "common-measured"], RANGE),
    (&["coverage-widest-hole"], HOLE),
    (&["coverage-took"], TOOK),
    (&["common-testable-effects"], SHOWS),
    (&["export-without-it"], WITHOUT),
    (
        &["export-model-and-measurement", "model-measured-and-model"],
        MODELLED,
    ),
    (&["model-with-corrected-commands"], CORRECTED),
    (&["export-entries"], ENTRIES),
    (&["model-file", "model-identified"], SOURCE),
    (&["unexplained-where"], PLACE),
    (
        &[
            "unexplained-largest-along-the-motion",
            "unexplained-largest-along-the-radius",
            "unexplained-largest-along-the-axis",
        ],
        CURVE,
    ),
];

/// What is said about this name of a number, where something is.
pub(crate) fn about(name: &str) -> Option<Word> {
    let is_named = |keys: &[&'static str]| keys.iter().any(|key| text(key) == name);
    let found = NAMES.iter().find(|(keys, _)| is_named(keys));
    found.map(|(_, word)| *word)
}

/// What a figure of the standards says, by its symbol there.
pub(crate) fn figure(symbol: &str) -> Option<&'static str> {
    let means = match symbol {
        "A" => say!("figure-a"),
        "A↑" | "A↓" => say!("figure-a-one-way"),
        "E" => say!("figure-e"),
        "E↑" | "E↓" | "R↑" | "R↓" => say!("figure-e-one-way"),
        "M" => say!("figure-m"),
        "R" => say!("figure-r"),
        "B" => say!("figure-b"),
        "B mean" => say!("figure-b-mean"),
        "AP" => say!("figure-ap"),
        "RP" => say!("figure-rp"),
        "vAP" => say!("figure-vap"),
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
                ALL[..k].iter().all(|w| w.name() != word.name()),
                "{}",
                word.name()
            );
            assert!(word.means().len() > 40, "{}", word.name());
            assert!(!word.means().ends_with('.'), "{}", word.name());
        }
    }

    /// Keys of names that stand before a number in a source file: `fact(ui, say!(…), …)` and
    /// `fact_of(ui, …)`.
    fn names_in(source: &str) -> Vec<&str> {
        let calls = source.split("fact(").skip(1);
        let calls = calls.chain(source.split("fact_of(").skip(1));
        calls
            .filter_map(|rest| {
                let rest = rest.trim_start().strip_prefix("ui,")?.trim_start();
                let key = rest.strip_prefix("say!(").unwrap_or(rest).trim_start();
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
                if ["recovery-its-file", "recovery-kept"].contains(&name) {
                    continue;
                }
                seen += 1;
                let explained = NAMES.iter().any(|(keys, _)| keys.contains(&name));
                assert!(explained, "{name} in {}", path.display());
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
