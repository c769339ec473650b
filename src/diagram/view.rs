//! The views of the optics, each with its names.

/// What is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum View {
    /// The section from film to object, from the right.
    Side,
    /// The section from film to object, from above.
    Above,
    /// Suffern's figure of the lens, the view plane and the focal plane, from the right.
    CrossSection,
    /// Suffern's figure of lens, view plane and focal plane in space.
    Layout,
    /// Suffern's figure of the two rays on the view plane, from behind.
    TwoRays,
    /// Suffern's figure of the circle of confusion.
    CircleOfConfusion,
}

/// A view with its names.
#[derive(Debug)]
pub struct ViewEntry {
    /// The view.
    pub view: View,
    /// Its name on the command line.
    pub name: &'static str,
    /// Its name in the viewer.
    pub label: &'static str,
    /// What it shows.
    pub help: &'static str,
}

/// All views.
pub static VIEWS: [ViewEntry; 6] = [
    ViewEntry {
        view: View::Side,
        name: "side",
        label: "From the side",
        help: "Film, lens, focal plane and object from the right",
    },
    ViewEntry {
        view: View::Above,
        name: "above",
        label: "From above",
        help: "Film, lens, focal plane and object from above",
    },
    ViewEntry {
        view: View::CrossSection,
        name: "cross-section",
        label: "Cross section",
        help: "Lens, view plane and focal plane from the right, with the letters of Suffern's book",
    },
    ViewEntry {
        view: View::Layout,
        name: "layout",
        label: "Layout",
        help: "Lens, view plane and focal plane in space, with the letters of Suffern's book",
    },
    ViewEntry {
        view: View::TwoRays,
        name: "two-rays",
        label: "Two rays",
        help: "Where the centre ray and a primary ray go through the (viewX, viewY) plane, with the letters of Suffern's book",
    },
    ViewEntry {
        view: View::CircleOfConfusion,
        name: "circle-of-confusion",
        label: "Circle of confusion",
        help: "Lens and film, and what the film shows of a point, with the letters of Suffern's book",
    },
];

impl View {
    /// The view with its names.
    pub fn entry(self) -> &'static ViewEntry {
        VIEWS.iter().find(|entry| entry.view == self).unwrap_or(&VIEWS[0])
    }

    /// Whether this is the section from film to object.
    pub fn is_section(self) -> bool {
        matches!(self, Self::Side | Self::Above)
    }
}
