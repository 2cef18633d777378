//! The fields of an object, declared once.
//!
//! A declaration is a function that names each field once: its key, where it is in the value of the
//! program, its kind (unit, range and what a complaint expects, see [`kinds`](super::kinds)), and
//! whether it has to be there. Reading runs it over a blank value and fills that; writing runs it over
//! a finished one. What the function never names is an unknown key.

pub use super::at::Cursor;
use crate::text::{Template, Text};

use super::fields::{member, optional};
use super::{Fields, Member, Node, Path, Value};

/// How one kind of value stands in a document.
pub struct Kind<T> {
    /// What should stand there.
    pub expected: Template,
    /// Takes it from its place, or complains.
    pub read: fn(&mut Cursor<'_, '_>) -> Option<T>,
    /// What is written.
    pub write: fn(&T) -> Value,
}

impl<T> Kind<T> {
    /// Reads a value of this kind.
    pub fn read(&self, fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<T> {
        (self.read)(&mut fields.at(node, path, self.expected))
    }
}

/// An object whose fields are being read or written.
pub struct Object<'o, 'a> {
    /// What is read, and its members; nothing where it is written.
    reading: Option<(Cursor<'o, 'a>, &'o [Member])>,
    accepted_keys: Vec<&'static str>,
    written: Vec<Member>,
    /// No field was wrong so far.
    good: bool,
    is_over: bool,
}

/// What an object's fields write of a value.
pub fn written<T>(mut value: T, declare: impl FnOnce(&mut Object<'_, '_>, &mut T)) -> Value {
    let mut object = Object::new(None);
    declare(&mut object, &mut value);
    Value::Object(object.written)
}

impl<'o, 'a> Object<'o, 'a> {
    fn new(reading: Option<(Cursor<'o, 'a>, &'o [Member])>) -> Self {
        Self {
            reading,
            accepted_keys: Vec::new(),
            written: Vec::new(),
            good: true,
            is_over: false,
        }
    }
}

impl Object<'_, '_> {
    /// A field that has to be there.
    pub fn required<T>(&mut self, key: &'static str, value: &mut T, kind: &Kind<T>) {
        self.required_as(key, kind.expected, value, kind);
    }

    /// As [`Object::required`], with what is expected where nothing is there.
    pub fn required_as<T>(
        &mut self,
        key: &'static str,
        expected: Template,
        value: &mut T,
        kind: &Kind<T>,
    ) {
        if self.needs(key, expected) {
            self.field(key, value, kind);
        }
    }

    /// A field that keeps its usual value where it is missing or null.
    pub fn usual<T>(&mut self, key: &'static str, value: &mut T, kind: &Kind<T>) {
        if self.given(key) {
            self.field(key, value, kind);
        }
    }

    /// As [`Object::usual`]; it is written only where it says something.
    pub fn usual_if<T>(&mut self, says: bool, key: &'static str, value: &mut T, kind: &Kind<T>) {
        if says || self.is_read() {
            self.usual(key, value, kind);
        }
    }

    /// A field that keeps its usual value where it is missing; null is none.
    pub fn usual_or_null<T>(&mut self, key: &'static str, value: &mut Option<T>, kind: &Kind<T>) {
        let read = |at: &mut Cursor<'_, '_>| match at.node.value {
            Value::Null => Some(None),
            _ => (kind.read)(at).map(Some),
        };
        let write = |value: &Option<T>| Some(value.as_ref().map_or(Value::Null, kind.write));
        self.with(key, value, kind.expected, read, write);
    }

    /// A field that may be missing or null, and is not written then.
    pub fn optional<T>(&mut self, key: &'static str, value: &mut Option<T>, kind: &Kind<T>) {
        if self.given(key) {
            self.some(key, value, kind);
        }
    }

    /// A field that is there, of a value that the program may lack.
    pub(crate) fn some<T>(&mut self, key: &'static str, value: &mut Option<T>, kind: &Kind<T>) {
        let read = |at: &mut Cursor<'_, '_>| (kind.read)(at).map(Some);
        let write = |value: &Option<T>| value.as_ref().map(kind.write);
        self.with(key, value, kind.expected, read, write);
    }

    /// A field that is there; null is something wrong.
    pub fn field<T>(&mut self, key: &'static str, value: &mut T, kind: &Kind<T>) {
        let write = |value: &T| Some((kind.write)(value));
        self.with(key, value, kind.expected, |at| (kind.read)(at), write);
    }

    /// A field that is read and written like this, where it is there at all.
    pub fn with<T>(
        &mut self,
        key: &'static str,
        value: &mut T,
        expected: impl Into<Text>,
        read: impl FnOnce(&mut Cursor<'_, '_>) -> Option<T>,
        write: impl FnOnce(&T) -> Option<Value>,
    ) {
        self.know(key);
        if self.is_over {
            return;
        }
        let Some((at, members)) = &mut self.reading else {
            self.written
                .extend(write(value).map(|value| Member::new(key, value)));
            return;
        };
        let Some(node) = member(members, key) else {
            return;
        };
        let path = &at.path.key(key);
        match read(&mut at.fields.at(node, path, expected)) {
            Some(read) => *value = read,
            None => self.good = false,
        }
    }

