//! A value that is being read: where it stands, and what should stand there.

use super::fields::{member, optional};
use super::number::quoted;
use super::{Fields, Member, Node, Path, Value};
use crate::text::Text;

pub struct Cursor<'o, 'a> {
    pub fields: &'o mut Fields<'a>,
    pub node: &'o Node,
    pub path: &'o Path<'o>,
    pub expected: Text,
}

impl<'a> Fields<'a> {
    /// A document of this format that is about to be read; `None` when it is of another one.
    pub fn of_format<'o>(
        &'o mut self,
        root: &'o Node,
        format: &str,
        expected: impl Into<Text>,
    ) -> Option<Cursor<'o, 'a>> {
        let mut at = self.at(root, &Path::Root, expected);
        let members = at.members()?;
        let tag = Text::verbatim(format!("\"{format}\""));
        let name = format.trim_end_matches(char::is_numeric);
        at.under(members, "format", &tag, |at| match &at.node.value {
            Value::Text(own) if own == format => Some(()),
            Value::Text(own) if own.starts_with(name) => {
                at.expected = text!(
                    "{expected}; another version of truepose may have written this file",
                    expected = &tag
                );
                at.wrong()
            }
            _ => at.wrong(),
        })?;
        Some(at)
    }

    /// A value that is about to be read.
    pub fn at<'o>(
        &'o mut self,
        node: &'o Node,
        path: &'o Path<'o>,
        expected: impl Into<Text>,
    ) -> Cursor<'o, 'a> {
        let expected = expected.into();
        Cursor {
            fields: self,
            node,
            path,
            expected,
        }
    }
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
        let numbers = self.column().and_then(|all| <[f64; N]>::try_from(all).ok());
        let finite = numbers.filter(|all| all.iter().all(|value| value.is_finite()));
        finite.or_else(|| self.wrong())
    }

    /// The numbers of an array; null is NaN.
    pub fn column(&self) -> Option<&'o [f64]> {
        match &self.node.value {
            Value::Numbers(values) => Some(values),
            Value::List(list) if list.is_empty() => Some(&[]),
            _ => None,
        }
    }

    /// Reads what has to be there under a key of an object with these members.
    pub fn under<T>(
        &mut self,
        members: &[Member],
        key: &str,
        expected: impl Into<Text>,
        read: impl FnOnce(&mut Cursor<'_, '_>) -> Option<T>,
    ) -> Option<T> {
        let expected = expected.into();
        let node = self.required(members, key, &expected)?;
        read(&mut self.fields.at(node, &self.path.key(key), expected))
    }

    /// As [`Cursor::under`], where anything is there.
    pub fn under_if<T>(
        &mut self,
        members: &[Member],
        key: &str,
        expected: impl Into<Text>,
        read: impl FnOnce(&mut Cursor<'_, '_>) -> Option<T>,
    ) -> Option<Option<T>> {
        if optional(members, key).is_none() {
            return Some(None);
        }
        self.under(members, key, expected, read).map(Some)
    }

    /// What has to be there under a key of an object with these members.
    pub(super) fn required<'n>(
        &mut self,
        members: &'n [Member],
        key: &str,
        expected: impl Into<Text>,
    ) -> Option<&'n Node> {
        let found = || text!("no key {key}", key = quoted(key));
        member(members, key).or_else(|| self.error(found(), expected))
    }

    /// The one of these that has the name that stands here.
    pub fn one_of<T: Copy>(&mut self, all: &[T], name: fn(T) -> &'static str) -> Option<T> {
        let Value::Text(text) = &self.node.value else {
            return self.wrong();
        };
        let found = all.iter().copied().find(|one| name(*one) == text);
        found.or_else(|| {
            let names: Vec<String> = all.iter().map(|one| quoted(name(*one))).collect();
            self.expected = text!("one of {names}", names = names.join(", "));
            self.wrong()
        })
    }

    /// The members of an object.
    pub fn members(&mut self) -> Option<&'o [Member]> {
        match &self.node.value {
            Value::Object(members) => Some(members),
            _ => self.wrong(),
        }
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
            let path = &self.path.index(index);
            good &= take(one, &mut self.fields.at(node, path, expected.clone()));
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
            let path = &self.path.index(index);
            read(&mut self.fields.at(node, path, phrase!("")))
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
        let entries = self.members()?;
        let mut all = Vec::new();
        for entry in entries {
            let path = &self.path.key(&entry.key);
            if entry.key.trim() != entry.key || entry.key.is_empty() {
                let found = Text::verbatim(quoted(&entry.key));
                let expected = text!("a name without spaces around it");
                self.fields.error(entry.key_at, path, found, expected);
            }
            let mut at = self.fields.at(&entry.node, path, phrase!(""));
            all.push(read(&entry.key, &mut at));
        }
        Some(all)
    }
}
