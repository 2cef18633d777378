//! A report as one HTML file that needs nothing else: style, font and plots are inside, and a policy
//! forbids the browser to fetch anything.

use std::fmt::Write as _;

use super::document::{Block, Report, Table};
use super::escape::escape;
use super::logo::{LOGO, Logo};
use super::svg::svg;
use crate::compensation::decision::Outcome;
use crate::present::decision::title;
use crate::text::{Language, Text};

const STYLE: &str = include_str!("style.css");
const REGULAR: &[u8] = include_bytes!("../../assets/fonts/Inter-Regular.ttf");
const SEMI_BOLD: &[u8] = include_bytes!("../../assets/fonts/Inter-SemiBold.ttf");

/// The report as HTML.
pub fn html(report: &Report) -> String {
    let mut out = String::with_capacity(512 * 1024);
    let _ = write!(
        out,
        "<!doctype html>\n<html lang=\"{}\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
         style-src 'unsafe-inline'; font-src data:{}\">\n\
         <title>{}: {}</title>\n<style>\n{}{}{STYLE}{}</style>\n</head>\n<body>\n<main>\n",
        report.language.code(),
        report.logo.as_ref().map_or("", |_| "; img-src data:"),
        escape(&report.title),
        escape(&report.subject),
        face(400, REGULAR),
        face(600, SEMI_BOLD),
        numbered(report.language)
    );
    head(report, &mut out);
    for section in &report.sections {
        let _ = writeln!(out, "<section>\n<h2>{}</h2>", escape(&section.title));
        for block in &section.blocks {
            write_block(block, &mut out);
        }
        out.push_str("</section>\n");
    }
    let _ = writeln!(
        out,
        "<footer>{}</footer>\n</main>\n</body>\n</html>",
        escape(&report.foot)
    );
    out
}

fn head(report: &Report, out: &mut String) {
    let _ = writeln!(
        out,
        "<header>\n{}<p class=\"kind\">{}</p>\n<h1>{}</h1>\n<p class=\"answer\">{}</p>\n{}<dl class=\"headline\">",
        report.logo.as_ref().map_or_else(String::new, picture),
        escape(&report.title),
        escape(&report.subject),
        escape(&report.answer),
        report
            .decision
            .as_ref()
            .map_or_else(String::new, |own| decision(own, report.language))
    );
    for figure in &report.headline {
        let _ = writeln!(
            out,
            "<div><dt>{}</dt><dd>{}<small>{}</small></dd></div>",
            escape(&figure.name),
            escape(&figure.value),
            escape(&figure.reference)
        );
    }
    out.push_str("</dl>\n</header>\n");
}

/// A logo as it is seen, points.
fn picture(logo: &Logo) -> String {
    let [width, height] = logo.within(LOGO);
    let data = base64(&logo.png());
    format!(
        "<img class=\"logo\" alt=\"\" style=\"width:{width:.1}pt;height:{height:.1}pt\" \
         src=\"data:image/png;base64,{data}\">\n"
    )
}

fn decision((outcome, says): &(Outcome, String), language: Language) -> String {
    let class = match outcome {
        Outcome::Pass => "pass",
        Outcome::Fail => "fail",
        Outcome::Undecided => "undecided",
    };
    let title = Text::from(title(*outcome)).spoken_in(language);
    let (title, says) = (escape(&title), escape(says));
    format!("<p class=\"decision {class}\"><b>{title}</b> {says}</p>\n")
}

fn write_block(block: &Block, out: &mut String) {
    let _ = match block {
        Block::Heading(text) => writeln!(out, "<h3>{}</h3>", escape(text)),
        Block::Text(text) | Block::Warning(text) => writeln!(out, "<p>{}</p>", escape(text)),
        Block::List(points) => {
            out.push_str("<ul>\n");
            for point in points {
                let _ = writeln!(out, "<li>{}</li>", escape(point));
            }
            writeln!(out, "</ul>")
        }
        Block::Facts(facts) => {
            out.push_str("<dl class=\"facts\">\n");
            for (name, value) in facts {
                let _ = writeln!(
                    out,
                    "<div><dt>{}</dt><dd>{}</dd></div>",
                    escape(name),
                    escape(value).replace('\n', "<br>\n")
                );
            }
            writeln!(out, "</dl>")
        }
        Block::Table(table) => {
            write_table(table, out);
            Ok(())
        }
        Block::Plot(drawing, caption) => writeln!(
            out,
            "<figure>\n{}<figcaption>{}</figcaption>\n</figure>",
            svg(drawing, caption),
            escape(caption)
        ),
        Block::Sign(lines) => {
            out.push_str("<dl class=\"sign\">\n");
            for (name, value) in lines {
                let _ = writeln!(
                    out,
                    "<div><dd>{}</dd><dt>{}</dt></div>",
                    escape(value),
                    escape(name)
                );
            }
            writeln!(out, "</dl>")
        }
    };
}

fn write_table(table: &Table, out: &mut String) {
    out.push_str("<div class=\"table\"><table>\n<thead><tr>");
    let class = |right: bool| if right { " class=\"n\"" } else { "" };
    for column in &table.columns {
        let (class, heading) = (class(column.right), escape(&column.heading));
        let _ = write!(out, "<th{class}>{heading}</th>");
    }
    out.push_str("</tr></thead>\n<tbody>\n");
    for row in &table.rows {
        out.push_str("<tr>");
        for (column, cell) in table.columns.iter().zip(row) {
            let (class, shown) = (class(column.right), escape(&cell.shown));
            let _ = write!(out, "<td{class}>{shown}</td>");
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</tbody></table></div>\n");
}

/// The number of a page where the report is printed.
fn numbered(language: Language) -> String {
    let [number, of] = ["\" counter(page) \"", "\" counter(pages) \""];
    let says = text!("page {number} of {of}", number, of).spoken_in(language);
    format!(
        "@page {{ size: A4; margin: 18mm 18mm 20mm; @bottom-right {{ content: \"{says}\"; \
         font: 8pt \"Inter\", sans-serif; color: #5b6472; }} }}\n"
    )
}

fn face(weight: u16, font: &[u8]) -> String {
    format!(
        "@font-face{{font-family:\"Inter\";font-weight:{weight};\
         src:url(data:font/ttf;base64,{}) format(\"truetype\")}}\n",
        base64(font)
    )
}

/// RFC 4648, section 4.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let byte = |k: usize| u32::from(group.get(k).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for k in 0..4_usize {
            let digit = (bits >> (18 - 6 * k)) & 63;
            out.push(if k > group.len() {
                '='
            } else {
                char::from(DIGITS[digit as usize])
            });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_as_in_the_standard() {
        let cases = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foobar", "Zm9vYmFy"),
        ];
        for (plain, coded) in cases {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }

    #[test]
    fn nothing_that_a_name_holds_becomes_markup() {
        assert_eq!(
            escape("<a href=\"x\">'&"),
            "&lt;a href=&quot;x&quot;&gt;&#39;&amp;"
        );
    }
}
