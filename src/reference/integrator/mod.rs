//! The integrators, which find the radiance along a ray. Each is a file with the name of its shader in
//! `shaders/integrator`.

pub mod whitted;
