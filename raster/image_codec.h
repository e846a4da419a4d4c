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

/// A picture file in memory, whose mean colour is wanted.
struct PatchlightMeanRequest {
    const void* bytes;
    std::size_t count;
    int by_opacity;  // pixels count as much as they are opaque
    void (*take_mean)(void* taker, const double* linear_rgb);
    void (*take_problem)(void* taker, const char* text);
    void* taker;  // handed to both
};

/// Calls take_mean with three channels of linear light and returns 0, or take_problem and returns
/// another number.
using PatchlightMeanColour = int (*)(const PatchlightMeanRequest*);
}

/// Names of these functions in the module; a number changes whenever its request does.
inline constexpr const char* patchlight_encode_image_name = "patchlight_encode_image_1";
inline constexpr const char* patchlight_mean_colour_name = "patchlight_mean_colour_1";
