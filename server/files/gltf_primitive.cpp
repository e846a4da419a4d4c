#include "server/files/gltf_primitive.h"

#include "server/files/imported_geometry.h"

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

std::vector<Vec3> read_positions(const JsonValue& primitive, GltfAccessors& accessors) {
    const JsonValue attributes = primitive.at("attributes");
    const JsonValue reference = attributes.at("POSITION");
    const std::vector<double> numbers = accessors.numbers(reference, 3);
    std::vector<Vec3> positions;
    positions.reserve(numbers.size() / 3);
    for (std::size_t k = 0; k + 2 < numbers.size(); k += 3) {
        positions.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2]);
        if (!(positions.back().array().abs() <= largest_file_coordinate).all())
            reference.reject("a coordinate is beyond ±1e+15");
    }
    return positions;
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

GltfTriangles read_gltf_primitive(const JsonValue& primitive, GltfAccessors& accessors) {
    const auto mode = primitive.find("mode");
    const std::int64_t code = mode ? mode->whole_number(0, 6) : 4;
    constexpr std::int64_t first_with_area = 4;
    GltfTriangles read;
    if (code < first_with_area) return read;
    read.positions = read_positions(primitive, accessors);
    const auto corners = read_corners(primitive, read.positions.size(), accessors);
    if (corners.size() < 3 || (code == 4 && corners.size() % 3 != 0))
        primitive.reject("has " + std::to_string(corners.size()) +
                         " corners; triangles take three each");
    read.triangles = triangles_of(static_cast<Mode>(code), corners);
    return read;
}

}  // namespace patchlight::server
