#include "server/selftest/known_scene.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>

namespace patchlight::server {

MaterialIndex KnownScene::material(const Rgb& reflectance, const Rgb& exitance) {
    scene.materials.push_back({"", reflectance, exitance, false});
    return static_cast<MaterialIndex>(scene.materials.size() - 1);
}

MaterialIndex KnownScene::material(double reflectance, double exitance) {
    return material(Rgb::Constant(reflectance), Rgb::Constant(exitance));
}

void KnownScene::polygon(const std::string& name, MaterialIndex material,
                         const std::vector<Vec3>& corners) {
    scene.objects.push_back({name});
    add_polygon(scene, static_cast<ObjectIndex>(scene.objects.size() - 1), material, 0, corners,
                "/objects");
}

void KnownScene::room(const std::vector<MaterialIndex>& six, const Vec3& size) {
    for (std::size_t face = 0; face < 6; ++face) {
        std::vector<Vec3> corners = cube_face(face, 0, 1, 0, 1);
        for (Vec3& corner : corners) corner = corner.cwiseProduct(size);
        polygon(cube_face_names[face], six.at(face), corners);
    }
}

void KnownScene::block(const std::string& name, MaterialIndex material, const Vec3& low,
                       const Vec3& high, double turn) {
    const Eigen::AngleAxisd rotation(turn, Vec3(0.2, 0.4, 0.6).normalized());
    const Vec3 centre = 0.5 * (low + high);
    scene.objects.push_back({name});
    for (std::size_t face = 0; face < 6; ++face) {
        std::vector<Vec3> corners = cube_face(face, 0, 1, 0, 1);
        std::reverse(corners.begin(), corners.end());
        for (Vec3& corner : corners)
            corner = centre + rotation * Vec3(low + corner.cwiseProduct(high - low) - centre);
        add_polygon(scene, static_cast<ObjectIndex>(scene.objects.size() - 1), material,
                    static_cast<std::uint32_t>(face), corners, "/objects");
    }
}

void KnownScene::sensor(const std::string& name, const Vec3& position, const Vec3& normal) {
    scene.sensors.push_back({name, position, normal.normalized()});
}

std::vector<Vec3> cube_face(std::size_t face, double u0, double u1, double v0, double v1) {
    const auto axis = static_cast<int>(face / 2);
    const Vec3 u = Vec3::Unit((axis + 1) % 3), v = Vec3::Unit((axis + 2) % 3);
    const bool is_far = face % 2 == 1;
    const Vec3 origin = is_far ? Vec3(Vec3::Unit(axis)) : Vec3(Vec3::Zero());
    std::vector<Vec3> corners{origin + u0 * u + v0 * v, origin + u1 * u + v0 * v,
                              origin + u1 * u + v1 * v, origin + u0 * u + v1 * v};
    if (is_far) std::swap(corners[1], corners[3]);
    return corners;
}

}  // namespace patchlight::server
