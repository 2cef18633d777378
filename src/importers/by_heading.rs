//! What was said about columns, by their headings.

/// What columns were said to be, by their headings.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ByHeading {
    /// Headings and meanings in the words of [`crate::importers::Reading::columns`]; headings are empty for a table
    /// without a header.
    pub columns: Vec<(String, String)>,
}

impl ByHeading {
    /// The words for a table's columns; empty where none of its headings is known.
    pub(crate) fn words_for(&self, headings: &[String]) -> Vec<String> {
        let is_named = self.columns.iter().any(|(heading, _)| !heading.is_empty());
        if headings.iter().all(String::is_empty) || !is_named {
            let without = headings.iter().all(String::is_empty) && !is_named;
            let words = self.columns.iter().map(|(_, word)| word.clone());
            return if without { words.collect() } else { Vec::new() };
        }
        let plain = |heading: &str| heading.trim().to_lowercase();
        let mut used = vec![false; self.columns.len()];
        let mut found = false;
        let mut word = |heading: &String| {
            let is = |(at, (own, _)): &(usize, &(String, String))| {
                !used[*at] && plain(own) == plain(heading)
            };
            let at = self.columns.iter().enumerate().find(is).map(|(at, _)| at);
            let Some(at) = at else {
                return "auto".to_owned();
            };
            used[at] = true;
            found = true;
            self.columns[at].1.clone()
        };
        let words: Vec<String> = headings.iter().map(&mut word).collect();
        if found { words } else { Vec::new() }
    }
}
