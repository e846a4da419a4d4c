#include "solver/factor_groups.h"

#include <map>
#include <stdexcept>
#include <utility>

namespace patchlight {

namespace {

/// Group of each surface, numbered as they come, and how they are called.
struct SurfaceGroups {
    std::vector<std::uint32_t> of_surface;
    std::vector<std::string> names;
};

SurfaceGroups by_object(const Scene& scene) {
    SurfaceGroups groups;
    for (const Surface& surface : scene.surfaces) groups.of_surface.push_back(surface.object);
    for (const Object& object : scene.objects) groups.names.push_back(object.name);
    return groups;
}

SurfaceGroups by_face(const Scene& scene) {
    SurfaceGroups groups;
    std::map<std::pair<ObjectIndex, std::uint32_t>, std::uint32_t> numbers;
    std::vector<std::uint32_t> faces(scene.objects.size(), 0);
    for (const Surface& surface : scene.surfaces) {
        const auto [at, is_new] =
            numbers.try_emplace({surface.object, surface.face}, numbers.size());
        if (is_new) ++faces[surface.object];
        groups.of_surface.push_back(at->second);
    }
    groups.names.resize(numbers.size());
    for (const auto& [face, number] : numbers) {
        groups.names[number] = scene.objects[face.first].name;
        if (faces[face.first] > 1 || face.second > 0)
            groups.names[number] += "[" + std::to_string(face.second) + "]";
    }
    return groups;
}

}  // namespace

FactorGroups make_factor_groups(const Scene& scene, const PatchMesh& mesh, Grouping grouping) {
    FactorGroups groups;
    SurfaceGroups surfaces;
    switch (grouping) {
        case Grouping::object:
            surfaces = by_object(scene);
            break;
        case Grouping::face:
            surfaces = by_face(scene);
            break;
        case Grouping::patch:
            break;
    }
    const bool patches = grouping == Grouping::patch;
    const std::size_t count = patches ? mesh.size() : surfaces.names.size();
    groups.names = std::move(surfaces.names);
    groups.areas.assign(count, 0.0);
    groups.patches.resize(count);
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        const std::uint32_t g = patches ? i : surfaces.of_surface[mesh.patches[i].surface];
        groups.of_patch.push_back(g);
        if (!mesh.patches[i].covered) groups.areas[g] += mesh.patches[i].area;
        groups.patches[g].push_back(i);
    }
    return groups;
}

}  // namespace patchlight
