//! A Vulkan compute ray tracer for thin-lens depth of field.
//!
//! The data goes one way:
//!
//! ```text
//! cli / app (flags, sliders) -> Settings -> Scene -> GPU twins -> Renderer
//!   -> trace.comp -> accumulate.comp -> resolve.comp -> output::file | window
//! ```
//!
//! - [`settings`] has two halves. A change of the [`settings::Estimator`] starts the film anew, a
//!   change of the [`scene::View`] does not.
//! - [`scene`] holds plain values and reads them from TOML and OBJ.
//! - [`interface`] has the numbers that both sides share, and [`gpu_types`] the byte-for-byte twins of the
//!   shaders' structs.
//! - [`passes`] are the compute passes, each with the shader of its name in `shaders/`.
//! - [`renderer`] owns film and passes and decides what is traced next.
//! - [`output`] writes files, [`app`] is the window, [`cli`] the command line.
//! - [`bench`](mod@bench) measures what it costs to render, and what comes of it.
//! - [`reference`](mod@reference) is the renderer again, in f64 on the CPU: the oracle that [`verify`] and the
//!   tests hold the device against. It shares no code with the device's side.
//! - [`vulkan`] wraps the driver and is the only unsafe code.
//! - [`pending_file`] writes files that appear whole or not at all, `input_file` reads what others made, and
//!   [`interrupt`] leaves nothing behind when a signal ends the program.
//!
//! The optics are those of K. Suffern, *Ray Tracing from the Ground Up*, chapter 10: a centre ray
//! finds the point in focus, a primary ray from a point of the lens goes through it. See
//! `shaders/camera/thin_lens.glsl`.

pub mod app;
pub mod bench;
pub mod cli;
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
