// What ends paths: packed into one number, because Vulkan promises room for only 128 bytes of push constants.

#ifndef LIMITS_GLSL
#define LIMITS_GLSL

// How often light is scattered on its way to the lens.
uint most_bounces(const uint limits) {
    return limits & 0xffu;
}

// How often it is scattered by surfaces that spread it.
uint most_diffuse_bounces(const uint limits) {
    return limits >> 8u & 0xffu;
}

// The most luminance of what a path finds after its first surface; 0 for no limit.
float most_indirect(const uint limits) {
    return unpackHalf2x16(limits).y;
}

#endif
