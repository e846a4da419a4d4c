#pragma once

#include <cstddef>

// The way into the image module: C types only, because it is loaded while the program runs.
extern "C" {

enum PatchlightImageFormat { patchlight_png = 1, patchlight_exr = 2 };

/// Three channels, top row first.
struct PatchlightImageRequest {
    PatchlightImageFormat format;
    int width;
    int height;
    const void* pixels;  // png: unsigned char, exr: float
    void (*take_bytes)(void* taker, const unsigned char* bytes, std::size_t count);
    void (*take_problem)(void* taker, const char* text);
    void* taker;  // handed to both
};

/// Calls take_bytes with the whole file and returns 0, or take_problem and returns another number.
using PatchlightEncodeImage = int (*)(const PatchlightImageRequest*);
}

/// Name of that function in the module; the number changes whenever the request does.
inline constexpr const char* patchlight_encode_image_name = "patchlight_encode_image_1";
