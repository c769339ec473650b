//! The part of the panel for the shape of the aperture.

use super::widgets::{Layout, combo, note_item, tooltip};
use crate::app::panel::Panel;
use crate::scene::{Aperture, CameraModel};
use crate::settings::Part;
use imgui::Ui;

/// The shapes to choose from.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Shape {
    Disc,
    Iris,
    CatsEye,
    Image,
}

const SHAPES: [(Shape, &str, &str); 4] = [
    (Shape::Disc, "Round opening", "What is out of focus blurs into discs."),
    (Shape::Iris, "Iris of blades", "As in most cameras: what is out of focus blurs into polygons."),
    (
        Shape::CatsEye,
        "Cat's eye",
        "The rim of a real lens cuts off light that comes in at an angle. So discs become cat's eyes towards the corners of the picture, which darken.",
    ),
    (Shape::Image, "Image", "What is out of focus blurs into the shape of a PNG file (--aperture-image)."),
];

fn shape_of(aperture: &Aperture) -> Shape {
    if aperture.image.is_some() {
        Shape::Image
    } else if aperture.blades > 0 {
        Shape::Iris
    } else if aperture.cats_eye > 0.0 {
        Shape::CatsEye
    } else {
        Shape::Disc
    }
}

impl Panel {
    /// Draws the list of shapes and the rows of the chosen one.
    pub(super) fn aperture(&mut self, ui: &Ui, layout: &mut Layout) {
        let estimator = &mut self.settings.estimator;
        let (aperture, image, model) = (&mut estimator.aperture, self.image.as_ref(), estimator.model);
        let shape = shape_of(aperture);
        let offered = |choice: Shape| match choice {
            Shape::Disc | Shape::Iris => true,
            Shape::CatsEye => model == CameraModel::ThinLens,
            Shape::Image => image.is_some(),
        };
        let shown = SHAPES.iter().find(|entry| entry.0 == shape).map_or("", |entry| entry.1);
        let help = "The shape of the aperture, which is also the shape of the blur.";
        combo(ui, "Aperture", shown, help, layout, |layout| {
            for (choice, label, help) in SHAPES.into_iter().filter(|entry| offered(entry.0)) {
                if ui.selectable_config(label).selected(choice == shape).build() && choice != shape {
                    let anamorphic = aperture.anamorphic;
                    *aperture = Aperture { anamorphic, ..Aperture::default() };
                    match choice {
                        Shape::Disc => {}
                        Shape::Iris => aperture.blades = 6,
                        Shape::CatsEye => aperture.cats_eye = 0.5,
                        Shape::Image => aperture.image = image.cloned(),
                    }
                }
                note_item(ui, label, layout);
                tooltip(ui, help);
            }
        });
        self.rows(ui, Part::Aperture, layout);
    }
}
