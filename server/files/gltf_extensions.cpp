#include "server/files/gltf_extensions.h"

#include "server/wording.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace patchlight::server {
namespace {

/// What these change is read, or told where it is met.
constexpr std::array read_or_told{"KHR_materials_emissive_strength",
                                  "KHR_materials_pbrSpecularGlossiness",
                                  "KHR_mesh_quantization",
                                  "KHR_lights_punctual",
                                  "KHR_texture_transform",
                                  "KHR_texture_basisu",
                                  "EXT_texture_webp",
                                  "EXT_mesh_gpu_instancing",
                                  "KHR_node_visibility"};
/// Has no part in diffuse light, or is told material by material; the file may not require it.
constexpr std::array without_part{"KHR_materials_transmission",
                                  "KHR_materials_diffuse_transmission",
                                  "KHR_materials_volume",
                                  "KHR_materials_volume_scatter",
                                  "KHR_materials_ior",
                                  "KHR_materials_specular",
                                  "KHR_materials_clearcoat",
                                  "KHR_materials_sheen",
                                  "KHR_materials_iridescence",
                                  "KHR_materials_anisotropy",
                                  "KHR_materials_dispersion",
                                  "KHR_xmp",
                                  "KHR_xmp_json_ld",
                                  "MSFT_texture_dds",
                                  "KHR_draco_mesh_compression",
                                  "EXT_meshopt_compression",
                                  "KHR_meshopt_compression",
                                  "KHR_animation_pointer"};

template <std::size_t count>
bool is_one_of(const std::array<const char*, count>& known, std::string_view name) {
    return std::find(known.begin(), known.end(), name) != known.end();
}

std::size_t count_of(const JsonValue& root, const char* list) {
    const auto found = root.find(list);
    return found && found->is_array() ? found->size() : 0;
}

}  // namespace

void check_gltf_extensions(const JsonValue& root) {
    const auto required = root.find("extensionsRequired");
    if (!required) return;
    required->for_each_element([](const JsonValue& extension) {
        if (is_one_of(read_or_told, extension.text())) return;
        extension.reject("the file requires the extension " + in_quotes(extension.text()) +
                         ", which is not read; export it without");
    });
}

void remark_on_gltf(const JsonValue& root, ImportedGeometry& geometry) {
    const auto tell = [&](const char* kind, const std::string& detail, const char* remedy) {
        geometry.remarks.push_back({kind, {}, detail, remedy});
    };
    std::string names;
    if (const auto used = root.find("extensionsUsed"))
        used->for_each_element([&](const JsonValue& extension) {
            const std::string& name = extension.text();
            if (!is_one_of(read_or_told, name) && !is_one_of(without_part, name))
                names += (names.empty() ? "" : ", ") + in_quotes(name);
        });
    if (!names.empty())
        tell("unsupported-extension", "extensions of " + geometry.file + " are not read: " + names,
             "export the file without them, if they change what is to be lit");
    if (count_of(root, "animations") > 0)
        tell("animation-ignored",
             "animations of " + geometry.file + " are left out: things stand as they are at rest",
             "export the moment that is wanted");
    if (count_of(root, "scenes") > 1)
        tell("scenes-ignored",
             geometry.file + " has " + std::to_string(count_of(root, "scenes")) +
                 " scenes; only the one that it shows first is read",
             "export the others to files of their own");
}

}  // namespace patchlight::server
