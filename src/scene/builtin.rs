//! The scenes that come with the program.

/// A scene that is compiled into the program, in the format of scene files.
#[derive(Debug, Clone, Copy)]
pub struct Builtin {
    /// Its name on the command line.
    pub name: &'static str,
    /// A description in one line.
    pub about: &'static str,
    /// The text of the scene file.
    pub toml: &'static str,
}

/// All built-in scenes. The first one is the default.
pub const BUILTINS: [Builtin; 4] = [
    Builtin {
        name: "version-4",
        about: "ten objects on a checkered ground, from near to far along a diagonal",
        toml: include_str!("builtin/version-4.toml"),
    },
    Builtin {
        name: "suffern-boxes",
        about: "three checkered boxes, the middle one in focus (Suffern, figures 10.9 to 10.11)",
        toml: include_str!("builtin/suffern-boxes.toml"),
    },
    Builtin {
        name: "suffern-mirror",
        about: "a mirror box, whose images have their own depth (Suffern, figure 10.12)",
        toml: include_str!("builtin/suffern-mirror.toml"),
    },
    Builtin {
        name: "passing",
        about: "balls and boxes that pass while the shutter is open: try --shutter 1/500 --iso 1600",
        toml: include_str!("builtin/passing.toml"),
    },
];
