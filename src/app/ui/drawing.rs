//! Paints a drawing of the optics in a window.

use crate::diagram::{Drawing, LETTERS, Pane, Point, Role, Shape, text_width};
use imgui::{DrawListMut, Ui};

/// The length of a dash and of a gap, in points.
const DASH: f32 = 5.0;

/// Paints a drawing at the cursor of the window. It can be clicked.
pub(super) fn paint(ui: &Ui, drawing: &Drawing) {
    let corner = ui.cursor_screen_pos();
    let list = ui.get_window_draw_list();
    for pane in &drawing.panes {
        paint_pane(&list, pane, corner);
    }
    drop(list);
    let [width, height] = drawing.size;
    ui.invisible_button("##sheet", [width.max(1.0), (height - 1.0).max(1.0)]);
}

fn paint_pane(list: &DrawListMut<'_>, pane: &Pane, corner: Point) {
    let at = |[x, y]: Point| [corner[0] + x, corner[1] + y];
    list.with_clip_rect_intersect(at(pane.min), at(pane.max), || {
        for shape in &pane.shapes {
            paint_shape(list, shape, at);
        }
    });
}

fn paint_shape(list: &DrawListMut<'_>, shape: &Shape, at: impl Fn(Point) -> Point) {
    let placed = |points: &[Point]| points.iter().map(|point| at(*point)).collect::<Vec<_>>();
    match shape {
        Shape::Line { points, role, width, dashed: true, .. } => {
            for pair in placed(points).windows(2) {
                dashes(list, [pair[0], pair[1]], *role, *width);
            }
        }
        Shape::Line { points, role, width, closed, .. } => {
            let mut points = placed(points);
            points.extend(closed.then(|| points[0]));
            list.add_polyline(points, role.color()).thickness(*width).build();
        }
        Shape::Area { corners, role } => {
            list.add_polyline(placed(corners), role.color()).filled(true).build();
        }
        Shape::Square { min, max, role } => {
            list.add_rect(at(*min), at(*max), role.color()).filled(true).build();
        }
        Shape::Dot { at: middle, radius, role } => {
            list.add_circle(at(*middle), *radius, role.color()).filled(true).build();
        }
        Shape::Text { at: [x, y], anchor, role, text } => {
            let left = anchor.left(*x, text_width(text));
            list.add_text(at([left, y - 0.5 * LETTERS]), role.color(), text);
        }
    }
}

fn dashes(list: &DrawListMut<'_>, [from, to]: [Point; 2], role: Role, width: f32) {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let length = dx.hypot(dy);
    // A line that leaves the drawing could be extremely long, and its dashes would take forever.
    let dashes = (length / (2.0 * DASH)).min(1000.0) as u16;
    let along = |way: f32| [from[0] + dx / length * way, from[1] + dy / length * way];
    for dash in 0..=dashes {
        let start = 2.0 * DASH * f32::from(dash);
        let end = (start + DASH).min(length);
        if start < end {
            list.add_line(along(start), along(end), role.color()).thickness(width).build();
        }
    }
}
