#pragma once

#include "raster/image_codec.h"

namespace patchlight::raster {

// OpenImageIO takes a quarter of a second and 130 MB to load, so it is linked by a module of its
// own, patchlight_image.so, that is loaded when a picture is to be encoded or read. It is the file
// named by the environment variable PATCHLIGHT_IMAGE_MODULE; if that is not set, the first of
// patchlight_image.so beside the program, in ../lib/patchlight from there, where it was installed,
// where it was built.

/// Starts loading the module behind the caller's back, so that it costs no time later. Never
/// throws; what went wrong is thrown by image_encoder. The calling thread waits for it when it
/// ends, so call it from the thread that returns from main or calls std::exit: a program that is
/// torn down by one thread while another loads libraries crashes. Call it after forking: the
/// libraries start threads.
void preload_image_codec();

/// The module's functions, loaded now or waited for. They throw std::runtime_error naming the files
/// tried if there is none.
PatchlightEncodeImage image_encoder();
PatchlightMeanColour image_averager();

}  // namespace patchlight::raster
