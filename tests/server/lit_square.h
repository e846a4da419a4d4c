#pragma once

#include <string>

namespace patchlight::server {

/// A scene of a white square metre under a lamp as large, 1 m above, with `changes` merged into it
/// (RFC 7396): R"({"solve": {"rays": 0}})".
std::string lit_square(const std::string& changes = "{}");

/// The lamp, and below it a white object with these members: R"("polygon": [])".
std::string lit_object(const std::string& members);

}  // namespace patchlight::server
