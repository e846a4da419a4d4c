#pragma once

#include <string>

namespace patchlight::server {

/// A closed box of 2 m with a lamp below its ceiling, in which light goes about; one camera and one
/// sensor. Solved in milliseconds.
extern const std::string small_box;

/// Writes it where the program is run (see run_program.h) and returns its name.
std::string small_box_file();

}  // namespace patchlight::server
