//! The English of a sentence, with its arguments in braces by name.

use std::fmt;

/// The English of a sentence: what the catalogues know it by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Template {
    context: &'static str,
    english: &'static str,
    many: &'static str,
}

impl Template {
    /// Of a context (empty where the English alone has one meaning), of the English, and of its form for several
    /// where something is counted. The macros of [`crate::text`] call it.
    #[doc(hidden)]
    pub const fn new(context: &'static str, english: &'static str, many: &'static str) -> Self {
        Self {
            context,
            english,
            many,
        }
    }

    /// What the catalogues know it by: context and English.
    #[doc(hidden)]
    pub fn key(self) -> (&'static str, &'static str) {
        (self.context, self.english)
    }

    /// The English.
    pub fn english(self) -> &'static str {
        self.english
    }

    /// The English of one, or of several where it has a form for them.
    pub(super) fn english_for(self, one: bool) -> &'static str {
        if one || self.many.is_empty() {
            self.english
        } else {
            self.many
        }
    }

    /// Whether its arguments have these names, all of them and no others. Forms of a count have the same.
    #[doc(hidden)]
    pub const fn takes(self, names: &[&str]) -> bool {
        fits(self.english, names) && (self.many.is_empty() || fits(self.many, names))
    }
}

impl fmt::Display for Template {
    /// The English.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.english)
    }
}

impl serde::Serialize for Template {
    /// Documents are English.
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.english)
    }
}

/// Whether the names in braces are these: every one in the text is listed, and every one listed is in the text.
const fn fits(text: &str, names: &[&str]) -> bool {
    let bytes = text.as_bytes();
    let mut used = [false; 16];
    let mut at = 0;
    while at < bytes.len() {
        if bytes[at] != b'{' {
            at += 1;
            continue;
        }
        let start = at + 1;
        let mut end = start;
        while end < bytes.len() && bytes[end] != b'}' {
            end += 1;
        }
        let mut found = false;
        let mut k = 0;
        while k < names.len() {
            if same(bytes, start, end, names[k].as_bytes()) {
                (used[k], found) = (true, true);
            }
            k += 1;
        }
        if !found {
            return false;
        }
        at = end + 1;
    }
    let mut k = 0;
    while k < names.len() {
        if !used[k] {
            return false;
        }
        k += 1;
    }
    true
}

const fn same(text: &[u8], start: usize, end: usize, name: &[u8]) -> bool {
    if end - start != name.len() {
        return false;
    }
    let mut k = 0;
    while k < name.len() {
        if text[start + k] != name[k] {
            return false;
        }
        k += 1;
    }
    true
}

/// The parts inside and outside of braces, in order: text as `Ok`, the name of an argument as `Err`.
#[doc(hidden)]
pub fn parts(text: &str) -> impl Iterator<Item = Result<&str, &str>> {
    let mut rest = text;
    std::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        let (part, left) = match (rest.strip_prefix('{'), rest.find('{')) {
            (Some(inner), _) => {
                let (name, left) = inner.split_once('}').unwrap_or((inner, ""));
                (Err(name), left)
            }
            (None, Some(brace)) => (Ok(&rest[..brace]), &rest[brace..]),
            (None, None) => (Ok(rest), ""),
        };
        rest = left;
        Some(part)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_are_those_in_braces() {
        let template = Template::new("", "{a} of {b}", "");
        assert!(template.takes(&["a", "b"]) && template.takes(&["b", "a"]));
        assert!(!template.takes(&["a"]) && !template.takes(&["a", "b", "c"]));
        assert!(!Template::new("", "{a}", "none").takes(&["a"]));
        let found: Vec<_> = parts("{a} of {b}, at most").collect();
        assert_eq!(found, [Err("a"), Ok(" of "), Err("b"), Ok(", at most")]);
    }
}
