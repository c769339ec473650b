//! Overlays: what can be shown instead of the picture, or on top of it. An overlay is a name in `overlay` of
//! `src/interface.rs`, an entry of [`OVERLAYS`], and a case in `shaders/core/overlay.glsl`.

use crate::interface::{BEHIND, IN_FRONT, MARK, SLICE, overlay};

/// An overlay, by its number in the shaders.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
#[allow(missing_docs, reason = "the help of each is in its entry")]
pub enum Overlay {
    FocusPeaking = overlay::FOCUS_PEAKING,
    FocalPlane = overlay::FOCAL_PLANE,
    CircleOfConfusion = overlay::CIRCLE_OF_CONFUSION,
    Depth = overlay::DEPTH,
    Normals = overlay::NORMALS,
    Count = overlay::COUNT,
    Error = overlay::ERROR,
}

/// The description of an overlay.
#[derive(Debug)]
pub struct Entry {
    /// The overlay.
    pub overlay: Overlay,
    /// The name on the command line and in scene files.
    pub name: &'static str,
    /// The name in the viewer.
    pub label: &'static str,
    /// A short text about what it shows.
    pub help: &'static str,
    /// The data that it is computed from.
    pub source: Source,
    /// The end of its scale.
    pub full_scale: FullScale,
    /// The linear colours of its legend, at equal distances from left to right.
    pub colors: &'static [[f32; 3]],
    /// The labels below the legend on the left, in the middle and on the right, given the end of the scale and the
    /// focal distance as text.
    pub labels: fn(f32, &str) -> [String; 3],
}

/// The data that an overlay is computed from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// The means and the counts in the film.
    Film,
    /// The second moments in the film, which must have been kept from the start of the picture.
    Moments,
    /// The surface that the middle of each pixel sees through the centre of the lens.
    Surface,
}

/// The end of the scale of an overlay.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FullScale {
    /// The scale ends at the wanted number of samples.
    Samples,
    /// The scale ends at this number.
    Number(f32),
    /// The scale ends at the height of the picture in pixels, divided by this.
    HeightOver(f32),
    /// The scale ends at [`super::View::tolerance`].
    Tolerance,
}

/// Every overlay, in the order of menus and help texts.
pub const OVERLAYS: [Entry; 7] = [
    Entry {
        overlay: Overlay::FocusPeaking,
        name: "focus-peaking",
        label: "Focus peaking",
        help: "The picture, with marks on the edges of everything sharp, and a tint between them: what is blurred over less than the tolerance.",
        source: Source::Surface,
        full_scale: FullScale::Tolerance,
        colors: &[MARK; 2],
        labels: |full, _| labels(&format!("blurred over {full:.2} px at most"), "", ""),
    },
    Entry {
        overlay: Overlay::FocalPlane,
        name: "focal-plane",
        label: "Focal plane",
        help: "The picture behind the focal plane, which is shown as a translucent sheet. What is in front of it sticks out, and a line marks where it cuts surfaces.",
        source: Source::Surface,
        full_scale: FullScale::Number(1.0),
        colors: &[SLICE; 2],
        labels: |_, distance| labels(&format!("at a depth of {distance}"), "", ""),
    },
    Entry {
        overlay: Overlay::CircleOfConfusion,
        name: "circle-of-confusion",
        label: "Circle of confusion",
        help: "The number of pixels that a point is blurred over: blue in front of the focal plane, orange behind it, white where the picture is sharp.",
        source: Source::Surface,
        full_scale: FullScale::HeightOver(30.0),
        colors: &[IN_FRONT, [1.0; 3], BEHIND],
        labels: |full, _| labels(&format!("{full:.0} px in front"), "sharp", &format!("behind {full:.0} px")),
    },
    Entry {
        overlay: Overlay::Depth,
        name: "depth",
        label: "Depth",
        help: "The distance along the optical axis: white at the lens, grey in the focal plane, black far away.",
        source: Source::Surface,
        full_scale: FullScale::Number(1.0),
        // The labels are at equal steps of F / (F + depth).
        colors: &[[1.0; 3], [0.75; 3], [0.5; 3], [0.25; 3], [0.0; 3]],
        labels: |_, distance| labels("lens", distance, "far away"),
    },
    Entry {
        overlay: Overlay::Normals,
        name: "normals",
        label: "Normals",
        help: "The direction that surfaces face: more red to the right, more green upwards, and blue towards the lens.",
        source: Source::Surface,
        full_scale: FullScale::Number(1.0),
        // The colours are those of horizontal normals, from left through the direction of the lens to right.
        colors: &[
            [0.0, 0.5, 0.5],
            [0.146, 0.5, 0.854],
            [0.5, 0.5, 1.0],
            [0.854, 0.5, 0.854],
            [1.0, 0.5, 0.5],
        ],
        labels: |_, _| labels("to the left", "to the lens", "to the right"),
    },
    Entry {
        overlay: Overlay::Count,
        name: "count",
        label: "Sample counts",
        help: "The number of points of each pixel: black for none, white for the wanted number.",
        source: Source::Film,
        full_scale: FullScale::Samples,
        colors: &[[0.0; 3], [1.0; 3]],
        labels: |full, _| labels("0", "", &format!("{full:.0} points")),
    },
    Entry {
        overlay: Overlay::Error,
        name: "error",
        label: "Error",
        help: "The estimated error of each pixel, as a fraction of its brightness. Measuring it starts the picture anew.",
        source: Source::Moments,
        full_scale: FullScale::Number(0.1),
        colors: &[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0; 3]],
        labels: |full, _| labels("0", "", &format!("{:.0}% or more", 100.0 * full)),
    },
];

fn labels(left: &str, middle: &str, right: &str) -> [String; 3] {
    [left, middle, right].map(str::to_owned)
}

impl Overlay {
    /// Every overlay, by its name.
    pub const NAMES: [(&'static str, Self); OVERLAYS.len()] = {
        let mut names = [("", Self::Count); OVERLAYS.len()];
        let mut i = 0;
        while i < names.len() {
            names[i] = (OVERLAYS[i].name, OVERLAYS[i].overlay);
            i += 1;
        }
        names
    };

    /// The description of the overlay.
    pub fn entry(self) -> &'static Entry {
        static ENTRIES: &[Entry] = &OVERLAYS;
        ENTRIES.iter().find(|entry| entry.overlay == self).expect("every overlay has an entry: a test looks")
    }

    /// Whether it shows the surface that the middle of each pixel sees.
    pub fn shows_surface(self) -> bool {
        self.entry().source == Source::Surface
    }
}

#[cfg(test)]
mod tests {
    use super::{OVERLAYS, overlay};

    /// Catches an overlay without an entry, which would end the program once it is shown, and one whose name in
    /// scene files is not its name in the shaders.
    #[test]
    fn every_overlay_has_an_entry() {
        let entries =
            OVERLAYS.map(|entry| (entry.name.replace('-', "_").to_uppercase(), entry.overlay as u32));
        for (code, name) in (0..).zip(overlay::NAMES).skip(1) {
            assert!(entries.contains(&((*name).to_owned(), code)), "{name} has no entry");
        }
        assert_eq!(entries.len() + 1, overlay::NAMES.len());
    }
}
