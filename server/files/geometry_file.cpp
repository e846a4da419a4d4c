#include "server/files/geometry_file.h"

#include "server/files/gltf_file.h"
#include "server/files/obj_file.h"
#include "server/files/stl_file.h"
#include "server/wording.h"
#include "solver/scene/input_error.h"

namespace patchlight::server {
namespace {

using Reader = ImportedGeometry (*)(const std::filesystem::path&, const std::string&);

Reader reader_of(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    for (char& letter : ending)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    if (ending == ".obj") return read_obj;
    if (ending == ".gltf" || ending == ".glb") return read_gltf;
    if (ending == ".stl") return read_stl;
    return nullptr;
}

}  // namespace

bool is_geometry_file(const std::filesystem::path& path) { return reader_of(path) != nullptr; }

ImportedGeometry read_geometry_file(const std::filesystem::path& path, const std::string& file) {
    if (const Reader read = reader_of(path)) return read(path, file);
    throw InputError(file, "the name must end in .obj, .gltf, .glb or .stl, not " +
                               in_quotes(path.extension().string()));
}

}  // namespace patchlight::server
