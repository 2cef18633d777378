//! Default classes: attributes of elements that do not state them.
//!
//! Classes are nested; a class has its own attributes, then those of the class around it. The outermost, `main`,
//! applies to elements of no class.

use std::collections::BTreeMap;

use crate::diagnostic::Rejected;
use crate::kinematics::xml::MOST_FILES;

use super::super::xml::Document;

/// Refuses what would make every element cost as much as all classes together.
fn within_budget(document: &Document, element: usize, levels: usize) -> Result<(), Rejected> {
    if levels <= MOST_FILES {
        return Ok(());
    }
    let found = text!(
        "more than {most} levels of default classes",
        most = MOST_FILES
    );
    let expected = text!("at most {most}", most = MOST_FILES);
    Err(document.refuse(element, found, expected))
}

#[derive(Debug, Default)]
pub(super) struct Defaults {
    /// For each class the elements that describe it, the innermost first.
    classes: BTreeMap<String, Vec<usize>>,
    /// For each kind of element those of a class: `(the default element, its place)`.
    kinds: BTreeMap<String, BTreeMap<usize, Vec<usize>>>,
    main: Vec<usize>,
}

impl Defaults {
    /// All of a document.
    ///
    /// # Errors
    /// A class inside another one without a name, or a name twice.
    pub(super) fn read(document: &Document, root: usize) -> Result<Self, Rejected> {
        let mut all = Self::default();
        // Elements with the classes around them.
        let mut open: Vec<(usize, Vec<usize>)> = Vec::new();
        for top in document.children(root, "default") {
            // A second outermost element goes on with the first.
            all.main.insert(0, top);
            all.index(document, top)?;
            within_budget(document, top, all.main.len())?;
            let name = document.attribute(top, "class").unwrap_or("main");
            let main = all.main.clone();
            all.classes.insert(name.to_owned(), main.clone());
            open.extend(document.children(top, "default").map(|e| (e, main.clone())));
        }
        while let Some((element, around)) = open.pop() {
            let name = document.required(element, "class")?;
            let mut own = vec![element];
            own.extend(&around);
            within_budget(document, element, own.len())?;
            all.index(document, element)?;
            if all.classes.insert(name.to_owned(), own.clone()).is_some() {
                let found = text!("two default classes called '{name}'", name);
                return Err(document.refuse(element, found, text!("a unique name for each class")));
            }
            open.extend(
                document
                    .children(element, "default")
                    .map(|e| (e, own.clone())),
            );
        }
        Ok(all)
    }

    fn index(&mut self, document: &Document, class: usize) -> Result<(), Rejected> {
        for &child in document.inside(class) {
            let kind = document.name(child).to_owned();
            let of_kind = self.kinds.entry(kind).or_default();
            // A later statement replaces an earlier one.
            let own = of_kind.entry(class).or_default();
            own.insert(0, child);
            within_budget(document, child, own.len())?;
        }
        Ok(())
    }

    /// Elements of this kind in a class, the innermost first; `None` where there is no such class.
    pub(super) fn of(&self, kind: &str, class: &str) -> Option<Vec<usize>> {
        match self.classes.get(class) {
            Some(levels) => Some(self.elements(kind, levels)),
            None if class == "main" => Some(Vec::new()),
            None => None,
        }
    }

    /// Elements of this kind for what has no class.
    pub(super) fn main(&self, kind: &str) -> Vec<usize> {
        self.elements(kind, &self.main)
    }

    fn elements(&self, kind: &str, levels: &[usize]) -> Vec<usize> {
        let Some(of_kind) = self.kinds.get(kind) else {
            return Vec::new();
        };
        let found = levels.iter().filter_map(|level| of_kind.get(level));
        found.flatten().copied().collect()
    }
}
