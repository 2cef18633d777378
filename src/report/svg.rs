//! A drawing as SVG, with nothing from outside.

use std::fmt::Write as _;

use super::html::escape;
use crate::present::drawing::{Anchor, Colour, Drawing, Item, Label, Stroke};

/// A file of its own: with the name of its language, and a font that most machines have.
pub fn svg_file(drawing: &Drawing, title: &str) -> String {
    let inside = svg(drawing, title);
    inside.replacen(
        "<svg ",
        "<svg xmlns=\"http://www.w3.org/2000/svg\" font-family=\"Inter, Helvetica, Arial, sans-serif\" ",
        1,
    )
}

/// For a place inside a page.
pub fn svg(drawing: &Drawing, title: &str) -> String {
    let mut out = format!(
        "<svg viewBox=\"0 0 {} {}\" role=\"img\"><title>{}</title>\n",
        number(drawing.width),
        number(drawing.height),
        escape(title)
    );
    for item in &drawing.items {
        match item {
            Item::Lines(lines, stroke) => lines_of(lines, *stroke, &mut out),
            Item::Box([x, y], [w, h], colour) => {
                let _ = writeln!(
                    out,
                    "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>",
                    number(*x),
                    number(*y),
                    number(*w),
                    number(*h),
                    hex(*colour)
                );
            }
            Item::Marks {
                shape,
                at,
                half,
                colour,
                filled,
            } => {
                let mut path = String::new();
                for [x, y] in at {
                    for (k, [dx, dy]) in shape.corners().iter().enumerate() {
                        let command = if k == 0 { 'M' } else { 'L' };
                        let _ = write!(
                            path,
                            "{command}{} {}",
                            number(x + half * dx),
                            number(y + half * dy)
                        );
                    }
                    path.push('Z');
                }
                let paint = if *filled {
                    format!("fill=\"{}\"", hex(*colour))
                } else {
                    format!(
                        "fill=\"#ffffff\" stroke=\"{}\" stroke-width=\"0.7\"",
                        hex(*colour)
                    )
                };
                let _ = writeln!(out, "<path d=\"{path}\" {paint}/>");
            }
            Item::Text(label) => text(label, &mut out),
        }
    }
    out.push_str("</svg>\n");
    out
}

fn lines_of(lines: &[Vec<[f64; 2]>], stroke: Stroke, out: &mut String) {
    let mut path = String::new();
    for line in lines {
        for (k, [x, y]) in line.iter().enumerate() {
            let command = if k == 0 { 'M' } else { 'L' };
            let _ = write!(path, "{command}{} {}", number(*x), number(*y));
        }
    }
    let dash = if stroke.dash[0] > 0.0 {
        format!(
            " stroke-dasharray=\"{} {}\"",
            number(stroke.dash[0]),
            number(stroke.dash[1])
        )
    } else {
        String::new()
    };
    let _ = writeln!(
        out,
        "<path d=\"{path}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{dash}/>",
        hex(stroke.colour),
        number(stroke.width)
    );
}

fn text(label: &Label, out: &mut String) {
    let [x, y] = label.at.map(number);
    let place = if label.upwards {
        format!("transform=\"translate({x} {y}) rotate(-90)\"")
    } else {
        format!("x=\"{x}\" y=\"{y}\"")
    };
    let anchor = match label.anchor {
        Anchor::Start => "",
        Anchor::Middle => " text-anchor=\"middle\"",
        Anchor::End => " text-anchor=\"end\"",
    };
    let weight = if label.bold {
        " font-weight=\"600\""
    } else {
        ""
    };
    let _ = writeln!(
        out,
        "<text {place} font-size=\"{}\" fill=\"{}\"{anchor}{weight}>{}</text>",
        number(label.size),
        hex(label.colour),
        escape(&label.text)
    );
}

fn hex(Colour(r, g, b): Colour) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// A hundredth of a point is finer than any screen; what is not finite is put at the corner.
pub(super) fn number(value: f64) -> String {
    if !value.is_finite() {
        return "0".to_owned();
    }
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".to_owned()
    } else {
        text.to_owned()
    }
}
