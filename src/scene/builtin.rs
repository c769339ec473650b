//! The scenes that come with the program.

/// A scene that is compiled into the program, in the format of scene files.
#[derive(Debug, Clone, Copy)]
pub struct Builtin {
    /// Its name on the command line.
    pub name: &'static str,
    /// A description in one line.
    pub about: &'static str,
    /// A small picture of it: a PNG of 160 x 100 pixels.
    pub thumbnail: &'static [u8],
    /// The text of the scene file.
    pub toml: &'static str,
}

/// All built-in scenes. The first one is the default.
pub const BUILTINS: [Builtin; 5] = [
    Builtin {
        name: "version-4",
        about: "ten objects on a checkered ground, from near to far: the wider the lens, the fewer are sharp",
        thumbnail: include_bytes!("builtin/version-4.png"),
        toml: include_str!("builtin/version-4.toml"),
    },
    Builtin {
        name: "suffern-boxes",
        about: "three checkered boxes, the middle one in focus (Suffern, figures 10.9 to 10.11)",
        thumbnail: include_bytes!("builtin/suffern-boxes.png"),
        toml: include_str!("builtin/suffern-boxes.toml"),
    },
    Builtin {
        name: "suffern-mirror",
        about: "look into the mirror: its edges are blurred, but its image is sharp where it is as far away as the red wall (Suffern, figure 10.12)",
        thumbnail: include_bytes!("builtin/suffern-mirror.png"),
        toml: include_str!("builtin/suffern-mirror.toml"),
    },
    Builtin {
        name: "passing",
        about: "balls and boxes that pass while the shutter is open: with 1/500 s at ISO 1600, they stand still",
        thumbnail: include_bytes!("builtin/passing.png"),
        toml: include_str!("builtin/passing.toml"),
    },
    Builtin {
        name: "one-weekend",
        about: "spheres of glass, metal and paint under a clear sky (Ray Tracing in One Weekend), by path tracing",
        thumbnail: include_bytes!("builtin/one-weekend.png"),
        toml: include_str!("builtin/one-weekend.toml"),
    },
];
