#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace patchlight::server {

// The words messages are made of.

/// 'text' in quotes, shortened to about 60 bytes, control characters shown as '?'.
std::string in_quotes(std::string_view text);

/// The shortest decimal text that reads back as `number`, such as 0.1.
std::string number_text(double number);

/// "; did you mean 'x'?" if one of `known` is near to `asked`, else "; known here: a, b, c" (at
/// most 20 of them), else nothing.
std::string suggestion(std::string_view asked, const std::vector<std::string>& known);

}  // namespace patchlight::server
