//! Limits on a robot description for the XML parser, checked before it is parsed.
//!
//! The parser compares every attribute of an element with the others, keeps every namespace in one list
//! and writes an entity out wherever it is named: each is fine for a description of a robot and
//! ruinous for a file that was made to be. One pass over the bytes counts them.

use crate::text::{Template, Text};
/// What is wrong: at which byte, what was found, what was expected.
type Refusal = (usize, Text, Text);

/// Attributes of one element, and declarations of namespaces in a document.
const MOST_ATTRIBUTES: usize = 1000;
/// Attributes of a document.
const MOST_IN_ALL: usize = 500_000;
/// Bytes between the first and the last declaration of an entity, and their number.
const LARGEST_DECLARATIONS: usize = 1 << 16;
const MOST_ENTITIES: usize = 200;

/// Refuses a text that would cost more than in proportion to its length.
pub(super) fn check(text: &str) -> Result<(), Refusal> {
    attributes(text.as_bytes())?;
    entities(text)
}

/// Goes through the tags and counts their attributes: each has one value in quotes.
fn attributes(text: &[u8]) -> Result<(), Refusal> {
    const EXPECTED: Template = phrase!("the description of a robot");
    let (mut at, mut in_all, mut namespaces) = (0, 0, 0);
    while let Some(found) = memchr::memchr(b'<', &text[at..]) {
        let tag = at + found;
        let rest = &text[tag..];
        let skipped = [
            (&b"<!--"[..], &b"-->"[..]),
            (b"<![CDATA[", b"]]>"),
            (b"<?", b"?>"),
        ];
        if let Some((open, close)) = skipped.iter().find(|(open, _)| rest.starts_with(open)) {
            let Some(end) = memchr::memmem::find(&rest[open.len()..], close) else {
                return Ok(());
            };
            at = tag + open.len() + end + close.len();
            continue;
        }
        at = tag + 1;
        let mut own = 0;
        while let Some(step) = memchr::memchr3(b'>', b'"', b'\'', &text[at..]) {
            let before = &text[at..at + step];
            at += step + 1;
            let quote = text[at - 1];
            if quote == b'>' {
                break;
            }
            own += 1;
            namespaces += usize::from(memchr::memmem::find(before, b"xmlns").is_some());
            let Some(end) = memchr::memchr(quote, &text[at..]) else {
                return Ok(());
            };
            at += end + 1;
        }
        in_all += own;
        let found = if own > MOST_ATTRIBUTES {
            text!("an element with {own} attributes", own)
        } else if in_all > MOST_IN_ALL {
            text!("more than {most} attributes", most = MOST_IN_ALL)
        } else if namespaces > MOST_ATTRIBUTES {
            text!(
                "more than {most} declarations of namespaces",
                most = MOST_ATTRIBUTES
            )
        } else {
            continue;
        };
        return Err((tag, found, EXPECTED.into()));
    }
    Ok(())
}

/// Entities may be declared, but not of each other, and what they write out in all is no more than
/// twice the text.
fn entities(text: &str) -> Result<(), Refusal> {
    const DECLARES: &str = "<!ENTITY";
    let refuse = |at: usize, found: Text| {
        let expected = phrase!("well-formed XML with few and short entities, none within another");
        Err((at, found, expected.into()))
    };
    let all: Vec<usize> = memchr::memmem::find_iter(text.as_bytes(), DECLARES).collect();
    let (Some(&first), Some(&last)) = (all.first(), all.last()) else {
        return Ok(());
    };
    if all.len() > MOST_ENTITIES {
        return refuse(first, text!("{count} entities", count = all.len()));
    }
    // The last declaration ends with the quote that its value began with.
    let value = &text.as_bytes()[last..];
    let end = memchr::memchr2(b'"', b'\'', value).and_then(|open| {
        let close = memchr::memchr(value[open], &value[open + 1..])?;
        Some(last + open + 1 + close + 1)
    });
    let end = end.unwrap_or(text.len());
    if end - first > LARGEST_DECLARATIONS {
        return refuse(
            first,
            text!("entities of {bytes} bytes", bytes = end - first),
        );
    }
    let named = |part: &str| {
        let own = memchr::memchr_iter(b'&', part.as_bytes());
        let own = own.filter(|at| {
            let rest = &part[at + 1..];
            let usual = ["amp;", "lt;", "gt;", "quot;", "apos;", "#"];
            !usual.iter().any(|name| rest.starts_with(name))
        });
        own.collect::<Vec<usize>>()
    };
    if let Some(&within) = named(&text[first..end]).first() {
        return refuse(first + within, text!("an entity within another"));
    }
    let times = named(&text[..first]).len() + named(&text[end..]).len();
    if times.saturating_mul(end - first) > 2 * text.len() + (1 << 20) {
        return refuse(first, text!("entities that are named {times} times", times));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_ordinary_description_passes() {
        for text in [
            "",
            "<robot name='r'><!-- it's <a 'b' --><link name=\"a\"/></robot>",
            "<!DOCTYPE r [<!ENTITY a \"x\">]><robot name=\"&a;\"/>",
            "<![CDATA[<a b='c]]><a/>",
            "<a b='never closed",
            "<!-- never closed",
        ] {
            assert_eq!(check(text), Ok(()), "{text}");
        }
    }

    #[test]
    fn attributes_namespaces_and_entities_have_limits() {
        let many =
            |one: &dyn Fn(usize) -> String, count: usize| (0..count).map(one).collect::<String>();
        let attributes = format!("<a {}/>", many(&|k| format!("a{k}='' "), 1001));
        let namespaces = many(&|k| format!("<a xmlns:a='u{k}'/>"), 1001);
        let long = format!("<!DOCTYPE r [<!ENTITY a '{}'>]><r/>", "x".repeat(1 << 17));
        let often = format!(
            "<!DOCTYPE r [<!ENTITY a '{}'>]><r b='{}'/>",
            "x".repeat(60_000),
            "&a;".repeat(1000)
        );
        let within = "<!DOCTYPE r [<!ENTITY a 'x'><!ENTITY b '&a;&a;'>]><r/>".to_owned();
        for (text, says) in [
            (attributes, "1001 attributes"),
            (namespaces, "namespaces"),
            (long, "entities of"),
            (often, "named 1000 times"),
            (within, "within another"),
        ] {
            let (_, found, _) = check(&text).unwrap_err();
            assert!(found.to_string().contains(says), "{found}");
        }
    }
}
