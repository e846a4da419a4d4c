#include "server/transform_json.h"

#include "server/json_vectors.h"
#include "server/wording.h"

#include <cmath>
#include <string>

namespace patchlight::server {
namespace {

constexpr double largest_factor = 1e9;

Eigen::Quaterniond read_rotation(const JsonValue& value) {
    if (value.size() != 4)
        value.reject("must have 4 numbers (a unit quaternion x, y, z, w), not " +
                     std::to_string(value.size()));
    constexpr Range component{-2, 2};
    const Eigen::Quaterniond rotation(value[3].number(component), value[0].number(component),
                                      value[1].number(component), value[2].number(component));
    constexpr double rounding = 1e-3;  // of a quaternion written with few digits
    if (std::abs(rotation.norm() - 1.0) > rounding)
        value.reject("must be a unit quaternion x, y, z, w; its length is " +
                     number_text(rotation.norm()));
    return rotation.normalized();
}

Vec3 read_scale(const JsonValue& value) {
    const Rgb factors = read_channels(value, {-largest_factor, largest_factor});
    if ((factors == 0.0).any()) value.reject("must not be 0: it would flatten the object");
    return factors.matrix();
}

Eigen::Affine3d read_matrix(const JsonValue& value) {
    if (value.size() != 16)
        value.reject("must have 16 numbers (column-major), not " + std::to_string(value.size()));
    Eigen::Matrix4d matrix;
    for (int k = 0; k < 16; ++k)
        matrix(k % 4, k / 4) =
            value[static_cast<std::size_t>(k)].number({-largest_factor, largest_factor});
    if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
        value.reject("the last row (elements 3, 7, 11, 15) must be 0, 0, 0, 1");
    const Eigen::Matrix3d linear = matrix.topLeftCorner<3, 3>();
    constexpr double flat = 1e-12;  // volume of a unit cube against that of its longest edge cubed
    if (!(std::abs(linear.determinant()) > flat * std::pow(linear.colwise().norm().maxCoeff(), 3)))
        value.reject("must not flatten the object: its determinant is " +
                     number_text(linear.determinant()));
    return Eigen::Affine3d(matrix);
}

}  // namespace

Eigen::Affine3d read_transform(const JsonValue& object) {
    const auto matrix = object.find("matrix");
    const auto translation = object.find("translation");
    const auto rotation = object.find("rotation");
    const auto scale = object.find("scale");
    if (matrix && (translation || rotation || scale))
        matrix->reject("give either 'matrix' or 'translation', 'rotation', 'scale'");
    if (matrix) return read_matrix(*matrix);
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    if (translation) transform.translate(read_vec3(*translation, largest_factor));
    if (rotation) transform.rotate(read_rotation(*rotation));
    if (scale) transform.scale(read_scale(*scale));
    return transform;
}

}  // namespace patchlight::server
