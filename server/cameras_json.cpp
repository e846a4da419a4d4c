#include "server/cameras_json.h"

#include "server/input_errors.h"
#include "server/json_vectors.h"
#include "server/unique_names.h"
#include "server/wording.h"

#include <string>

namespace patchlight::server {
namespace {

constexpr std::size_t most_cameras = 1000;
constexpr int default_edge = 512;  // [pixels]

raster::Projection read_projection(const JsonValue& value) {
    if (value.text() == "perspective") return raster::Projection::perspective;
    if (value.text() == "parallel") return raster::Projection::parallel;
    value.reject("unknown projection " + in_quotes(value.text()) +
                 suggestion(value.text(), {"perspective", "parallel"}));
}

void read_size(const JsonValue& value, raster::Camera& camera) {
    if (value.size() != 2)
        value.reject("must have 2 numbers, width and height in pixels, not " +
                     std::to_string(value.size()));
    camera.width = static_cast<int>(value[0].whole_number(1, most_pixels_along_an_edge));
    camera.height = static_cast<int>(value[1].whole_number(1, most_pixels_along_an_edge));
}

/// What is seen: an angle of a perspective view, a height of a parallel one.
void read_extent(const JsonValue& block, double metres, raster::Camera& camera) {
    const auto fov = block.find("vertical_fov");
    const auto height = block.find("height");
    switch (camera.projection) {
        case raster::Projection::perspective:
            if (height) height->reject("is for parallel views; give 'vertical_fov'");
            if (fov) camera.vertical_fov = fov->number({1e-3, 180, false, true});
            return;
        case raster::Projection::parallel:
            if (fov) fov->reject("is for perspective views; give 'height'");
            if (!height) block.reject("a parallel view needs 'height'");
            camera.view_height = metres * height->number({1e-9, 1e15});
            return;
    }
}

void require_view(const JsonValue& block, const raster::Camera& camera) {
    const Vec3 view = camera.look_at - camera.eye;
    const double rounding = 1e-12 * std::max(camera.eye.norm(), camera.look_at.norm());
    if (!(view.norm() > rounding)) {
        const JsonValue look_at = block.at("look_at");
        look_at.reject("must differ from 'eye'");
    }
    constexpr double least_sine = 1e-6;
    if (view.normalized().cross(camera.up).norm() > least_sine) return;
    if (const auto up = block.find("up")) up->reject("must not run along the view");
    block.reject("looks along [0, 1, 0]: give another 'up'");
}

raster::Camera read_camera(const JsonValue& block, double metres) {
    block.require_object(
        {"name", "eye", "look_at", "up", "projection", "vertical_fov", "height", "size"});
    const Eigen::Affine3d to_scene(Eigen::Scaling(metres));
    const JsonValue eye = block.at("eye");
    const JsonValue look_at = block.at("look_at");
    raster::Camera camera;
    camera.width = camera.height = default_edge;
    camera.eye = read_point(eye, to_scene);
    camera.look_at = read_point(look_at, to_scene);
    if (const auto up = block.find("up")) camera.up = read_direction(*up);
    if (const auto projection = block.find("projection"))
        camera.projection = read_projection(*projection);
    read_extent(block, metres, camera);
    if (const auto size = block.find("size")) read_size(*size, camera);
    require_view(block, camera);
    return camera;
}

nlohmann::ordered_json numbers(const Vec3& vector) { return {vector.x(), vector.y(), vector.z()}; }

}  // namespace

std::vector<NamedCamera> read_cameras(const JsonValue& list, double metres) {
    if (list.size() > most_cameras)
        list.reject(std::to_string(list.size()) + " cameras are too many; the limit is " +
                    std::to_string(most_cameras));
    UniqueNames names;
    FaultList faults;
    std::vector<NamedCamera> cameras;
    for (std::size_t k = 0; k < list.size(); ++k)
        faults.attempt([&] {
            const JsonValue block = list[k];
            const raster::Camera camera = read_camera(block, metres);
            const auto name = block.find("name");
            cameras.push_back({name ? name->name() : name_of_unnamed(k), camera});
            names.claim(cameras.back().name, name ? *name : block);
        });
    faults.throw_if_any();
    return cameras;
}

NamedCamera framing_camera(const Scene& scene, int width, int height) {
    Eigen::AlignedBox3d bounds;
    for (const Surface& surface : scene.surfaces)
        for (const Vec3& corner : surface.corners) bounds.extend(corner);
    return {"default", raster::framing(bounds, width, height), true};
}

nlohmann::ordered_json camera_block(const NamedCamera& named) {
    const raster::Camera& camera = named.camera;
    nlohmann::ordered_json block{{"name", named.name},
                                 {"eye", numbers(camera.eye)},
                                 {"look_at", numbers(camera.look_at)},
                                 {"up", numbers(camera.up)}};
    switch (camera.projection) {
        case raster::Projection::perspective:
            block["projection"] = "perspective";
            block["vertical_fov"] = camera.vertical_fov;
            break;
        case raster::Projection::parallel:
            block["projection"] = "parallel";
            block["height"] = camera.view_height;
            break;
    }
    block["size"] = {camera.width, camera.height};
    return block;
}

}  // namespace patchlight::server
