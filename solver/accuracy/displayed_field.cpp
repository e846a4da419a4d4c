#include "solver/accuracy/displayed_field.h"

#include <algorithm>
#include <limits>

namespace patchlight {

namespace {

constexpr std::uint32_t leaf_size = 4;           // triangles
constexpr double enough = -1e-12;                // of a weight: inside but for rounding [1]
constexpr double slacks[] = {1e-9, 1e-6, 1e-2};  // of the surface's size, tried one by one [1]

double size_of(const Vec2& low, const Vec2& high) { return (high - low).norm(); }

/// Shares of the corners in a point; they sum to 1.
std::array<double, 3> weights(const std::array<Vec2, 3>& corners, const Vec2& p) {
    const auto& [a, b, c] = corners;
    const double whole = turn(a, b, c);
    if (!(whole > 0.0)) return {1.0, -1.0, 1.0};  // without an area it holds nothing
    const double u = turn(b, c, p) / whole, v = turn(c, a, p) / whole;
    return {u, v, 1.0 - u - v};
}

}  // namespace

DisplayedField::DisplayedField(const Scene& scene, const PatchMesh& mesh,
                               const DisplayMesh& display)
    : surfaces_(scene.surfaces.size()),
      radiosity_(display.radiosity),
      vertices_(display.triangles) {
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s)
        surfaces_[s].frame = frame_of(scene.surfaces[s].corners[0], scene.surfaces[s].normal);
    for (std::size_t t = 0; t < display.triangles.size(); ++t) {
        Sheet& sheet = surfaces_[mesh.patches[display.patch[t]].surface];
        Triangle triangle{static_cast<std::uint32_t>(t), {}};
        for (std::size_t k = 0; k < 3; ++k)
            triangle.corners[k] = sheet.frame.flat(display.positions[display.triangles[t][k]]);
        sheet.triangles.push_back(triangle);
    }
    for (Sheet& sheet : surfaces_)
        if (!sheet.triangles.empty())
            grow(sheet, 0, static_cast<std::uint32_t>(sheet.triangles.size()));
}

/// Halves the triangles along the longer side of their box, by the places of their centres.
std::uint32_t DisplayedField::grow(Sheet& sheet, std::uint32_t first, std::uint32_t last) {
    const auto number = static_cast<std::uint32_t>(sheet.nodes.size());
    Node node{Vec2::Constant(std::numeric_limits<double>::infinity()),
              Vec2::Constant(-std::numeric_limits<double>::infinity()), first, last - first};
    for (std::uint32_t t = first; t < last; ++t)
        for (const Vec2& corner : sheet.triangles[t].corners) {
            node.low = node.low.cwiseMin(corner);
            node.high = node.high.cwiseMax(corner);
        }
    sheet.nodes.push_back(node);
    if (node.count <= leaf_size) return number;
    const Eigen::Index axis = node.high.x() - node.low.x() >= node.high.y() - node.low.y() ? 0 : 1;
    const std::uint32_t middle = first + node.count / 2;
    const auto place = [axis](const Triangle& triangle) {
        return triangle.corners[0][axis] + triangle.corners[1][axis] + triangle.corners[2][axis];
    };
    std::nth_element(sheet.triangles.begin() + first, sheet.triangles.begin() + middle,
                     sheet.triangles.begin() + last,
                     [&](const Triangle& a, const Triangle& b) { return place(a) < place(b); });
    grow(sheet, first, middle);
    const std::uint32_t second = grow(sheet, middle, last);
    sheet.nodes[number].first = second;
    sheet.nodes[number].count = 0;
    return number;
}

/// The triangle that holds the point, or that it misses by least of those near it.
DisplayedField::Found DisplayedField::find(const Sheet& sheet, const Vec2& point, double slack) {
    Found best;
    std::vector<std::uint32_t> open{0};
    while (!open.empty()) {
        const std::uint32_t number = open.back();
        open.pop_back();
        const Node& node = sheet.nodes[number];
        if ((point.array() < node.low.array() - slack).any() ||
            (point.array() > node.high.array() + slack).any())
            continue;
        if (node.count == 0) {
            open.push_back(node.first);
            open.push_back(number + 1);
            continue;
        }
        for (std::uint32_t t = node.first; t < node.first + node.count; ++t) {
            const std::array<double, 3> weight = weights(sheet.triangles[t].corners, point);
            const double inside = *std::min_element(weight.begin(), weight.end());
            if (best.triangle && inside <= best.inside) continue;
            best = {&sheet.triangles[t], weight, inside};
            if (inside >= enough) return best;
        }
    }
    return best;
}

std::optional<DisplayedField::Place> DisplayedField::locate(SurfaceIndex s,
                                                            const Vec3& position) const {
    const Sheet& sheet = surfaces_[s];
    if (sheet.nodes.empty()) return std::nullopt;
    const Vec2 point = sheet.frame.flat(position);
    const double size = size_of(sheet.nodes[0].low, sheet.nodes[0].high);
    Found found;
    for (const double slack : slacks)
        if (found = find(sheet, point, slack * size); found.triangle) break;
    if (!found.triangle) found = find(sheet, point, std::numeric_limits<double>::infinity());
    double sum = 0.0;
    for (double& weight : found.weight) sum += weight = std::max(0.0, weight);
    for (double& weight : found.weight) weight /= sum;
    return Place{found.triangle->number, found.weight};
}

Rgb DisplayedField::radiosity(SurfaceIndex s, const Vec3& position) const {
    const std::optional<Place> place = locate(s, position);
    Rgb value = Rgb::Zero();
    for (std::size_t k = 0; place && k < 3; ++k)
        value += place->weight[k] * radiosity_[vertices_[place->triangle][k]];
    return value;
}

}  // namespace patchlight
