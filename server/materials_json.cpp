#include "server/materials_json.h"

#include "server/json_vectors.h"
#include "server/wording.h"

#include <algorithm>
#include <numbers>
#include <string>

namespace patchlight::server {
namespace {

constexpr double brightest = 1e15;  // ten thousand times the sun, in lm/m²; its square is finite

Rgb read_exitance(const JsonValue& block) {
    const auto exitance = block.find("exitance");
    const auto radiance = block.find("radiance");
    if (exitance && radiance)
        radiance->reject("'exitance' is given as well; give one of them (E = π L)");
    if (exitance) return read_channels(*exitance, {0, brightest});
    if (radiance) return std::numbers::pi * read_channels(*radiance, {0, brightest});
    return Rgb::Zero();
}

Material read_material(const std::string& name, const JsonValue& block) {
    block.require_object({"reflectance", "exitance", "radiance", "two_sided"});
    Material material;
    material.name = name;
    constexpr bool one_is_too_much = true;  // light would never die out
    if (const auto reflectance = block.find("reflectance"))
        material.reflectance = read_channels(*reflectance, {0, 1, false, one_is_too_much});
    material.exitance = read_exitance(block);
    if (const auto two_sided = block.find("two_sided")) material.two_sided = two_sided->boolean();
    return material;
}

}  // namespace

std::vector<Material> read_materials(const JsonValue& block, FaultList& faults) {
    std::vector<Material> materials;
    block.for_each_member([&](const std::string& name, const JsonValue& material) {
        Material read;
        read.name = name;
        faults.attempt([&] {
            material.require_name(name);
            read = read_material(name, material);
        });
        materials.push_back(std::move(read));
    });
    return materials;
}

std::optional<MaterialIndex> find_material(std::span<const Material> materials,
                                           const std::string& name) {
    const auto by_name = [](const Material& material, const std::string& wanted) {
        return material.name < wanted;
    };
    const auto found = std::lower_bound(materials.begin(), materials.end(), name, by_name);
    if (found == materials.end() || found->name != name) return std::nullopt;
    return static_cast<MaterialIndex>(found - materials.begin());
}

MaterialIndex find_material(std::span<const Material> materials, const JsonValue& name) {
    if (const auto found = find_material(materials, name.text())) return *found;
    std::vector<std::string> known;
    for (const Material& material : materials) known.push_back(material.name);
    name.reject("no material " + in_quotes(name.text()) + suggestion(name.text(), known));
}

}  // namespace patchlight::server
