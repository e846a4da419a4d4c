#include "server/selftest/face_means.h"

#include <Eigen/Geometry>

namespace patchlight::server {
namespace {

class FaceSums {
  public:
    FaceSums(const Scene& scene, const PatchMesh& mesh) : scene_(scene), mesh_(mesh) {}

    void add(PatchIndex patch, double area, double mean) {
        const Surface& surface = scene_.surfaces[mesh_.patches[patch].surface];
        for (std::size_t face = 0; face < 6; ++face)
            if (scene_.objects[surface.object].name.starts_with(cube_face_names[face])) {
                area_[face] += area;
                power_[face] += area * mean;
            }
    }
    SixMeans means() const {
        SixMeans means{};
        for (std::size_t face = 0; face < 6; ++face)
            means[face] = area_[face] > 0.0 ? power_[face] / area_[face] : 0.0;
        return means;
    }

  private:
    const Scene& scene_;
    const PatchMesh& mesh_;
    SixMeans area_{}, power_{};
};

}  // namespace

SixMeans patch_means(const Scene& scene, const Solution& solution) {
    FaceSums sums(scene, solution.mesh);
    for (PatchIndex i = 0; i < solution.mesh.size(); ++i)
        if (!solution.mesh.patches[i].covered)
            sums.add(i, solution.mesh.patches[i].area, solution.radiosity[i][0]);
    return sums.means();
}

SixMeans display_means(const Scene& scene, const Solution& solution) {
    FaceSums sums(scene, solution.mesh);
    const DisplayMesh& display = solution.display;
    for (std::size_t t = 0; t < display.triangles.size(); ++t) {
        const auto& [a, b, c] = display.triangles[t];
        const Vec3 across = Vec3(display.positions[b] - display.positions[a])
                                .cross(Vec3(display.positions[c] - display.positions[a]));
        sums.add(display.patch[t], 0.5 * across.norm(),
                 (display.radiosity[a][0] + display.radiosity[b][0] + display.radiosity[c][0]) / 3);
    }
    return sums.means();
}

}  // namespace patchlight::server
