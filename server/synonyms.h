#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace patchlight::server {

/// The one of `known` that other programs call `asked`, as they say albedo for reflectance; null if
/// there is none. `asked` is in small letters, with _ between words.
const std::string* synonym_of(std::string_view asked, const std::vector<std::string>& known);

}  // namespace patchlight::server
