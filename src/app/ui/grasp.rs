//! Moves the parts of the drawing of the optics by hand.

use super::widgets::Layout;
use crate::app::optics::{HeldPart, Optics};
use crate::app::theme::{GRASP_REACH, HALO, HALO_WIDTH};
use crate::diagram::{Diagram, Drawing, Part, View};
use crate::scene::{CameraModel, DIAMETERS, FOCAL_DISTANCES, FOCAL_LENGTHS_MM, MAX_LENGTH, MIN_LENGTH};
use crate::settings::Estimator;
use imgui::{MouseButton, MouseCursor, Ui};

/// A part comes no nearer to the lens than this, in points.
const CLOSEST: f32 = 8.0;

impl Optics {
    /// Lets the user move the parts of the drawing, which was just painted with its upper left corner there.
    pub(super) fn take_hold(
        &mut self,
        ui: &Ui,
        diagram: &Diagram,
        drawing: &Drawing,
        corner: [f32; 2],
        estimator: &mut Estimator,
    ) {
        let pointer = [0, 1].map(|axis| ui.io().mouse_pos[axis] - corner[axis]);
        let under_pointer = drawing.handles.iter().find(|handle| handle.distance(pointer) <= GRASP_REACH);
        if ui.is_item_activated() {
            self.held = under_pointer.zip(drawing.scale).map(|(handle, scale)| {
                let on_it = handle.nearest(pointer);
                HeldPart {
                    part: handle.part,
                    scale,
                    beside: [0, 1].map(|axis| pointer[axis] - on_it[axis]),
                    diameter_per_half: diameter_per_half(self.view, diagram, estimator),
                    slope: diagram.slope.truncate(),
                    mm_per_distance: estimator.camera.focal_length_mm() / diagram.image.film_distance,
                }
            });
        } else if !ui.is_item_active() {
            self.held = None;
        }
        let hovered = under_pointer.filter(|_| ui.is_item_hovered()).map(|handle| handle.part);
        let Some(part) = self.held.map(|held| held.part).or(hovered) else {
            return;
        };
        ui.set_mouse_cursor(Some(match part {
            Part::Rim => MouseCursor::ResizeNS,
            Part::Point | Part::FocalPlane | Part::Film => MouseCursor::ResizeEW,
        }));
        halo(ui, drawing, part, corner);
        // A click that does not move anything changes nothing.
        if let Some(held) = self.held.filter(|_| ui.is_mouse_dragging(MouseButton::Left)) {
            self.move_part(&held, [0, 1].map(|axis| pointer[axis] - held.beside[axis]), estimator);
        }
    }

    /// Moves a part to a place of the drawing.
    fn move_part(&mut self, held: &HeldPart, [x, y]: [f32; 2], estimator: &mut Estimator) {
        let lens_x = held.scale.lens[0];
        match held.part {
            Part::Point => {
                let depth = held.scale.depth(x.max(lens_x + CLOSEST));
                self.pin.depth = Some(depth.clamp(f64::from(MIN_LENGTH), f64::from(MAX_LENGTH)));
            }
            Part::FocalPlane => {
                let [least, most] = FOCAL_DISTANCES;
                let Estimator { camera, lens, .. } = estimator;
                let (slope, depth) = held.scale.seen_at([x.max(lens_x + CLOSEST), y], held.slope);
                if let Some(distance) = camera.focal_distance_at(lens, slope, depth) {
                    lens.focal_distance = (distance as f32).clamp(least, most);
                }
            }
            Part::Film => {
                let distance = -held.scale.depth(x.min(lens_x - CLOSEST));
                let [least, most] = FOCAL_LENGTHS_MM;
                let focal_length = (held.mm_per_distance * distance).clamp(least, most);
                estimator.camera.set_focal_length_mm(focal_length);
            }
            Part::Rim => {
                let diameter = held.diameter_per_half * held.scale.height_at_lens(y);
                let [least, most] = DIAMETERS;
                let diameter = (diameter as f32).clamp(least, most);
                match estimator.model {
                    CameraModel::Hole => estimator.hole.diameter = diameter,
                    CameraModel::ThinLens | CameraModel::Pinhole => estimator.lens.diameter = diameter,
                }
            }
        }
    }
}

/// The diameter of the opening divided by its half extent in the drawing, which depends on the shape of the opening.
fn diameter_per_half(view: View, diagram: &Diagram, estimator: &Estimator) -> f64 {
    let half = diagram.half_aperture[usize::from(view != View::Above)];
    let diameter = match estimator.model {
        CameraModel::Hole => estimator.hole.diameter,
        CameraModel::ThinLens | CameraModel::Pinhole => estimator.lens.diameter,
    };
    if half > 0.0 { f64::from(diameter) / half } else { 2.0 }
}

/// Shows that a part can be moved.
fn halo(ui: &Ui, drawing: &Drawing, part: Part, corner: [f32; 2]) {
    let list = ui.get_window_draw_list();
    for handle in drawing.handles.iter().filter(|handle| handle.part == part) {
        let [from, to] = handle.line.map(|[x, y]| [corner[0] + x, corner[1] + y]);
        if from == to {
            list.add_circle(from, HALO_WIDTH, HALO).filled(true).build();
        } else {
            list.add_line(from, to, HALO).thickness(HALO_WIDTH).build();
        }
    }
}

/// Notes where the parts of the drawing can be grasped.
pub(super) fn note_handles(ui: &Ui, drawing: &Drawing, corner: [f32; 2], layout: &mut Layout) {
    let scale = ui.io().display_framebuffer_scale;
    for handle in &drawing.handles {
        let name = match handle.part {
            Part::Point => "Point in the drawing",
            Part::Rim => "Rim in the drawing",
            Part::FocalPlane => "Focal plane in the drawing",
            Part::Film => "Film in the drawing",
        };
        let [from, to] = handle
            .line
            .map(|point| [0, 1].map(|axis| ((corner[axis] + point[axis]) * scale[axis]).round() as i32));
        layout.push((name, [from[0], from[1], to[0] - from[0], to[1] - from[1]]));
    }
}
