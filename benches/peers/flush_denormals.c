/* To be preloaded (LD_PRELOAD): makes a program take denormal numbers for zero. It sets flush-to-zero (bit 15) and
 * denormals-are-zero (bit 6) of the SSE control register before main() begins, and the threads that are started later
 * inherit both. x86 only. */
#include <immintrin.h>

__attribute__((constructor)) static void flush_denormals(void)
{
    _mm_setcsr(_mm_getcsr() | 1u << 15 | 1u << 6);
}
