#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

// Pass 1 with the integrator "path": see core/trace_pass.glsl.

#include "integrator/path.glsl"
#include "core/trace_pass.glsl"
