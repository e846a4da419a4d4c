#pragma once

#include "server/definitions.h"
#include "server/file_objects.h"
#include "server/json_value.h"

#include <cstddef>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace patchlight::server {

/// How many polygons objects have, known before any is made: definitions inside definitions can
/// ask for more than any memory holds in a few lines. Reads the geometry files that are named.
class PolygonCount {
  public:
    PolygonCount(const Definitions& definitions, FileObjects& files)
        : definitions_(definitions), files_(files) {}

    /// Of an object or the body of a definition; at most `too_many`. Throws InputError if a
    /// definition is not there or contains itself, or a file cannot be read.
    std::size_t of(const JsonValue& body);

    static constexpr std::size_t most = 4'000'000;  // in one scene
    static constexpr std::size_t too_many = most + 1;

  private:
    std::size_t of_instance(const JsonValue& instance);
    std::size_t of_definition(const JsonValue& instance);

    const Definitions& definitions_;
    FileObjects& files_;
    std::unordered_map<std::string, std::size_t> known_;  // by name of the definition
    std::unordered_map<std::string, InputError> wrong_;   // what is wrong with it
    std::unordered_set<std::string> open_;                // those that are being counted
};

}  // namespace patchlight::server
