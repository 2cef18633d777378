//! A value that is being read: where it stands, and what should stand there.

use super::number::quoted;
use super::{Fields, Node, Path, Value};
use crate::text::Text;

pub struct Cursor<'o, 'a> {
    pub fields: &'o mut Fields<'a>,
    pub node: &'o Node,
    pub path: &'o Path<'o>,
    pub expected: Text,
}

impl<'o> Cursor<'o, '_> {
    /// Complains that something else stands here.
    pub fn wrong<T>(&mut self) -> Option<T> {
        self.fields
            .mismatch(self.node, self.path, self.expected.clone());
        None
    }

    /// Complains of what stands here.
    pub fn error<T>(&mut self, found: impl Into<Text>, expected: impl Into<Text>) -> Option<T> {
        self.fields.error(self.node.at, self.path, found, expected);
        None
    }

    /// A finite number for which this holds.
    pub fn number(&mut self, holds: impl Fn(f64) -> bool) -> Option<f64> {
        match self.node.value {
            Value::Number(value) if value.is_finite() && holds(value) => Some(value),
            _ => self.wrong(),
        }
    }

    /// `N` finite numbers.
    pub fn numbers<const N: usize>(&mut self) -> Option<[f64; N]> {
        self.fields
            .numbers(self.node, self.path, self.expected.clone())
    }

    /// The one of these that has the name that stands here.
    pub fn one_of<T: Copy>(&mut self, all: &[T], name: fn(T) -> &'static str) -> Option<T> {
        let Value::Text(text) = &self.node.value else {
            return self.wrong();
        };
        let found = all.iter().find(|one| name(**one) == text);
        found.copied().or_else(|| self.wrong())
    }

    /// The elements of an array.
    pub(crate) fn elements(&mut self) -> Option<&'o [Node]> {
        match &self.node.value {
            Value::List(list) => Some(list),
            _ => self.wrong(),
        }
    }

    /// Reads an array with one element for each of these into them; `None` when one is wrong.
    pub fn each<T>(
        &mut self,
        mut all: Vec<T>,
        expected: impl Into<Text>,
        take: impl Fn(&mut T, &mut Cursor<'_, '_>) -> bool,
    ) -> Option<Vec<T>> {
        let list = match &self.node.value {
            Value::List(list) if list.len() == all.len() => list,
            _ => return self.wrong(),
        };
        let mut good = true;
        let expected = expected.into();
        for (index, (one, node)) in all.iter_mut().zip(list).enumerate() {
            let mut at = Cursor {
                fields: self.fields,
                node,
                path: &self.path.index(index),
                expected: expected.clone(),
            };
            good &= take(one, &mut at);
        }
        good.then_some(all)
    }

    /// As [`Cursor::list`], of elements that are read like this.
    pub fn list_by<T>(
        &mut self,
        read: impl Fn(&mut Cursor<'_, '_>) -> Option<T>,
    ) -> Option<Vec<T>> {
        let elements = self.elements()?.iter().enumerate();
        let all = elements.map(|(index, node)| {
            read(&mut Cursor {
                fields: self.fields,
                node,
                path: &self.path.index(index),
                expected: phrase!("").into(),
            })
        });
        let all: Vec<Option<T>> = all.collect();
        all.into_iter().collect()
    }

    /// One value for each key of an object, which is its name. What is wrong in one of them was
    /// reported; it stays, so that what refers to it is not wrong besides.
    pub(crate) fn named<T>(
        &mut self,
        read: impl Fn(&str, &mut Cursor<'_, '_>) -> T,
    ) -> Option<Vec<T>> {
        let entries = self
            .fields
            .object(self.node, self.path, self.expected.clone())?;
        let mut all = Vec::new();
        for entry in entries {
            let path = &self.path.key(&entry.key);
            if entry.key.trim() != entry.key || entry.key.is_empty() {
                let expected = text!("a name without spaces around it");
                self.fields.error(
                    entry.key_at,
                    path,
                    Text::verbatim(quoted(&entry.key)),
                    expected,
                );
            }
            let mut at = Cursor {
                fields: self.fields,
                node: &entry.node,
                path,
                expected: phrase!("").into(),
            };
            all.push(read(&entry.key, &mut at));
        }
        Some(all)
    }
}
