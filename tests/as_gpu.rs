//! Tests that run once more on a device that is used as GPUs are: the scene is not copied to variables, and neither
//! loops nor rays are cut short.
#![allow(clippy::duplicate_mod, reason = "each test file declares what the tests share")]

#[path = "adaptive.rs"]
mod adaptive;
#[path = "agreement.rs"]
mod agreement;
#[path = "colors.rs"]
mod colors;
#[path = "film.rs"]
mod film;
#[path = "keys.rs"]
mod keys;
#[path = "mesh_picture.rs"]
mod mesh_picture;
#[path = "motion.rs"]
mod motion;
#[path = "movements.rs"]
mod movements;
#[path = "surfaces.rs"]
mod surfaces;
