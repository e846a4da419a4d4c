#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace patchlight::walls {

/// A line `#include "path"` or `#include <path>`.
struct Include {
    int line = 0;
    bool quoted = false;
    std::string path;
};
std::vector<Include> includes_in(std::string_view source);

/// One sentence for each include that crosses a wall; empty if all is well. `file` is the path of
/// the source from the root, such as "solver/mesh/welder.cpp".
std::vector<std::string> crossings(std::string_view file, std::string_view source);

/// Every .h and .cpp file of raster/, solver/ and server/, from the root, sorted.
std::vector<std::string> sources_below(const std::filesystem::path& root);

/// Names of the functions that stand in anonymous namespaces of a source, laid out as clang-format
/// leaves it.
std::vector<std::string> hidden_functions(std::string_view source);

}  // namespace patchlight::walls
