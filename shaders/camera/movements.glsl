// The movements of a view camera: the lens is shifted, or tilted.

#ifndef MOVEMENTS_GLSL
#define MOVEMENTS_GLSL

#include "interface.glsl"

layout(constant_id = ID_HAS_MOVEMENTS) const uint HAS_MOVEMENTS = 0u;

#endif
