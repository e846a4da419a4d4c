#pragma once

#include <string>
#include <vector>

namespace patchlight::stability {

/// A known way for radiosity methods to fail.
struct FailureMode {
    std::string id;
    std::string what;
};

const std::vector<FailureMode>& catalogue();

}  // namespace patchlight::stability
