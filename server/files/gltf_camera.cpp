#include "server/files/gltf_camera.h"

#include "server/files/gltf_buffers.h"

#include <numbers>

namespace patchlight::server {
namespace {

constexpr Range above_zero{1e-9, 1e9};

void read_perspective(const JsonValue& block, FileCamera& camera) {
    const JsonValue angle = block.at("yfov");  // [radians]
    constexpr Range below_straight{1e-4, std::numbers::pi, false, true};
    camera.vertical_fov = angle.number(below_straight) * 180.0 / std::numbers::pi;
    if (const auto aspect = block.find("aspectRatio")) camera.aspect = aspect->number(above_zero);
}

/// Magnifications are halves of what is seen.
void read_parallel(const JsonValue& block, double scale, FileCamera& camera) {
    const JsonValue across = block.at("xmag");
    const JsonValue up = block.at("ymag");
    camera.height = 2.0 * scale * up.number(above_zero);
    camera.aspect = across.number(above_zero) / up.number(above_zero);
}

}  // namespace

FileCamera read_gltf_camera(const JsonValue& reference, const JsonValue& root,
                            const std::string& path, const Eigen::Affine3d& to_file) {
    const JsonValue list = root.at("cameras");
    const JsonValue block = list[gltf_index(reference, root, "cameras")];
    FileCamera camera;
    camera.name = path;
    camera.eye = to_file.translation();
    camera.view = -to_file.linear().col(2);
    camera.up = to_file.linear().col(1);
    if (const auto parallel = block.find("orthographic"))
        read_parallel(*parallel, camera.up.norm(), camera);
    else
        read_perspective(block.at("perspective"), camera);
    camera.view.normalize();
    camera.up.normalize();
    return camera;
}

}  // namespace patchlight::server
