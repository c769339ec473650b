// The Sobol sequence in four dimensions, Owen-scrambled.

#ifndef SOBOL_GLSL
#define SOBOL_GLSL

// Flips each bit or not, as a hash of the key and the bits below it decides. For bits in reverse order this is an Owen
// scramble. S. Laine and T. Karras, "Stratified Sampling for Stochastic
// Transparency", EGSR 2011, with the constants of N. Vegdahl, "Building a Better LK Hash", 2021.
uvec4 scramble_upwards(uvec4 bits, const uvec4 key) {
    bits ^= bits * 0x3d20adeau;
    bits += key;
    bits *= (key >> 16u) | 1u;
    bits ^= bits * 0x05526c56u;
    bits ^= bits * 0x53a22864u;
    return bits;
}

// The Sobol sequence's second dimension with its bits in reverse: bit i of the result is the sum,
// modulo two, of the bits j >= i of the index for which the binomial of j over i is odd.
uint sobol_second_reversed(uint index) {
    index ^= (index >> 1u) & 0x55555555u;
    index ^= (index >> 2u) & 0x33333333u;
    index ^= (index >> 4u) & 0x0f0f0f0fu;
    index ^= (index >> 8u) & 0x00ff00ffu;
    index ^= index >> 16u;
    return index;
}

// The direction numbers of the Sobol sequence's third and fourth dimension, bits in reverse, for the 24 bits of an
// index. The polynomials and initial numbers are those of S. Joe and F. Kuo, "Constructing Sobol Sequences with Better
// Two-dimensional Projections", SIAM J. Sci. Comput. 30(5), 2008, except that the fourth dimension has the initial
// numbers 1, 1, 3. With these, the first eight points of the two dimensions are a net too.
const uvec2 SOBOL_THIRD_AND_FOURTH_REVERSED[24] = uvec2[24](
    uvec2(0x000001u, 0x000001u), uvec2(0x000003u, 0x000002u), uvec2(0x000006u, 0x000006u),
    uvec2(0x000009u, 0x00000bu), uvec2(0x000017u, 0x000014u), uvec2(0x00003au, 0x00003du),
    uvec2(0x000071u, 0x000047u), uvec2(0x0000a3u, 0x000089u), uvec2(0x000116u, 0x000192u),
    uvec2(0x000339u, 0x0002f6u), uvec2(0x000677u, 0x000553u), uvec2(0x0009aau, 0x000ff4u),
    uvec2(0x001601u, 0x001015u), uvec2(0x003903u, 0x00203fu), uvec2(0x007706u, 0x006041u),
    uvec2(0x00aa09u, 0x00b082u), uvec2(0x010117u, 0x014186u), uvec2(0x03033au, 0x03d2cbu),
    uvec2(0x060671u, 0x047514u), uvec2(0x0909a3u, 0x089f7du), uvec2(0x171616u, 0x193187u),
    uvec2(0x3a3939u, 0x2f42c9u), uvec2(0x717777u, 0x555512u), uvec2(0xa3aaaau, 0xffff76u)
);

uvec2 sobol_third_and_fourth_reversed(const uint index) {
    uvec2 sum = uvec2(0u);
    for (uint bit = 0u; bit < 24u; ++bit) {
        sum ^= SOBOL_THIRD_AND_FOURTH_REVERSED[bit] & uvec2(-int(index >> bit & 1u));
    }
    return sum;
}

// The first four dimensions of the Sobol sequence, each Owen-scrambled with its own key: B. Burley, "Practical
// Hash-based Owen Scrambling", JCGT 9(4), 2020. The first dimension with its bits in reverse is the index. Film and
// lens take one point of four dimensions instead of two padded pairs, because a blurred edge depends on both at once.
// The lens takes the first two dimensions, whose points are the best distributed pair.
uvec4 sobol_film_and_lens(const uint index, const uvec4 keys) {
    uvec4 reversed = uvec4(sobol_third_and_fourth_reversed(index), index, sobol_second_reversed(index));
    return bitfieldReverse(scramble_upwards(reversed, keys));
}

#endif
