//! The numbers that the shaders and this program share, each written down once.
//!
//! `build.rs` reads this file too and generates `interface.glsl` from it, which the shaders include. The constant
//! `binding::FILM_IMAGE` is called `BINDING_FILM_IMAGE` in GLSL, and so on: see [`LISTS`] and [`NUMBERS`]. Because
//! the build script compiles this file, it uses no other part of the crate.

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
        /// The surface that each pixel's centre sees: its normal, and in w its depth.
        SURFACE_IMAGE,
        /// The second moments of the tracing image.
        TRACED_MOMENTS,
        /// The second moments of the accumulation image.
        FILM_MOMENTS,
        /// The pixels that are still traced.
        ACTIVE_PIXELS,
        /// The pixels that a selection keeps, which are the active pixels from then on.
        KEPT_PIXELS,
        /// An upper bound of the luminance that rays can meet, for each cell of a grid over the picture.
        BRIGHTEST,
        /// The counters of the trace pass.
        COUNTERS,
        /// The rays of the pick pass, and where they end.
        PICKED_RAYS,
        /// The materials.
        MATERIALS,
        /// The lights.
        LIGHTS,
        /// The shapes that emit light.
        LAMPS,
        /// The texels of images.
        IMAGE_TEXELS,
        /// How probably a direction is chosen from each texel of the sky's image.
        SKY_CHANCES,
        /// What rays need of the scene wherever they are: the sky, the numbers of things, and all lights and listed shapes
        /// of a small scene.
        SCENE,
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
        /// The tile of numbers that arranges the blue noise.
        BLUE_NOISE_TILE,
        /// The table of what rough surfaces reflect.
        FACET_ALBEDO,
        /// The inputs of the shaders in `tests/probes`.
        PROBE_INPUTS,
        /// The outputs of the shaders in `tests/probes`.
        PROBE_OUTPUTS,
    }
}

/// The specialization constants. A constant that answers a yes-or-no question is 1 for yes and 0 for no.
pub mod constant {
    numbered! {
        /// The sampler: one of [`sampler`](super::sampler).
        SAMPLER,
        /// Whether the film has second moments. It does if the picture is adaptive or its error is shown.
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
        /// Where lights and listed shapes are read from: one of [`scene_in`](super::scene_in).
        SCENE_PLACE,
        /// The record of the list's first shape.
        LIST_BEGIN,
        /// The kinds of shapes in the scene: a bit for each [`shape`](super::shape).
        SHAPE_KINDS,
        /// The kinds of materials in the scene: a bit for each [`material`](super::material).
        MATERIAL_KINDS,
        /// The kinds of textures in the scene: a bit for each [`texture`](super::texture).
        TEXTURE_KINDS,
        /// The kinds of lights in the buffer of lights: a bit for each [`light`](super::light).
        LIGHT_KINDS,
        /// Whether any bounded shape emits light.
        HAS_LAMPS,
        /// Whether the sky is an image.
        HAS_PANORAMA,
        /// Whether any triangle has normals at its corners.
        HAS_CORNER_NORMALS,
        /// Whether any shape moves.
        SCENE_MOVES,
        /// Whether the device's origin is not the scene's own.
        SCENE_IS_SHIFTED,
        /// The number of nodes on the longest path from the tree's root to a leaf; 0 where there is no tree.
        TREE_DEPTH,
        /// The most steps that a ray may take in the tree.
        MAX_TREE_STEPS,
        /// The kind of aperture: one of [`aperture`](super::aperture).
        APERTURE,
        /// Whether the lens is shifted or tilted.
        HAS_MOVEMENTS,
        /// Whether the light is not even over the aperture.
        HAS_PROFILE,
        /// Whether the focal length depends on the colour of the light.
        HAS_DISPERSION,
        /// Where the range of the first kind of shapes ends in the list. The constants of the other kinds have the
        /// numbers after this one, so this must be the last name.
        SHAPE_END,
    }
}

/// The samplers, which generate sample values.
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

/// Where invocations read the lights, the listed shapes and their numbers from.
pub mod scene_in {
    numbered! {
        /// From buffers of any size. This is for scenes that are not small: see [`SMALL_SCENE`](super::SMALL_SCENE).
        BUFFERS,
        /// From a uniform buffer. The numbers are constants.
        UNIFORMS,
        /// From variables, to which each invocation copies them and the materials before it starts. The numbers are
        /// constants.
        VARIABLES,
    }
}

/// The kinds of apertures. Each kind has a file with its name in `shaders/aperture`.
pub mod aperture {
    numbered! {
        /// A disc.
        DISC,
        /// An ellipse.
        ELLIPSE,
        /// An iris of blades.
        BLADES,
        /// A disc that the front rim of the lens cuts off, the more the nearer to the picture's corners.
        CATS_EYE,
        /// An image: light comes in where it is bright.
        IMAGE,
    }
}

/// The kinds of shapes. Each kind has a file with its name in `shaders/shape`, and the list is sorted in this order.
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
        /// A rectangle.
        RECTANGLE,
        /// A flat disc.
        DISC,
        /// An infinite plane.
        PLANE,
    }

    /// The first unbounded kind. Shapes of the kinds before it can be in the tree, and can move.
    pub const FIRST_UNBOUNDED: u32 = PLANE;
}

