//! Radiance along a ray: a file a way, with the name of its shader in `shaders/integrator`.

pub mod whitted;
