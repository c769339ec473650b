//! The part of the panel that shapes the opening.

use super::widgets::{Layout, combo, named, note_item, tooltip};
use crate::scene::{Aperture, ApertureImage, BLADES, CameraModel};
use imgui::{SliderFlags, Ui};

/// What an opening can be made of.
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
        "The rim of a real lens cuts off light that comes in at an angle: discs turn into cat's eyes towards the corners, which darken.",
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

/// `image`: the one that was opened last.
pub(super) fn edit(
    ui: &Ui,
    aperture: &mut Aperture,
    image: Option<&ApertureImage>,
    model: CameraModel,
    layout: &mut Layout,
) {
    let shape = shape_of(aperture);
    let offered = |choice: Shape| match choice {
        Shape::Disc | Shape::Iris => true,
        Shape::CatsEye => model == CameraModel::ThinLens,
        Shape::Image => image.is_some(),
    };
    let shown = SHAPES.iter().find(|entry| entry.0 == shape).map_or("", |entry| entry.1);
    let help = "The shape of the opening, which is the shape of the blur.";
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
    match shape_of(aperture) {
        Shape::Iris => iris(ui, aperture, layout),
        Shape::CatsEye => named(
            ui,
            "Rim",
            "How far the front rim is off the lens's centre, seen from the picture's corner, in diameters.",
            layout,
            |id| {
                ui.slider_config(id, 0.01, 1.0)
                    .display_format("%.2f")
                    .flags(SliderFlags::ALWAYS_CLAMP)
                    .build(&mut aperture.cats_eye);
            },
        ),
        Shape::Disc | Shape::Image => {}
    }
    named(
        ui,
        "Anamorphic",
        "How often the opening's width goes into its height. Lenses for wide screens squeeze the picture, and leave tall ovals.",
        layout,
        |id| {
            ui.slider_config(id, 0.5, 2.0)
                .display_format("%.2f")
                .flags(SliderFlags::ALWAYS_CLAMP | SliderFlags::LOGARITHMIC)
                .build(&mut aperture.anamorphic);
        },
    );
}

fn iris(ui: &Ui, aperture: &mut Aperture, layout: &mut Layout) {
    named(
        ui,
        "Blades",
        "How many blades the iris has. Their corners lie on the rim of the lens diameter: six let in 83% of the light of a disc.",
        layout,
        |id| {
            ui.slider_config(id, *BLADES.start(), *BLADES.end())
                .flags(SliderFlags::ALWAYS_CLAMP)
                .build(&mut aperture.blades);
        },
    );
    named(
        ui,
        "Blade rotation",
        "How far the iris is turned anticlockwise, in degrees, seen from behind the camera. At 0 the middle of an edge is at the right.",
        layout,
        |id| {
            ui.slider_config(id, -90.0, 90.0)
                .display_format("%.0f deg")
                .flags(SliderFlags::ALWAYS_CLAMP)
                .build(&mut aperture.rotation_degrees);
        },
    );
    named(ui, "Roundness", "How far the blades' edges are bent: 0 is a polygon, 1 a disc.", layout, |id| {
        ui.slider_config(id, 0.0, 1.0)
            .display_format("%.2f")
            .flags(SliderFlags::ALWAYS_CLAMP)
            .build(&mut aperture.roundness);
    });
}
