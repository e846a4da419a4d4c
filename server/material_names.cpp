#include "server/material_names.h"

#include <utility>

namespace patchlight::server {

MaterialNames::MaterialNames(Scene& scene) : scene_(scene) {
    for (const Material& material : scene.materials) taken_.insert(material.name);
}

MaterialIndex MaterialNames::add(Material material) {
    const std::string wanted = material.name;
    for (std::size_t number = 2; !taken_.insert(material.name).second; ++number)
        material.name = wanted + "#" + std::to_string(number);
    scene_.materials.push_back(std::move(material));
    return static_cast<MaterialIndex>(scene_.materials.size() - 1);
}

}  // namespace patchlight::server
