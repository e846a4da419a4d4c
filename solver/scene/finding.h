#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace patchlight {

/// Something about the scene its author should know: `kind` is one of the fixed names
/// ("coplanar-overlap", "non-planar", "degenerate-dropped", "no-emitter", ...).
struct Finding {
    std::string kind;
    std::vector<std::string> objects;  // names of the objects concerned
    std::string detail;                // what and where
    std::string remedy;                // what would put it right
    std::size_t count = 1;             // how often it was met
};

}  // namespace patchlight
