#include "server/files/obj_materials.h"

#include "server/files/file_bytes.h"
#include "server/files/mtl_file.h"
#include "server/files/text_file.h"
#include "server/wording.h"

#include <algorithm>
#include <sstream>

namespace patchlight::server {
namespace {

namespace fs = std::filesystem;

/// Beside a file that names it, under the name given or else under its last part: folders of
/// another machine are often left in.
std::optional<fs::path> find_beside(const fs::path& file, std::string name) {
    for (char& letter : name)
        if (letter == '\\') letter = '/';
    for (const std::string& tried : {name, fs::path(name).filename().string()}) {
        std::error_code ignored;
        const auto found = file_beside(file, tried);
        if (found && fs::is_regular_file(*found, ignored)) return found;
    }
    return std::nullopt;
}

/// "red # of bricks" is "red" to those who end a name at a comment.
std::string_view without_comment(std::string_view name) {
    const std::size_t comment = std::min(name.find(" #"), name.find("\t#"));
    name = name.substr(0, comment);
    return name.substr(0, name.find_last_not_of(" \t") + 1);
}

/// Beside the MTL file that names it.
void locate(const fs::path& mtl, FileTexture& texture) {
    for (const std::string_view name :
         {std::string_view(texture.name), without_comment(texture.name)})
        if (const auto found = find_beside(mtl, std::string(name))) texture.path = *found;
    if (texture.path.empty()) texture.problem = "is not beside its material file";
}

}  // namespace

bool ObjMaterials::open_file(const std::string& name) {
    const auto path = find_beside(obj_path_, name);
    if (!path) return false;
    const std::string shown = (fs::path(obj_file_).parent_path() / path->filename()).string();
    for (FileMaterial& material : read_mtl(read_text_file(*path, shown), shown)) {
        for (auto* texture : {&material.reflectance_texture, &material.radiance_texture})
            if (*texture) locate(*path, **texture);
        if (const auto plain = without_comment(material.name); plain != material.name)
            commented_.insert_or_assign(std::string(plain), material.name);
        defined_.insert_or_assign(material.name, std::move(material));
    }
    return true;
}

void ObjMaterials::open_library(std::string_view names) {
    if (names.empty() || open_file(std::string(names))) return;
    std::istringstream words{std::string(names)};
    for (std::string name; words >> name && !name.starts_with('#');)
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

/// A # belongs to a name, unless the name is known only without what follows it.
const FileMaterial* ObjMaterials::find(const std::string& name) const {
    if (const auto whole = defined_.find(name); whole != defined_.end()) return &whole->second;
    const auto before = defined_.find(std::string(without_comment(name)));
    if (before != defined_.end()) return &before->second;
    const auto commented = commented_.find(name);
    return commented == commented_.end() ? nullptr : &defined_.at(commented->second);
}

void ObjMaterials::take_into(ImportedGeometry& geometry) {
    for (const std::string& name : used_) {
        FileMaterial material;
        material.name = name;
        if (const FileMaterial* found = find(name)) {
            material = *found;
            material.name = name;
        }
        geometry.materials.push_back(std::move(material));
    }
    geometry.about_materials = std::move(remarks_);
}

}  // namespace patchlight::server
