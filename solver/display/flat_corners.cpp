#include "solver/display/flat_corners.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace patchlight {

namespace {

struct PatchEdge {  // of an edge: the patch that has it, its ends at corners `low` and `high`
    VertexIndex a = 0, b = 0;  // a < b
    std::uint32_t plane = 0;
    std::uint32_t at_a = 0, at_b = 0;  // corner numbers before joining, 4 * patch + corner
    std::uint32_t number = 0;          // 4 * patch + the corner it goes on from
    auto key() const { return std::tuple(a, b, plane); }
};

std::vector<PatchEdge> find_sides(const PatchMesh& mesh, const PlaneGroups& planes) {
    std::vector<PatchEdge> sides;
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        const Patch& patch = mesh.patches[i];
        if (patch.covered) continue;
        const std::size_t n = patch.corner_count();
        for (std::size_t k = 0; k < n; ++k) {
            PatchEdge side;
            const std::size_t l = (k + 1) % n;
            side.a = patch.vertices[k], side.b = patch.vertices[l];
            side.at_a = static_cast<std::uint32_t>(4 * i + k);
            side.at_b = static_cast<std::uint32_t>(4 * i + l);
            side.plane = planes.of_surface[patch.surface];
            if (side.a > side.b) {
                std::swap(side.a, side.b);
                std::swap(side.at_a, side.at_b);
            }
            side.number = static_cast<std::uint32_t>(4 * i + k);
            sides.push_back(side);
        }
    }
    std::sort(sides.begin(), sides.end(), [](const PatchEdge& p, const PatchEdge& q) {
        return std::tuple(p.key(), p.at_a) < std::tuple(q.key(), q.at_a);
    });
    return sides;
}

/// Per side, in their order. The other sides of the same polygons divide nothing.
std::vector<bool> find_creases(const PatchMesh& mesh, const PlaneGroups& planes,
                               const std::vector<PatchEdge>& sides) {
    std::vector<bool> creases(sides.size());
    for (std::size_t first = 0, end = 0; first < sides.size(); first = end) {
        const std::uint32_t plane = sides[first].plane, other_side = planes.other_side[plane];
        bool crease = mesh.is_crease(sides[first].a, sides[first].b);
        for (end = first;
             end < sides.size() && sides[end].a == sides[first].a && sides[end].b == sides[first].b;
             ++end)
            crease = crease || (sides[end].plane != plane && sides[end].plane != other_side);
        std::fill(creases.begin() + static_cast<std::ptrdiff_t>(first),
                  creases.begin() + static_cast<std::ptrdiff_t>(end), crease);
    }
    return creases;
}

}  // namespace

FlatCorners find_flat_corners(const PatchMesh& mesh, const PlaneGroups& planes) {
    std::vector<std::uint32_t> leader(4 * mesh.size());
    std::iota(leader.begin(), leader.end(), 0u);
    const auto root = [&](std::uint32_t c) {
        while (leader[c] != c) c = leader[c] = leader[leader[c]];
        return c;
    };
    const auto join = [&](std::uint32_t c, std::uint32_t d) {
        const auto [low, high] = std::minmax({root(c), root(d)});
        leader[high] = low;
    };
    FlatCorners corners;
    corners.creases.assign(mesh.size(), 0);
    const std::vector<PatchEdge> sides = find_sides(mesh, planes);
    const std::vector<bool> creases = find_creases(mesh, planes, sides);
    for (std::size_t k = 0; k < sides.size(); ++k) {
        if (creases[k])
            corners.creases[sides[k].number / 4] |=
                static_cast<std::uint8_t>(1u << (sides[k].number % 4));
        if (creases[k] || k == 0 || sides[k].key() != sides[k - 1].key()) continue;
        join(sides[k].at_a, sides[k - 1].at_a);
        join(sides[k].at_b, sides[k - 1].at_b);
    }
    constexpr std::uint32_t unnumbered = ~0u;
    std::vector<std::uint32_t> number(leader.size(), unnumbered);
    corners.of_patch.resize(mesh.size());
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        const Patch& patch = mesh.patches[i];
        if (patch.covered) continue;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t corner = std::min(k, patch.corner_count() - 1);
            std::uint32_t& found = number[root(static_cast<std::uint32_t>(4 * i + corner))];
            if (found == unnumbered) found = static_cast<std::uint32_t>(corners.count++);
            corners.of_patch[i][k] = found;
        }
    }
    return corners;
}

}  // namespace patchlight
