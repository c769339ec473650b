//! Writes a drawing as SVG: W3C, *Scalable Vector Graphics 1.1*.

use super::Drawing;
use super::sheet::{LETTERS, Pane, Point, Role, Shape, text_width};
use std::fmt::Write;

/// The drawing as the text of an SVG file.
pub fn svg(drawing: &Drawing) -> String {
    let [width, height] = drawing.size;
    let mut out = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    line(
        &mut out,
        format_args!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"Ubuntu Light, Ubuntu, sans-serif\" \
             font-size=\"{LETTERS}\" font-weight=\"300\">"
        ),
    );
    let background = paint("fill", Role::Paper);
    line(&mut out, format_args!("<rect width=\"{width}\" height=\"{height}\"{background}/>"));
    for pane in &drawing.panes {
        write_pane(&mut out, pane);
    }
    out.push_str("</svg>\n");
    out
}

fn write_pane(out: &mut String, pane: &Pane) {
    let [x, y] = pane.min;
    let [width, height] = [0, 1].map(|axis| pane.max[axis] - pane.min[axis]);
    // What lies outside of an inner svg element is not shown.
    line(
        out,
        format_args!(
            "<svg x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" viewBox=\"{x} {y} {width} {height}\">"
        ),
    );
    for shape in &pane.shapes {
        write_shape(out, shape);
    }
    out.push_str("</svg>\n");
}

fn write_shape(out: &mut String, shape: &Shape) {
    match shape {
        Shape::Line { points, role, width, closed, dashed } => {
            let element = if *closed { "polygon" } else { "polyline" };
            let dashes = if *dashed { " stroke-dasharray=\"5\"" } else { "" };
            let (points, stroke) = (listed(points), paint("stroke", *role));
            line(
                out,
                format_args!(
                    "<{element} points=\"{points}\" fill=\"none\"{stroke} stroke-width=\"{width}\"{dashes}/>"
                ),
            );
        }
        Shape::Area { corners, role } => {
            let (points, fill) = (listed(corners), paint("fill", *role));
            line(out, format_args!("<polygon points=\"{points}\"{fill}/>"));
        }
        Shape::Square { min: [x, y], max, role } => {
            let ([width, height], fill) = ([max[0] - x, max[1] - y], paint("fill", *role));
            line(
                out,
                format_args!(
                    "<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{width:.2}\" height=\"{height:.2}\" \
                     shape-rendering=\"crispEdges\"{fill}/>"
                ),
            );
        }
        Shape::Dot { at: [x, y], radius, role } => {
            let fill = paint("fill", *role);
            line(out, format_args!("<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius}\"{fill}/>"));
        }
        Shape::Text { at: [x, y], anchor, role, text } => {
            let (width, fill) = (text_width(text), paint("fill", *role));
            let left = anchor.left(*x, width);
            // The base line of letters lies below their middle.
            let base = y + 0.32 * LETTERS;
            let text = escaped(text);
            line(
                out,
                format_args!(
                    "<text x=\"{left:.2}\" y=\"{base:.2}\" textLength=\"{width:.2}\" \
                     lengthAdjust=\"spacingAndGlyphs\"{fill}>{text}</text>"
                ),
            );
        }
    }
}

fn line(out: &mut String, text: std::fmt::Arguments<'_>) {
    writeln!(out, "{text}").expect("a text grows as needed");
}

/// Attributes that paint the inside or the line of a shape.
fn paint(what: &str, role: Role) -> String {
    let [red, green, blue, opacity] = role.color();
    let [red, green, blue] = [red, green, blue].map(|level| (255.0 * level).round() as u8);
    let opacity = if opacity < 1.0 { format!(" {what}-opacity=\"{opacity:.3}\"") } else { String::new() };
    format!(" {what}=\"#{red:02x}{green:02x}{blue:02x}\"{opacity}")
}

fn listed(points: &[Point]) -> String {
    let points: Vec<String> = points.iter().map(|[x, y]| format!("{x:.2},{y:.2}")).collect();
    points.join(" ")
}

/// A text of which XML takes no letter for a sign of its own. Letters that XML forbids are replaced.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for letter in text.chars() {
        match letter {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            letter if letter.is_control() || matches!(letter, '\u{fffe}' | '\u{ffff}') => {
                out.push('\u{fffd}');
            }
            letter => out.push(letter),
        }
    }
    out
}
