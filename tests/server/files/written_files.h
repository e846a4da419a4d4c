#pragma once

#include "server/files/imported_geometry.h"
#include "server/job.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace patchlight::server {

/// Writes a geometry file and reads it. Its name says which format it is.
ImportedGeometry read_written(const std::string& name, const std::string& bytes);

/// Expects that it is refused: the place and what is wrong, joined by ": ", begin with the name of
/// the file and hold `words`.
void expect_file_rejected(const std::string& name, const std::string& bytes,
                          const std::string& words);

/// A scene whose one object "thing" is the file, with more members such as R"("material": "a")" and
/// more blocks such as R"("materials": {})", as if it lay beside the files written here.
Job scene_of_file(const std::string& name, const std::string& members = "",
                  const std::string& blocks = "");

/// Reads a scene that lies beside the files written here.
Job read_beside(const std::string& scene);

/// The findings of one kind.
std::vector<Finding> findings_of(const Scene& scene, const std::string& kind);

/// Bytes as the memory holds them.
template <typename Number>
std::string bytes_of(std::initializer_list<Number> numbers) {
    return {reinterpret_cast<const char*>(numbers.begin()), numbers.size() * sizeof(Number)};
}

}  // namespace patchlight::server
