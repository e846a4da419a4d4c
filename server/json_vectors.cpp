#include "server/json_vectors.h"

#include "server/wording.h"

#include <string>

namespace patchlight::server {
namespace {

constexpr double largest_number = 1e15;      // of a coordinate, in the scene's own unit of length
constexpr double largest_coordinate = 1e9;   // of a point in the scene [m]
constexpr double shortest_direction = 1e-9;  // before it is made a unit vector

Vec3 read_three(const JsonValue& value, const Range& range) {
    if (value.size() != 3) value.reject("must have 3 numbers, not " + std::to_string(value.size()));
    return {value[0].number(range), value[1].number(range), value[2].number(range)};
}

}  // namespace

Vec3 read_vec3(const JsonValue& value, double limit) { return read_three(value, {-limit, limit}); }

Vec3 read_point(const JsonValue& value, const Eigen::Affine3d& to_scene) {
    const Vec3 point = to_scene * read_vec3(value, largest_number);
    for (const double coordinate : point)
        if (!(std::abs(coordinate) <= largest_coordinate))
            value.reject("lies at " + number_text(coordinate) +
                         " m; coordinates must be within 1e9 m of the origin");
    return point;
}

Vec3 read_direction(const JsonValue& value) {
    const Vec3 direction = read_vec3(value, largest_number);
    if (direction.norm() < shortest_direction) value.reject("a direction must not be zero");
    return direction.stableNormalized();
}

Rgb read_channels(const JsonValue& value, const Range& range) {
    if (!value.is_array()) return Rgb::Constant(value.number(range));
    return read_three(value, range).array();
}

}  // namespace patchlight::server
