#include "server/files/gltf_materials.h"

#include "server/wording.h"

namespace patchlight::server {
namespace {

/// The first three of three or more numbers: a fourth is opacity.
Rgb read_colour(const JsonValue& value) {
    if (value.size() != 3 && value.size() != 4)
        value.reject("must have 3 or 4 numbers, not " + std::to_string(value.size()));
    constexpr Range range{0, brightest_file_radiance};
    return {value[0].number(range), value[1].number(range), value[2].number(range)};
}

double emissive_strength(const JsonValue& material) {
    const auto extensions = material.find("extensions");
    if (!extensions) return 1.0;
    const auto extension = extensions->find("KHR_materials_emissive_strength");
    if (!extension) return 1.0;
    const auto strength = extension->find("emissiveStrength");
    return strength ? strength->number({0, brightest_file_radiance}) : 1.0;
}

bool is_transparent(const JsonValue& block) {
    const auto mode = block.find("alphaMode");
    return mode && mode->text() != "OPAQUE";
}

FileMaterial read_material(const JsonValue& block) {
    FileMaterial material;
    if (const auto name = block.find("name")) material.name = name->text();
    if (const auto surface = block.find("pbrMetallicRoughness")) {
        if (const auto colour = surface->find("baseColorFactor"))
            material.reflectance = read_colour(*colour);
        material.has_texture = surface->has("baseColorTexture");
    }
    if (const auto emission = block.find("emissiveFactor"))
        material.radiance = emissive_strength(block) * read_colour(*emission);
    if ((material.radiance > brightest_file_radiance).any())
        block.reject("emits more than " + number_text(brightest_file_radiance));
    material.has_texture |= block.has("emissiveTexture");
    material.is_transparent = is_transparent(block);
    if (const auto both = block.find("doubleSided")) material.two_sided = both->boolean();
    return material;
}

}  // namespace

std::vector<FileMaterial> read_gltf_materials(const JsonValue& root) {
    std::vector<FileMaterial> materials;
    if (const auto list = root.find("materials"))
        list->for_each_element(
            [&](const JsonValue& block) { materials.push_back(read_material(block)); });
    materials.emplace_back();
    return materials;
}

}  // namespace patchlight::server
