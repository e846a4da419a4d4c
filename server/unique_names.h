#pragma once

#include "server/json_value.h"

#include <cstddef>
#include <string>
#include <unordered_set>

namespace patchlight::server {

/// What number `k` of a list is called if it has no name of its own: "#k".
std::string name_of_unnamed(std::size_t k);

/// Names that may be taken once.
class UniqueNames {
  public:
    /// Throws InputError at `place` if the name is taken.
    void claim(const std::string& name, const JsonValue& place);

  private:
    std::unordered_set<std::string> taken_;
};

}  // namespace patchlight::server
