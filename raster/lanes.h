#pragma once

#include <cstdint>
#include <cstring>

namespace patchlight::raster {

// Eight samples at once. The compiler's own vectors: whatever the machine has, one AVX register or
// two SSE registers, does the work. Only ever passed to functions that are inlined.
using FloatLanes = float __attribute__((vector_size(32)));
using IntLanes = std::int32_t __attribute__((vector_size(32)));  // as a mask: 0 or -1

[[gnu::always_inline]] inline bool any(const IntLanes& mask) {
    std::int64_t parts[4];
    std::memcpy(parts, &mask, sizeof parts);
    return (parts[0] | parts[1] | parts[2] | parts[3]) != 0;
}

[[gnu::always_inline]] inline FloatLanes clamp(const FloatLanes& value, float low, float high) {
    const FloatLanes lows = low - FloatLanes{};
    const FloatLanes highs = high - FloatLanes{};
    const FloatLanes raised = value > lows ? value : lows;
    return raised < highs ? raised : highs;
}

}  // namespace patchlight::raster

// Compiles a function twice, for any x86-64 and for those with AVX2, and picks at start-up.
// Sanitizers run before the pick can be made.
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && __GNUC__ >= 12 && \
    !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define PATCHLIGHT_FOR_EACH_ISA __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define PATCHLIGHT_FOR_EACH_ISA
#endif
