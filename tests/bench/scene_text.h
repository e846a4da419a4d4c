#pragma once

#include "solver/scene/light.h"

#include <Eigen/Geometry>

#include <array>
#include <string>
#include <vector>

namespace patchlight {

/// Writes a scene document, piece by piece. Every place goes through one transform, so that whole
/// scenes can be turned and scaled.
class SceneText {
  public:
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();

    struct Paint {
        Rgb reflectance = Rgb::Zero();  // [1]
        Rgb radiance = Rgb::Zero();     // [W/(m² sr)]
        bool two_sided = false;
    };
    /// Its name.
    std::string material(const Paint& paint);
    void polygon(const std::string& name, const std::string& material,
                 const std::vector<Vec3>& corners);
    /// Corners o, o + a, o + a + b, o + b: the front is where a × b points.
    void quad(const std::string& name, const std::string& material, const Vec3& o, const Vec3& a,
              const Vec3& b);
    void mesh(const std::string& name, const std::string& material,
              const std::vector<Vec3>& vertices,
              const std::vector<std::vector<std::size_t>>& faces);

    std::string document() const;

  private:
    void object(const std::string& name, const std::string& material);

    std::string materials_, objects_;
    int material_count_ = 0, object_count_ = 0;
};

}  // namespace patchlight
