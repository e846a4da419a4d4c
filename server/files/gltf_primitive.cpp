#include "server/files/gltf_primitive.h"

#include "server/files/imported_geometry.h"

#include <algorithm>
#include <numeric>

namespace patchlight::server {
namespace {

enum class Mode : std::uint8_t { triangles = 4, strip = 5, fan = 6 };

std::vector<std::array<std::uint32_t, 3>> triangles_of(Mode mode,
                                                       const std::vector<std::uint32_t>& corners) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    switch (mode) {
        case Mode::triangles:
            for (std::size_t k = 0; k + 2 < corners.size(); k += 3)
                triangles.push_back({corners[k], corners[k + 1], corners[k + 2]});
            return triangles;
        case Mode::strip:  // every other triangle runs backwards
            for (std::size_t k = 0; k + 2 < corners.size(); ++k)
                triangles.push_back({corners[k], corners[k + 1 + k % 2], corners[k + 2 - k % 2]});
            return triangles;
        case Mode::fan:
            for (std::size_t k = 1; k + 1 < corners.size(); ++k)
                triangles.push_back({corners[0], corners[k], corners[k + 1]});
            return triangles;
    }
    throw std::logic_error("a primitive mode without triangles");
}

std::vector<Vec3> read_points(const JsonValue& reference, GltfAccessors& accessors) {
    const std::vector<double> numbers = accessors.numbers(reference, 3);
    std::vector<Vec3> points;
    points.reserve(numbers.size() / 3);
    for (std::size_t k = 0; k + 2 < numbers.size(); k += 3)
        points.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2]);
    return points;
}

void require_data(const JsonValue& primitive, const JsonValue& reference,
                  const GltfAccessors& accessors) {
    const auto extensions = primitive.find("extensions");
    const bool is_compressed = extensions && extensions->has("KHR_draco_mesh_compression");
    if (is_compressed && !accessors.has_data(reference))
        primitive.reject(
            "has its data compressed alone (KHR_draco_mesh_compression), which is not read; "
            "export the file without");
}

std::vector<Vec3> read_positions(const JsonValue& primitive, std::span<const double> weights,
                                 GltfAccessors& accessors) {
    const JsonValue attributes = primitive.at("attributes");
    const JsonValue reference = attributes.at("POSITION");
    require_data(primitive, reference, accessors);
    std::vector<Vec3> positions = read_points(reference, accessors);
    if (const auto targets = primitive.find("targets"))
        for (std::size_t k = 0; k < std::min(targets->size(), weights.size()); ++k) {
            const JsonValue target = (*targets)[k];
            const auto moved = target.find("POSITION");
            if (!moved || weights[k] == 0.0) continue;
            const std::vector<Vec3> offsets = read_points(*moved, accessors);
            if (offsets.size() != positions.size())
                moved->reject("moves " + std::to_string(offsets.size()) + " of " +
                              std::to_string(positions.size()) + " vertices");
            for (std::size_t i = 0; i < positions.size(); ++i)
                positions[i] += weights[k] * offsets[i];
        }
    for (const Vec3& position : positions)
        if (!(position.array().abs() <= largest_file_coordinate).all())
            reference.reject("a coordinate is beyond ±1e+15");
    return positions;
}

/// Whether vertices have colours that are not all white.
bool has_colours(const JsonValue& primitive, GltfAccessors& accessors) {
    const JsonValue attributes = primitive.at("attributes");
    const auto reference = attributes.find("COLOR_0");
    if (!reference) return false;
    const std::size_t components = accessors.components_of(*reference);
    if (components != 3 && components != 4) return false;
    const std::vector<double> numbers = accessors.numbers(*reference, components);
    for (std::size_t k = 0; k < numbers.size(); ++k)
        if (k % components < 3 && numbers[k] < 0.999) return true;
    return false;
}

std::vector<std::uint32_t> read_corners(const JsonValue& primitive, std::size_t position_count,
                                        GltfAccessors& accessors) {
    const auto reference = primitive.find("indices");
    if (!reference) {
        std::vector<std::uint32_t> all(position_count);
        std::iota(all.begin(), all.end(), 0u);
        return all;
    }
    std::vector<std::uint32_t> corners = accessors.indices(*reference);
    for (const std::uint32_t corner : corners)
        if (corner >= position_count)
            reference->reject("vertex " + std::to_string(corner) + " does not exist; there are " +
                              std::to_string(position_count) + ", numbered from 0");
    return corners;
}

}  // namespace

GltfTriangles read_gltf_primitive(const JsonValue& primitive, std::span<const double> weights,
                                  GltfAccessors& accessors) {
    const auto mode = primitive.find("mode");
    const std::int64_t code = mode ? mode->whole_number(0, 6) : 4;
    constexpr std::int64_t first_with_area = 4;
    GltfTriangles read;
    if (code < first_with_area) return read;
    read.positions = read_positions(primitive, weights, accessors);
    read.has_colours = has_colours(primitive, accessors);
    const auto corners = read_corners(primitive, read.positions.size(), accessors);
    if (corners.size() < 3 || (code == 4 && corners.size() % 3 != 0))
        primitive.reject("has " + std::to_string(corners.size()) +
                         " corners; triangles take three each");
    read.triangles = triangles_of(static_cast<Mode>(code), corners);
    return read;
}

}  // namespace patchlight::server
