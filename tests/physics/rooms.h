#pragma once

#include "solver/scene/scene.h"
#include "solver/settings.h"
#include "solver/solve_scene.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace patchlight {

/// Puts scenes together for tests.
class SceneBuilder {
  public:
    MaterialIndex material(double reflectance, double exitance);
    void polygon(const std::string& name, MaterialIndex material, const std::vector<Vec3>& corners);
    /// A box of six quads, fronts inward or outward; `skipped` leaves a face out (0: low z).
    void box(const std::string& name, MaterialIndex material, const Vec3& low, const Vec3& high,
             bool inward, const Eigen::Isometry3d& pose = Eigen::Isometry3d::Identity(),
             int skipped = -1);
    void sensor(const Vec3& position, const Vec3& normal);

    Scene scene;
};

/// The Cornell box with its blocks as boxes, white walls, in metres: a lamp of 5 W/m² under the
/// ceiling. `open`: without the wall at y = 0.
Scene cornell_like(bool open = false);

/// How to solve: physics tests run over every one of these.
struct Way {
    Engine engine = Engine::analytic;
    Method method = Method::gauss_seidel;
};
std::vector<Way> every_way();
std::string name_of(Engine engine);
std::string way_name(const testing::TestParamInfo<Way>& info);
SolveSettings settings_of(const Way& way);
/// So many rays per patch, or hemicubes with as many cells in their top face.
void set_rays(SolveSettings& settings, int rays);

class EveryEngineAndMethod : public testing::TestWithParam<Way> {};

Solution solve(const Scene& scene, const SolveSettings& settings);

/// Object that patch i belongs to.
ObjectIndex scene_object(const Scene& scene, const Solution& solution, PatchIndex i);
/// Display vertices of an object, some of them more than once.
std::vector<std::uint32_t> object_vertices(const Scene& scene, const Solution& solution,
                                           ObjectIndex object);

/// A file of tests/physics/data.
nlohmann::json reference(const std::string& file);
nlohmann::json reference_case(const std::string& file, const std::string& id);
std::vector<Vec3> points_of(const nlohmann::json& array);
Vec3 point_of(const nlohmann::json& array);

}  // namespace patchlight
