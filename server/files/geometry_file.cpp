#include "server/files/geometry_file.h"

#include "server/files/file_bytes.h"
#include "server/files/gltf_file.h"
#include "server/files/known_formats.h"
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

[[noreturn]] void refuse_foreign(const std::filesystem::path& path, const std::string& file) {
    std::string what = foreign_name(path);
    if (what.empty()) what = foreign_content(first_bytes(path));
    if (!what.empty()) throw InputError(file, what);
    throw InputError(file, "the name must end in .obj, .gltf, .glb or .stl, not " +
                               in_quotes(path.extension().string()));
}

/// "…; give its name the ending .obj" says nothing new of a file that has it.
bool reads_such(const std::string& what, const std::filesystem::path& path) {
    const std::string::size_type ending = what.rfind(' ');
    return reader_of("x" + what.substr(ending + 1)) == reader_of(path);
}

}  // namespace

bool is_geometry_file(const std::filesystem::path& path) { return reader_of(path) != nullptr; }

ImportedGeometry read_geometry_file(const std::filesystem::path& path, const std::string& file) {
    const Reader read = reader_of(path);
    if (!read) refuse_foreign(path, file);
    try {
        return read(path, file);
    } catch (const InputError& error) {
        // It may be something else under a name of these.
        const std::string what = foreign_content(first_bytes(path));
        if (what.empty() || reads_such(what, path)) throw;
        throw InputError(file, what);
    }
}

}  // namespace patchlight::server
