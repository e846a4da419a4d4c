#pragma once

#include "server/files/imported_geometry.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_map>

namespace patchlight::server {

/// The materials that an OBJ file names, defined in MTL files or nowhere.
class ObjMaterials {
  public:
    explicit ObjMaterials(std::filesystem::path obj_path, std::string obj_file)
        : obj_path_(std::move(obj_path)), obj_file_(std::move(obj_file)) {}

    /// What stands behind `mtllib`: one name, blanks included, or several. A file that is not there
    /// is remarked on.
    void open_library(std::string_view names);

    /// The number of a material in the list that `take` returns. An empty name: of no material.
    std::uint32_t number_of(std::string_view name);

    /// Moves what was found into `geometry`.
    void take_into(ImportedGeometry& geometry);

  private:
    bool open_file(const std::string& name);
    void remark_missing(const std::string& name);
    const FileMaterial* find(const std::string& name) const;

    std::filesystem::path obj_path_;
    std::string obj_file_;
    std::unordered_map<std::string, FileMaterial> defined_;
    std::unordered_map<std::string, std::string> commented_;  // name without comment: name
    std::unordered_map<std::string, std::uint32_t> numbers_;
    std::vector<std::string> used_;  // in the order of their numbers
    std::vector<Finding> remarks_;
};

}  // namespace patchlight::server
