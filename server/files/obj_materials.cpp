#include "server/files/obj_materials.h"

#include "server/files/file_bytes.h"
#include "server/files/mtl_file.h"
#include "server/utf8_text.h"
#include "server/wording.h"

#include <sstream>

namespace patchlight::server {
namespace {

namespace fs = std::filesystem;

/// Beside the OBJ file, under the name given or else under its last part: folders of another
/// machine are often left in.
std::optional<fs::path> find_beside(const fs::path& obj, std::string name) {
    for (char& letter : name)
        if (letter == '\\') letter = '/';
    for (const std::string& tried : {name, fs::path(name).filename().string()}) {
        std::error_code ignored;
        const auto found = file_beside(obj, tried);
        if (found && fs::is_regular_file(*found, ignored)) return found;
    }
    return std::nullopt;
}

}  // namespace

bool ObjMaterials::open_file(const std::string& name) {
    const auto path = find_beside(obj_path_, name);
    if (!path) return false;
    const std::string shown = (fs::path(obj_file_).parent_path() / path->filename()).string();
    for (FileMaterial& material : read_mtl(as_utf8(read_file_bytes(*path, shown)), shown))
        defined_.insert_or_assign(material.name, std::move(material));
    return true;
}

void ObjMaterials::open_library(std::string_view names) {
    if (names.empty() || open_file(std::string(names))) return;
    std::istringstream words{std::string(names)};
    for (std::string name; words >> name;)
        if (!open_file(name)) remark_missing(name);
}

void ObjMaterials::remark_missing(const std::string& name) {
    remarks_.push_back({"missing-material-file",
                        {},
                        in_quotes(name) + ", which " + obj_file_ + " names, is not beside it",
                        "put it there, or give the scene materials of the same names"});
}

std::uint32_t ObjMaterials::number_of(std::string_view name) {
    const auto [found, is_new] =
        numbers_.try_emplace(std::string(name), static_cast<std::uint32_t>(used_.size()));
    if (is_new) used_.emplace_back(name);
    return found->second;
}

void ObjMaterials::take_into(ImportedGeometry& geometry) {
    for (const std::string& name : used_) {
        FileMaterial material;
        material.name = name;
        if (const auto found = defined_.find(name); found != defined_.end())
            material = std::move(found->second);
        geometry.materials.push_back(std::move(material));
    }
    geometry.about_materials = std::move(remarks_);
}

}  // namespace patchlight::server
