#pragma once

#include <cstdint>

namespace patchlight::server {

// Numbers put into text where there is room for `longest_number` characters; each returns its end.

inline constexpr int longest_number = 24;

/// The shortest text that reads back as the same float.
char* put_float(char* place, float number);

char* put_index(char* place, std::uint32_t number);

/// Three significant digits, such as 1.23e-05: all that an estimate has to say, and three times as
/// quick. 0 is "0"; what is not finite is the caller's to leave out. `number` >= 0.
char* put_estimate(char* place, double number);

}  // namespace patchlight::server
