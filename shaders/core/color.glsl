// Colours: their luminance, and how linear radiance is encoded for files and screens.

#ifndef COLOR_GLSL
#define COLOR_GLSL

// The luminance of a linear colour with the primaries of Rec. 709.
float luminance(const vec3 color) {
    return dot(color, vec3(0.2126, 0.7152, 0.0722));
}

// The sRGB encoding of linear values, clipped to [0, 1]: IEC 61966-2-1.
vec3 srgb_encode(const vec3 linear) {
    vec3 clipped = clamp(linear, 0.0, 1.0);
    vec3 curve = 1.055 * pow(clipped, vec3(1.0 / 2.4)) - 0.055;
    return mix(curve, 12.92 * clipped, lessThanEqual(clipped, vec3(0.0031308)));
}

#endif
