//! A drawing as SVG, with nothing from outside.

use std::fmt::Write as _;

use super::escape::escape;
use crate::present::drawing::{Anchor, Colour, Drawing, Item, Label, OVERLAP, Stroke};

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
            Item::Areas(areas) => areas_of(areas, &mut out),
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
        trace(line, &mut path);
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

/// Neighbours of one colour share a path: a mesh has thousands of areas.
fn areas_of(areas: &[(Vec<[f64; 2]>, Colour)], out: &mut String) {
    let width = number(OVERLAP);
    let _ = writeln!(
        out,
        "<g stroke-width=\"{width}\" stroke-linejoin=\"round\">"
    );
    for same in areas.chunk_by(|a, b| a.1 == b.1) {
        let mut path = String::new();
        for (corners, _) in same {
            trace(corners, &mut path);
            path.push('Z');
        }
        let colour = hex(same[0].1);
        let _ = writeln!(
            out,
            "<path d=\"{path}\" fill=\"{colour}\" stroke=\"{colour}\"/>"
        );
    }
    out.push_str("</g>\n");
}

/// From point to point.
fn trace(points: &[[f64; 2]], path: &mut String) {
    for (k, [x, y]) in points.iter().enumerate() {
        let command = if k == 0 { 'M' } else { 'L' };
        let _ = write!(path, "{command}{} {}", number(*x), number(*y));
    }
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

#[cfg(test)]
#[test]
fn areas_of_one_colour_share_a_path_and_overlap_their_neighbours() {
    let corners = |x: f64| vec![[x, 0.0], [x + 1.0, 0.0], [x, 1.5]];
    let [grey, ink] = [Colour(128, 128, 128), Colour(0, 0, 0)];
    let mut drawing = Drawing::new(9.0, 9.0);
    drawing.items.push(Item::Areas(vec![
        (corners(0.0), grey),
        (corners(2.0), grey),
        (corners(4.0), ink),
    ]));
    let text = svg(&drawing, "areas");
    let paths: Vec<&str> = text.lines().filter(|l| l.starts_with("<path")).collect();
    assert_eq!(
        paths,
        [
            r##"<path d="M0 0L1 0L0 1.5ZM2 0L3 0L2 1.5Z" fill="#808080" stroke="#808080"/>"##,
            r##"<path d="M4 0L5 0L4 1.5Z" fill="#000000" stroke="#000000"/>"##,
        ]
    );
    assert!(text.contains(r#"<g stroke-width="0.3" stroke-linejoin="round">"#));
}
