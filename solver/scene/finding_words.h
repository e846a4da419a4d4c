#pragma once

#include "solver/scene/light.h"

#include <string>

namespace patchlight {

/// "0.0035 m", "2.5 m", three digits.
std::string length_text(double metres);
/// "(1.2, 0, 3.05) m", rounded to a thousandth of what `size` is of the order of.
std::string place_text(const Vec3& p, double size);
/// "3.2 %", two digits.
std::string share_text(double share);
/// Three digits.
std::string number_text(double number);
/// In single quotes.
std::string quoted(const std::string& name);

}  // namespace patchlight
