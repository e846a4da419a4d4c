#include "server/transform_json.h"

#include "server/json_vectors.h"
#include "server/wording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace patchlight::server {
namespace {

constexpr double largest_factor = 1e9;

constexpr double degree = std::numbers::pi / 180.0;

std::string quaternion_text(const Eigen::Quaterniond& rotation) {
    std::string text;
    for (const double number : {rotation.x(), rotation.y(), rotation.z(), rotation.w()})
        text += (text.empty() ? "[" : ", ") + number_text(std::round(number * 1e6) / 1e6 + 0.0);
    return text + "]";
}

bool is_axis(const Vec3& vector) { return std::abs(vector.norm() - 1.0) < 1e-3; }

/// What four numbers that are no unit quaternion probably mean.
std::string rotation_meant(const std::array<double, 4>& n) {
    const Vec3 first(n[0], n[1], n[2]), last(n[1], n[2], n[3]);
    const auto turned = [](const Vec3& axis, double degrees) {
        return "; " + number_text(degrees) + "° about that axis is " +
               quaternion_text(
                   Eigen::Quaterniond(Eigen::AngleAxisd(degrees * degree, axis.normalized())));
    };
    if (is_axis(first) && std::abs(n[3]) > 2.0) return turned(first, n[3]);
    if (is_axis(last) && std::abs(n[0]) > 2.0) return turned(last, n[0]);
    const double largest =
        std::max({std::abs(n[0]), std::abs(n[1]), std::abs(n[2]), std::abs(n[3])});
    if (largest > 2.0)
        return "; degrees are not read: 90° about z is [0, 0, 0.707107, 0.707107], the axis times "
               "sin 45° and then cos 45°";
    const Eigen::Quaterniond given(n[3], n[0], n[1], n[2]);
    return given.norm() > 0.0 ? "; made one, it is " + quaternion_text(given.normalized()) : "";
}

/// Three numbers are angles about x, y and z, or so it seems.
std::string angles_meant(const JsonValue& value) {
    if (value.size() != 3 || !value[0].is_number() || !value[1].is_number() ||
        !value[2].is_number())
        return "";
    constexpr Range angle{-1e6, 1e6};
    const double x = value[0].number(angle), y = value[1].number(angle), z = value[2].number(angle);
    const Eigen::Quaterniond rotation = Eigen::AngleAxisd(z * degree, Vec3::UnitZ()) *
                                        Eigen::AngleAxisd(y * degree, Vec3::UnitY()) *
                                        Eigen::AngleAxisd(x * degree, Vec3::UnitX());
    return "; if they are degrees about x, then y, then z, it is " + quaternion_text(rotation);
}

Eigen::Quaterniond read_rotation(const JsonValue& value) {
    if (value.size() != 4)
        value.reject("must have 4 numbers (a unit quaternion x, y, z, w), not " +
                     std::to_string(value.size()) + angles_meant(value));
    constexpr Range component{-1e6, 1e6};
    std::array<double, 4> numbers{};
    for (std::size_t k = 0; k < 4; ++k) numbers[k] = value[k].number(component);
    const Eigen::Quaterniond rotation(numbers[3], numbers[0], numbers[1], numbers[2]);
    constexpr double rounding = 1e-3;  // of a quaternion written with few digits
    if (std::abs(rotation.norm() - 1.0) > rounding)
        value.reject("must be a unit quaternion x, y, z, w; its length is " +
                     number_text(rotation.norm()) + rotation_meant(numbers));
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