/// The kinds of materials. Each kind has a file with its name in `shaders/material`.
pub mod material {
    numbered! {
        /// A surface that reflects light evenly into all directions.
        MATTE,
        /// A matte surface with a highlight.
        PHONG,
        /// A mirror.
        MIRROR,
        /// A surface that emits light.
        EMISSIVE,
        /// A metal, smooth or rough.
        METAL,
        /// A clear body, smooth or frosted.
        GLASS,
        /// A clear coat over a matte base.
        PLASTIC,
        /// The material of models: a mixture of a metal and of a coat over a matte base.
        STANDARD,
    }
}

/// The kinds of textures. Each kind has a file with its name in `shaders/texture`.
pub mod texture {
    numbered! {
        /// One colour everywhere.
        CONSTANT,
        /// Two colours that alternate between the cells of a grid.
        CHECKER,
    }
}

/// The kinds of lights. Each kind has a file with its name in `shaders/light`.
pub mod light {
    numbered! {
        /// Light from a point.
        POINT,
        /// Light along parallel lines.
        DIRECTIONAL,
        /// The sky, which rays see that meet no surface.
        BACKGROUND,
    }
}

/// The integrators, which find the radiance along a ray. Each has a file with its name in `shaders/integrator`.
pub mod integrator {
    numbered! {
        /// Whitted's integrator: direct light with hard shadows, ambient light, and mirrors.
        WHITTED,
        /// Path tracing: light that arrives by any number of reflections.
        PATH,
    }
}

/// The overlays, which are shown instead of the picture or drawn on it.
pub mod overlay {
    numbered! {
        /// Nothing.
        NONE,
        /// A mark on everything that is sharp.
        FOCUS_PEAKING,
        /// A mark on everything that lies in the focal plane.
        FOCAL_PLANE,
        /// The circle of confusion.
        CIRCLE_OF_CONFUSION,
        /// The depth along the axis.
        DEPTH,
        /// The normals of the surfaces.
        NORMALS,
        /// The number of samples of each pixel.
        COUNT,
        /// The standard error of each pixel's mean.
        ERROR,
    }
}

/// Every list above, with the prefix of its names in GLSL.
pub const LISTS: &[(&str, &[&str])] = &[
    ("BINDING_", binding::NAMES),
    ("ID_", constant::NAMES),
    ("SAMPLER_", sampler::NAMES),
    ("SCENE_IN_", scene_in::NAMES),
    ("APERTURE_", aperture::NAMES),
    ("SHAPE_", shape::NAMES),
    ("MATERIAL_", material::NAMES),
    ("TEXTURE_", texture::NAMES),
    ("LIGHT_", light::NAMES),
    ("INTEGRATOR_", integrator::NAMES),
    ("OVERLAY_", overlay::NAMES),
];

/// A number with its type in GLSL.
#[derive(Debug, Clone, Copy)]
pub enum Number {
    /// A `uint`.
    U32(u32),
    /// A `float`.
    F32(f32),
    /// A `vec3`.
    Vec3([f32; 3]),
}

/// Single numbers. Each has the same name in Rust and in GLSL.
macro_rules! numbers {
    ($($(#[$doc:meta])* $name:ident: $kind:ident($type:ty) = $value:expr;)+) => {
        $($(#[$doc])* pub const $name: $type = $value;)+
        /// Every single number, by its name.
        pub const NUMBERS: &[(&str, Number)] = &[$((stringify!($name), Number::$kind($name))),+];
    };
}

numbers! {
    /// The distance of a ray that meets nothing. No hit is as far away.
    MISS: F32(f32) = 1e30;
    /// Width and height of a workgroup, in the passes that have an invocation for each pixel.
    GROUP_SIZE: U32(u32) = 8;
    /// The number of workgroups in a row of a dispatch over a list of pixels.
    LISTED_ROW_GROUPS: U32(u32) = 128;
    /// The number of bits that the stack of the search through the tree has for a record's index.
    STACK_INDEX_BITS: U32(u32) = 25;
    /// The shifts of this many entries of the stack are spelled out. A loop shifts the entries below them.
    SPELLED_OUT_STACK: U32(u32) = 20;
    /// A scene is small if it has at most so many listed shapes, lights and materials.
    SMALL_SCENE: U32(u32) = 64;
    /// The most blades of an iris.
    MAX_BLADES: U32(u32) = 16;
    /// The coarsest preview traces the pixels [`PREVIEW_SITE`] + [`PREVIEW_STRIDE`] i.
    PREVIEW_STRIDE: U32(u32) = 4;
    /// Where the traced pixel lies in its cell of the preview: see [`PREVIEW_STRIDE`].
    PREVIEW_SITE: U32(u32) = 2;
    /// By how much stronger a lens bends light of 610, 550 and 465 nm than it bends light of 550 nm, multiplied by the Abbe
    /// number of its glass: `(1 / l^2 - 1 / 550^2) / (1 / 486.1^2 - 1 / 656.3^2)` for the wavelength `l`, by Cauchy's formula.
    DISPERSION: Vec3([f32; 3]) = [-0.323_67, 0.0, 0.690_45];
    /// The overlay's colour of everything that is blurred in front of the focal plane, in linear light.
    IN_FRONT: Vec3([f32; 3]) = [0.02, 0.22, 1.0];
    /// The overlay's colour of everything that is blurred behind the focal plane, in linear light.
    BEHIND: Vec3([f32; 3]) = [1.0, 0.2, 0.01];
    /// The colour of focus peaking, which marks everything that is sharp, in linear light.
    MARK: Vec3([f32; 3]) = [0.05, 1.0, 0.1];
    /// The colour that marks everything that lies in the focal plane, in linear light.
    SLICE: Vec3([f32; 3]) = [1.0, 0.6, 0.0];
}
