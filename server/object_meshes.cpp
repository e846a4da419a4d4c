#include "server/object_meshes.h"

#include <algorithm>

namespace patchlight::server {
namespace {

ObjectIndex object_of(const Scene& scene, const Solution& solution, std::size_t triangle) {
    const PatchIndex patch = solution.display.patch[triangle];
    return scene.surfaces.at(solution.mesh.patches.at(patch).surface).object;
}

}  // namespace

std::vector<ObjectMesh> object_meshes(const Scene& scene, const Solution& solution) {
    const DisplayMesh& display = solution.display;
    std::vector<ObjectMesh> meshes(scene.objects.size());
    for (std::size_t t = 0; t < display.triangles.size(); ++t) {
        ObjectMesh& mesh = meshes[object_of(scene, solution, t)];
        mesh.triangles.push_back(display.triangles[t]);
        mesh.vertices.insert(mesh.vertices.end(), display.triangles[t].begin(),
                             display.triangles[t].end());
    }
    std::vector<std::uint32_t> place(display.positions.size());
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        ObjectMesh& mesh = meshes[k];
        mesh.object = static_cast<ObjectIndex>(k);
        std::sort(mesh.vertices.begin(), mesh.vertices.end());
        mesh.vertices.erase(std::unique(mesh.vertices.begin(), mesh.vertices.end()),
                            mesh.vertices.end());
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
            place[mesh.vertices[v]] = static_cast<std::uint32_t>(v);
        for (auto& triangle : mesh.triangles)
            for (std::uint32_t& vertex : triangle) vertex = place[vertex];
    }
    std::erase_if(meshes, [](const ObjectMesh& mesh) { return mesh.triangles.empty(); });
    return meshes;
}

}  // namespace patchlight::server
