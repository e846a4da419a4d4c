#include "solver/display/light_sources.h"

#include <algorithm>

namespace patchlight {

namespace {

LightSource make_source(const Scene& scene, const PatchMesh& mesh, PatchIndex i,
                        const RayScene& rays) {
    const Surface& surface = scene.surfaces[mesh.patches[i].surface];
    LightSource source;
    for (const Vec3& p : patch_corners(mesh, i)) source.polygon.add(p);
    source.normal = surface.normal;
    source.sampler = make_sampler(mesh, i, surface.normal, rays);
    source.surface = mesh.patches[i].surface;
    source.lift = rays.lift(source.surface);
    source.exitance = scene.materials[surface.material].exitance;
    source.area = mesh.patches[i].area;
    source.power = source.area * luminance(source.exitance);
    return source;
}

}  // namespace

std::vector<LightSource> find_light_sources(const Scene& scene, const MeshLines& lines,
                                            const RayScene& rays, std::size_t most) {
    constexpr double uncut = 10.0;  // of the scene's size: patches as large as polygons allow
    const PatchMesh mesh = make_patches(scene, lines, uncut * scene_size(scene));
    std::vector<double> power(scene.surfaces.size(), 0.0);
    std::vector<SurfaceIndex> emitters;
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        const Surface& surface = scene.surfaces[s];
        power[s] = surface.area * luminance(scene.materials[surface.material].exitance);
        if (power[s] > 0.0) emitters.push_back(s);
    }
    std::stable_sort(emitters.begin(), emitters.end(),
                     [&](SurfaceIndex s, SurfaceIndex t) { return power[s] > power[t]; });
    std::vector<LightSource> sources;
    for (const SurfaceIndex s : emitters) {
        const PatchIndex begin = mesh.first_of_surface[s], end = mesh.first_of_surface[s + 1];
        if (sources.size() + (end - begin) > most) break;
        for (PatchIndex i = begin; i < end; ++i)
            if (!mesh.patches[i].covered) sources.push_back(make_source(scene, mesh, i, rays));
    }
    return sources;
}

double narrow_side(const ConvexPolygon& polygon) {
    double longest = 0.0;
    for (std::size_t k = 0; k < polygon.size; ++k)
        for (std::size_t l = 0; l < k; ++l)
            longest = std::max(longest, (polygon.corners[k] - polygon.corners[l]).norm());
    return longest > 0.0 ? vector_area(polygon.view()).norm() / longest : 0.0;
}

}  // namespace patchlight
