#include "server/files/gltf_file.h"

#include "server/files/file_bytes.h"
#include "server/files/glb_chunks.h"
#include "server/files/gltf_accessors.h"
#include "server/files/gltf_buffers.h"
#include "server/files/gltf_extensions.h"
#include "server/files/gltf_materials.h"
#include "server/files/gltf_nodes.h"
#include "server/json_document.h"
#include "server/wording.h"

namespace patchlight::server {
namespace {

void check_version(const JsonValue& root) {
    root.require_map();
    const JsonValue asset = root.at("asset");
    const JsonValue version = asset.at("version");
    if (!version.text().starts_with("2."))
        version.reject("is glTF " + in_quotes(version.text()) + "; glTF 2 is read");
}

void read_document(const JsonValue& root, const std::filesystem::path& path,
                   std::optional<std::string_view> binary, ImportedGeometry& geometry) {
    check_version(root);
    check_gltf_extensions(root);
    const std::vector<std::string> buffers = read_gltf_buffers(root, path, binary);
    GltfAccessors accessors(root, buffers);
    GltfPictures pictures(root, accessors, path);
    geometry.materials = read_gltf_materials(root, pictures);
    remark_on_gltf(root, geometry);
    GltfNodes(root, accessors, geometry).read_scene();
    if (geometry.parts.empty()) root.reject("its scene has no triangles that are shown");
}

}  // namespace

ImportedGeometry read_gltf(const std::filesystem::path& path, const std::string& file) {
    const std::string bytes = read_file_bytes(path, file);
    GlbChunks chunks{bytes, std::nullopt};
    if (is_glb(bytes))
        chunks = split_glb(bytes, file);
    else if (path.extension() == ".glb")
        throw InputError(file, "is no GLB: it does not begin with 'glTF'");
    ImportedGeometry geometry;
    geometry.file = file;
    geometry.metres = 1.0;
    try {
        const nlohmann::json document = parse_json(chunks.json);
        read_document(JsonValue(document), path, chunks.binary, geometry);
    } catch (const JsonError& error) {
        std::string place = file;
        if (error.line() > 0)
            place += ":" + std::to_string(error.line()) + ":" + std::to_string(error.column());
        throw InputError(place, (error.pointer().empty() ? "" : error.pointer() + ": ") +
                                    std::string(error.what()));
    } catch (const InputError& error) {
        throw InputError(file + (error.pointer().empty() ? "" : ": " + error.pointer()),
                         error.what());
    }
    return geometry;
}

}  // namespace patchlight::server
