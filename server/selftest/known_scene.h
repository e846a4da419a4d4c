#pragma once

#include "solver/scene/scene.h"

#include <string>
#include <vector>

namespace patchlight::server {

/// Puts the scene of a known answer together, in metres.
class KnownScene {
  public:
    MaterialIndex material(const Rgb& reflectance, const Rgb& exitance);
    MaterialIndex material(double reflectance, double exitance);
    void polygon(const std::string& name, MaterialIndex material, const std::vector<Vec3>& corners);

    /// Inside of the box from the origin to `size`, an object for each face: "x0", "x1", "y0" …
    void room(const std::vector<MaterialIndex>& six, const Vec3& size);

    /// Outside of the box from `low` to `high`, as one object, turned about its centre.
    void block(const std::string& name, MaterialIndex material, const Vec3& low, const Vec3& high,
               double turn);

    void sensor(const std::string& name, const Vec3& position, const Vec3& normal);

    Scene scene;
};

/// Corners of a part of a face of the unit cube, its front inside; faces in the order x0, x1, y0,
/// …; the part is from (u0, v0) to (u1, v1) along the next two axes cyclically [m].
std::vector<Vec3> cube_face(std::size_t face, double u0, double u1, double v0, double v1);

inline constexpr const char* cube_face_names[] = {"x0", "x1", "y0", "y1", "z0", "z1"};

}  // namespace patchlight::server
