//! The numbers that the shaders and this program share, each written down once.
//!
//! `build.rs` reads this file too and makes `interface.glsl` of it, which the shaders include. A name that stands
//! here as `binding::FILM_IMAGE` is `BINDING_FILM_IMAGE` in GLSL, and so on: see [`LISTS`] and [`NUMBERS`]. The
//! file therefore uses nothing of the crate.

/// Names that are numbered from zero, in this order.
macro_rules! numbered {
    ($($(#[$doc:meta])* $name:ident,)+) => {
        #[allow(non_camel_case_types, clippy::upper_case_acronyms, reason = "the names are those of constants")]
        enum Place { $($name),+ }
        $($(#[$doc])* pub const $name: u32 = Place::$name as u32;)+
        /// The names, each at the place that is its number.
        pub const NAMES: &[&str] = &[$(stringify!($name)),+];
    };
}

/// The bindings of descriptor set 0. A number means the same resource in every shader.
pub mod binding {
    numbered! {
        /// The tracing image: the mean of each pixel's last batch, and its number of samples.
        TRACED_IMAGE,
        /// The accumulation image: the running mean and count of each pixel.
        FILM_IMAGE,
        /// The picture as it is shown or written.
        PICTURE_IMAGE,
        /// What each pixel's middle sees: the normal of the surface, and in w its depth.
        SURFACE_IMAGE,
        /// The second moments of the tracing image.
        TRACED_MOMENTS,
        /// The second moments of the accumulation image.
        FILM_MOMENTS,
        /// The pixels that are still traced.
        ACTIVE_PIXELS,
        /// The pixels that a selection keeps: the active ones after it.
        KEPT_PIXELS,
        /// The most luminance that rays can meet, for each cell of a grid over the picture.
        BRIGHTEST,
        /// What the trace pass counts.
        COUNTERS,
        /// What the pick pass finds.
        PICKED_RAYS,
        /// The materials.
        MATERIALS,
        /// The lights.
        LIGHTS,
        /// The sky, and what belongs to the scene as a whole.
        ENVIRONMENT,
        /// The nodes and shapes of the tree, then the shapes in the list.
        RECORDS,
        /// The corner normals of the tree's shapes.
        CORNER_NORMALS,
        /// The velocities of the shapes.
        VELOCITIES,
        /// The aperture.
        APERTURE,
        /// The running sums of the aperture's image.
        APERTURE_SUMS,
        /// The arrangement of the blue noise.
        BLUE_NOISE_TILE,
        /// What `tests/probes` read.
        PROBE_INPUTS,
        /// What `tests/probes` write.
        PROBE_OUTPUTS,
    }
}

/// The specialization constants. Those that say yes or no are 1 or 0.
pub mod constant {
    numbered! {
        /// One of [`sampler`](super::sampler).
        SAMPLER,
        /// Whether the film has second moments: an adaptive picture, or one whose error is shown.
        HAS_MOMENTS,
        /// Whether the resolve pass may meet pixels without a sample.
        HAS_HOLES,
        /// Whether an overlay is shown.
        HAS_OVERLAY,
        /// The number of lights.
        LIGHT_COUNT,
        /// The number of lights that cast shadows.
        SHADOW_LIGHT_COUNT,
        /// The number of materials.
        MATERIAL_COUNT,
        /// Whether invocations copy the scene to variables before they start.
        SCENE_IS_KEPT,
        /// The record of the list's first shape.
        LIST_BEGIN,
        /// The kinds of shapes in the scene: a bit for each [`shape`](super::shape).
        SHAPE_KINDS,
        /// The kinds of materials in the scene, likewise.
        MATERIAL_KINDS,
        /// The kinds of textures in the scene.
        TEXTURE_KINDS,
        /// The kinds of lights in their buffer.
        LIGHT_KINDS,
        /// Whether any triangle has normals at its corners.
        HAS_CORNER_NORMALS,
        /// Whether any shape moves.
        SCENE_MOVES,
        /// Whether the device's origin is not the scene's own.
        SCENE_IS_SHIFTED,
        /// The number of nodes on the longest way from the tree's root to a leaf; 0 where there is no tree.
        TREE_DEPTH,
        /// The most steps that a ray may take in the tree.
        MOST_TREE_STEPS,
        /// One of [`aperture`](super::aperture).
        APERTURE,
        /// The end of the list's first kind of shapes. Those of the others follow, so this is the last name.
        SHAPE_END,
    }
}

/// How sample values are made.
pub mod sampler {
    numbered! {
        /// Independent random numbers.
        RANDOM,
        /// The Sobol sequence.
        SOBOL,
        /// The Sobol sequence, arranged so that errors of neighbouring pixels offset each other.
        BLUE_NOISE,
    }
}

/// The kinds of apertures. Each has a file of its name in `shaders/aperture`.
pub mod aperture {
    numbered! {
        /// A disc.
        DISC,
        /// An ellipse.
        ELLIPSE,
        /// An iris of blades.
        BLADES,
        /// A disc that is cut off towards the picture's corners.
        CATS_EYE,
        /// Light comes in where an image is bright.
        IMAGE,
    }
}

/// The kinds of shapes. Each has a file of its name in `shaders/shape`, and the list has them in this order.
pub mod shape {
    numbered! {
        /// A sphere.
        SPHERE,
        /// An axis-aligned box.
        BOX,
        /// A triangle.
        TRIANGLE,
        /// The side of a cylinder.
        CYLINDER,
        /// An infinite plane.
        PLANE,
    }

    /// The first kind without bounds: those before it can be in the tree, and move.
    pub const FIRST_UNBOUNDED: u32 = PLANE;
}

/// The kinds of materials. Each has a file of its name in `shaders/material`.
pub mod material {
    numbered! {
        /// Reflects light evenly into all directions.
        MATTE,
        /// Matte, with a highlight.
        PHONG,
        /// Mirrors.
        MIRROR,
        /// Gives off light.
        EMISSIVE,
    }
}

/// The kinds of textures. Each has a file of its name in `shaders/texture`.
pub mod texture {
    numbered! {
        /// One colour everywhere.
        CONSTANT,
        /// Two colours in cells.
        CHECKER,
    }
}

/// The kinds of lights. Each has a file of its name in `shaders/light`.
pub mod light {
    numbered! {
        /// From a point.
        POINT,
        /// Along parallel lines.
        DIRECTIONAL,
        /// What rays see that meet nothing.
        BACKGROUND,
    }
}

/// The ways to the radiance along a ray. Each has a file of its name in `shaders/integrator`.
pub mod integrator {
    numbered! {
        /// Lights, ambient light, and mirrors.
        WHITTED,
    }
}

/// What can be shown instead of the picture, or on it.
pub mod overlay {
    numbered! {
        /// Nothing.
        NONE,
        /// What is sharp is marked.
        FOCUS_PEAKING,
        /// What lies in the focal plane is marked.
        FOCAL_PLANE,
        /// The circle of confusion.
        CIRCLE_OF_CONFUSION,
        /// The depth along the axis.
        DEPTH,
        /// Which way surfaces face.
        NORMALS,
        /// The number of samples.
        COUNT,
        /// The standard error.
        ERROR,
    }
}

/// Every list above, by what its names begin with in GLSL.
pub const LISTS: &[(&str, &[&str])] = &[
    ("BINDING_", binding::NAMES),
    ("ID_", constant::NAMES),
    ("SAMPLER_", sampler::NAMES),
    ("APERTURE_", aperture::NAMES),
    ("SHAPE_", shape::NAMES),
    ("MATERIAL_", material::NAMES),
    ("TEXTURE_", texture::NAMES),
    ("LIGHT_", light::NAMES),
    ("INTEGRATOR_", integrator::NAMES),
    ("OVERLAY_", overlay::NAMES),
];

/// A number as GLSL has it.
#[derive(Debug, Clone, Copy)]
pub enum Number {
    /// A `uint`.
    U32(u32),
    /// A `float`.
    F32(f32),
    /// A `vec3`.
    Vec3([f32; 3]),
}

/// Single numbers, under one name on both sides.
macro_rules! numbers {
    ($($(#[$doc:meta])* $name:ident: $kind:ident($type:ty) = $value:expr;)+) => {
        $($(#[$doc])* pub const $name: $type = $value;)+
        /// Every single number, by its name.
        pub const NUMBERS: &[(&str, Number)] = &[$((stringify!($name), Number::$kind($name))),+];
    };
}

numbers! {
    /// The distance to what is not there. No hit is as far away.
    MISS: F32(f32) = 1e30;
    /// Width and height of a workgroup of the passes that go over pixels.
    GROUP_SIZE: U32(u32) = 8;
    /// The workgroups in a row of a dispatch over a list of pixels.
    LISTED_ROW_GROUPS: U32(u32) = 128;
    /// The bits of a record's index in the stack of the search through the tree.
    STACK_INDEX_BITS: U32(u32) = 25;
    /// Where the stack is deeper than this, a step goes through the rest of it in a loop.
    SPELLED_OUT_STACK: U32(u32) = 20;
    /// The most blades of an iris.
    MOST_BLADES: U32(u32) = 16;
    /// Of a preview with this stride the traced pixels are [`PREVIEW_SITE`] + [`PREVIEW_STRIDE`] i.
    PREVIEW_STRIDE: U32(u32) = 4;
    /// See [`PREVIEW_STRIDE`].
    PREVIEW_SITE: U32(u32) = 2;
    /// The overlay's colour of what is blurred in front of the focal plane. This and the next three are linear.
    IN_FRONT: Vec3([f32; 3]) = [0.02, 0.22, 1.0];
    /// The overlay's colour of what is blurred behind it.
    BEHIND: Vec3([f32; 3]) = [1.0, 0.2, 0.01];
    /// The overlay's mark of what is sharp.
    MARK: Vec3([f32; 3]) = [0.05, 1.0, 0.1];
    /// The overlay's mark of what lies in the focal plane.
    SLICE: Vec3([f32; 3]) = [1.0, 0.6, 0.0];
}