    /// An object within it that is about the same value; it has to be there.
    pub fn part<T>(
        &mut self,
        key: &'static str,
        value: &mut T,
        expected: impl Into<Text>,
        declare: fn(&mut Object<'_, '_>, &mut T),
    ) {
        if !self.is_read() {
            let part = written(value, |o, value| declare(o, value));
            return self.written.push(Member::new(key, part));
        }
        let expected = expected.into();
        if self.needs(key, &expected) {
            let read = |at: &mut Cursor<'_, '_>| at.fill(value, declare).then_some(());
            self.with(key, &mut (), expected, read, |()| None);
        }
    }

    /// A field that always says the same, and was read before.
    pub fn describe(&mut self, key: &'static str, text: &str) {
        self.know(key);
        self.written.push(Member::new(key, text));
    }

    /// A key that is known, whatever stands there.
    pub fn know(&mut self, key: &'static str) {
        self.accepted_keys.push(key);
    }

    /// As [`Object::is_given`], of a key that is known.
    pub fn given(&mut self, key: &'static str) -> bool {
        self.know(key);
        self.is_given(key)
    }

    /// Whether there is something to read under a key; what is written is always there.
    pub fn is_given(&self, key: &str) -> bool {
        let members = self.reading.as_ref().map(|(_, members)| members);
        members.is_none_or(|members| optional(members, key).is_some())
    }

    /// Whether it is being read.
    pub fn is_read(&self) -> bool {
        self.reading.is_some()
    }

    /// As [`Object::is_given`], null being something; complains where nothing is.
    pub fn needs(&mut self, key: &'static str, expected: impl Into<Text>) -> bool {
        self.know(key);
        let reading = self.reading.as_mut().filter(|_| !self.is_over);
        let found =
            reading.is_none_or(|(at, members)| at.required(members, key, expected).is_some());
        self.good &= found;
        found
    }

    /// Complains of the object as a whole.
    pub fn error(&mut self, found: impl Into<Text>, expected: impl Into<Text>) {
        self.good = false;
        if let Some((at, _)) = &mut self.reading {
            at.error::<()>(found, expected);
        }
    }

    /// Complains of a field, or of its lack.
    pub fn error_in(&mut self, key: &str, found: impl Into<Text>, expected: impl Into<Text>) {
        self.good = false;
        if let Some((at, members)) = &mut self.reading {
            let node = member(members, key).unwrap_or(at.node);
            at.fields.error(node.at, &at.path.key(key), found, expected);
        }
    }

    /// Reads no more fields: they would be judged by one that was wrong.
    pub fn end_if_wrong(&mut self) {
        self.is_over |= !self.good;
    }

    /// Whether it is being read and no field was wrong so far: what they say together can be checked.
    pub fn has_read_well(&self) -> bool {
        self.good && self.is_read()
    }
}

impl Cursor<'_, '_> {
    /// As [`Cursor::list`], of one element or more.
    pub(crate) fn some<T>(&mut self, kind: &Kind<T>) -> Option<Vec<T>> {
        match &self.node.value {
            Value::List(list) if list.is_empty() => self.wrong(),
            _ => self.list(kind),
        }
    }

    /// Every element of an array, unless one of them is wrong.
    pub fn list<T>(&mut self, kind: &Kind<T>) -> Option<Vec<T>> {
        self.list_by(|at| {
            at.expected = kind.expected.into();
            (kind.read)(at)
        })
    }

    /// The value that an object's fields make of a blank one; `None` when one of them is wrong.
    pub fn object<T>(
        &mut self,
        mut blank: T,
        declare: fn(&mut Object<'_, '_>, &mut T),
    ) -> Option<T> {
        self.fill(&mut blank, declare).then_some(blank)
    }

    /// Fills what the fields of an object say into a value; whether all of them were good.
    pub fn fill<T>(
        &mut self,
        value: &mut T,
        declare: impl FnOnce(&mut Object<'_, '_>, &mut T),
    ) -> bool {
        let Some(members) = self.members() else {
            return false;
        };
        let first = self.fields.findings.len();
        let at = self.fields.at(self.node, self.path, phrase!(""));
        let mut object = Object::new(Some((at, members)));
        declare(&mut object, value);
        let (good, known) = (object.good, object.accepted_keys);
        // Keys that are not read are noted before what was found in the others.
        let notes = self.fields.notes_of_unknown(members, self.path, &known);
        self.fields.findings.splice(first..first, notes);
        good
    }
}
