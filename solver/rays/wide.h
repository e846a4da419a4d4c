#pragma once

/// Functions marked PATCHLIGHT_WIDE are compiled for AVX-512, AVX2 and the baseline; the loader
/// picks. Not under sanitizers, which do not follow the loader's choice.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define PATCHLIGHT_WIDE \
    __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define PATCHLIGHT_WIDE
#endif
