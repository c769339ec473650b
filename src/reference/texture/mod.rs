//! Textures, which are the colours of surfaces. Each kind is a file with the name of its shader in `shaders/texture`.

mod checker;
mod constant;

use super::surface::Surface;
use crate::scene::Texture;
use glam::DVec3;

/// The colour at a point of a surface.
pub(super) fn value(texture: &Texture, at: &Surface) -> DVec3 {
    match texture {
        Texture::Constant(of) => constant::value(of),
        Texture::Checker(of) => checker::value(of, at),
    }
}
