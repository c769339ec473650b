//! A Vulkan compute ray tracer for thin-lens depth of field. This page is its architecture.
//!
//! # The way of the data
//!
//! ```text
//! cli / app (options, sliders) -> Settings -> Scene -> GPU structs -> Renderer
//!   -> trace.comp -> accumulate.comp -> resolve.comp -> output::file | window
//! ```
//!
//! The data goes one way, and so do the imports: `tests/house.rs` says which module may use which, and that no two
//! files of a module use each other. A few pixels through all of it:
//!
//! ```
//! use thinlens::renderer::Renderer;
//! use thinlens::scene::{self, SceneRef};
//! use thinlens::settings::Settings;
//! use thinlens::vulkan::{Device, Instance};
//!
//! # fn main() -> thinlens::error::Result<()> {
//! let mut settings = Settings::of_scene(SceneRef::new(scene::load("version-4")?));
//! settings.estimator.size = [4, 3];
//! settings.samples = 16;
//!
//! let device = Device::open(&Instance::new(false, None)?, None, None)?;
//! let mut renderer = Renderer::new(&device, &settings)?;
//! renderer.render(|_| ())?;
//!
//! let film = renderer.read_film()?; // the mean red, green and blue, and the number of samples of each pixel
//! assert_eq!(film.len(), 12);
//! assert!(film.iter().all(|[.., count]| *count == 16.0));
//! # Ok(())
//! # }
//! ```
//!
//! # The passes
//!
//! Each is a shader of its name in `shaders/` and a file in [`passes`].
//!
//! - **trace** takes a batch of up to 64 samples of each pixel. A sample is a point of the film, a point of the lens
//!   and, where something moves, a time: a scrambled Sobol point, which follows from the seed, the pixel and the
//!   sample's index alone. All pixels share one sequence. Each xors its points with a mask of its own, and the masks
//!   lie in a tile of 128 x 128 so that neighbours err in opposite directions. Lens points come evenly from all over
//!   the aperture, by maps that throw none away. The camera is in `shaders/camera/thin_lens.glsl`; a hole without a
//!   lens is the same equation with the film's distance, negative, for the focal distance. One texel a pixel comes out:
//!   the mean of the batch, and how many samples it has.
//! - **accumulate** merges that texel into the film. It gathers from the neighbours that a wide jitter can reach, so the
//!   result does not depend on the order of execution. In an adaptive picture it also merges the second moment of the
//!   luminance.
//! - **select** lists the pixels of an adaptive picture that need more samples: those whose error is still too large,
//!   and those that may have missed something bright.
//! - **resolve** turns the film into a picture: exposure, sRGB, and the overlays.
//! - **pick** finds what lies under one place of the picture, and **geometry** what the middle of each
//!   pixel sees.
//!
//! # The modules
//!
//! - [`cli`] is the command line, [`app`] the window, [`output`] writes files, and [`bench`](mod@bench) measures.
//! - [`diagram`] draws the optics of one pixel. The viewer shows the drawing, and the command line saves it.
//! - [`settings`] has two halves. A change of the [`settings::Estimator`] starts the film anew, a change of the
//!   [`scene::View`] does not.
//! - [`scene`] holds plain values and reads them from TOML and OBJ files.
//! - [`interface`] has the numbers that shaders and program share: `build.rs` makes GLSL of it. [`gpu_types`] has the
//!   byte-for-byte twins of the shaders' structs, and makes them of a scene.
//! - [`renderer`] owns the film and the passes, and decides what is traced next. The time of a submission is bounded,
//!   which never changes the picture: [`renderer::schedule`].
//! - [`reference`](mod@reference) is the oracle: the renderer again, in f64 on the CPU. It shares no code with the
//!   device's side. [`verify`] and the tests compare the device with it.
//! - [`vulkan`] wraps the driver and is the only unsafe code. It knows no scenes.
//! - [`error`] has every error that a user can meet. [`pending_file`] writes files that appear whole or not at all,
//!   `input_file` reads what others made, and [`interrupt`] leaves nothing behind when a signal ends the program.
//!
//! CONTRIBUTING.md lists the files to touch to add a shape, a setting or an overlay.
//!
//! The optics are those of K. Suffern, *Ray Tracing from the Ground Up*, chapter 10: a centre ray finds the point in
//! focus, and primary rays from points all over the lens go through that point.

pub mod app;
pub mod bench;
pub mod cli;
pub mod diagram;
pub mod error;
pub mod gpu_types;
mod input_file;
pub mod interface;
pub mod interrupt;
pub mod output;
pub mod passes;
pub mod pending_file;
pub mod reference;
pub mod renderer;
pub mod scene;
pub mod settings;
pub mod verify;
pub mod vulkan;
