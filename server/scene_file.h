#pragma once

#include "server/job.h"

#include <string>

namespace patchlight::server {

/// Reads the scene of a file, or of standard input if the path is "-". A geometry file is a scene
/// of one object, named after it. Throws WrongInput.
Job read_scene_file(const std::string& path);

/// How messages call it.
std::string shown_path(const std::string& path);

}  // namespace patchlight::server
