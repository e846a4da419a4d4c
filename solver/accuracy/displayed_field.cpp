#include "solver/accuracy/displayed_field.h"

#include <oneapi/tbb/parallel_for_each.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace patchlight {

namespace {

constexpr std::uint32_t leaf_size = 4;           // triangles
constexpr std::size_t most_depth = 40;           // 2^32 triangles, halved
constexpr double enough = -1e-12;                // of a weight: inside but for rounding [1]
constexpr double slacks[] = {1e-9, 1e-6, 1e-2};  // of the surface's size, tried one by one [1]

double size_of(const Vec2& low, const Vec2& high) { return (high - low).norm(); }

}  // namespace

/// One without an area holds nothing.
DisplayedField::Triangle::Triangle(std::uint32_t of_display, const std::array<Vec2, 3>& corners)
    : number(of_display), a(corners[0]), b(corners[1]), c(corners[2]) {
    const double whole = turn(a, b, c);
    const double over = whole > 0.0 ? 1.0 / whole : std::numeric_limits<double>::quiet_NaN();
    first = over * Vec2(b.y() - c.y(), c.x() - b.x());
    second = over * Vec2(c.y() - a.y(), a.x() - c.x());
}

DisplayedField::DisplayedField(const Scene& scene, const PatchMesh& mesh,
                               const DisplayMesh& display)
    : surfaces_(scene.surfaces.size()),
      radiosity_(display.radiosity),
      vertices_(display.triangles) {
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s)
        surfaces_[s].frame = frame_of(scene.surfaces[s].corners[0], scene.surfaces[s].normal);
    for (std::size_t t = 0; t < display.triangles.size(); ++t) {
        Sheet& sheet = surfaces_[mesh.patches[display.patch[t]].surface];
        const auto corner = [&](std::size_t k) {
            return sheet.frame.flat(display.positions[display.triangles[t][k]]);
        };
        sheet.triangles.push_back(
            {static_cast<std::uint32_t>(t), std::array<Vec2, 3>{corner(0), corner(1), corner(2)}});
    }
    tbb::parallel_for_each(surfaces_, [](Sheet& sheet) {
        if (!sheet.triangles.empty())
            grow(sheet, 0, static_cast<std::uint32_t>(sheet.triangles.size()));
    });
}

/// Halves the triangles along the longer side of their box, by the places of their centres.
std::uint32_t DisplayedField::grow(Sheet& sheet, std::uint32_t first, std::uint32_t last) {
    const auto number = static_cast<std::uint32_t>(sheet.nodes.size());
    Node node{Vec2::Constant(std::numeric_limits<double>::infinity()),
              Vec2::Constant(-std::numeric_limits<double>::infinity()), first, last - first};
    for (std::uint32_t t = first; t < last; ++t)
        for (const Vec2& corner :
             {sheet.triangles[t].a, sheet.triangles[t].b, sheet.triangles[t].c}) {
            node.low = node.low.cwiseMin(corner);
            node.high = node.high.cwiseMax(corner);
        }
    sheet.nodes.push_back(node);
    if (node.count <= leaf_size) return number;
    const Eigen::Index axis = node.high.x() - node.low.x() >= node.high.y() - node.low.y() ? 0 : 1;
    const std::uint32_t middle = first + node.count / 2;
    const auto place = [axis](const Triangle& triangle) {
        return triangle.a[axis] + triangle.b[axis] + triangle.c[axis];
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
    std::array<std::uint32_t, most_depth> open{0};  // halves that wait: one a level
    for (std::size_t waiting = 1; waiting > 0;) {
        const std::uint32_t number = open[--waiting];
        const Node& node = sheet.nodes[number];
        const double x = point.x(), y = point.y();
        if (x < node.low.x() - slack || x > node.high.x() + slack || y < node.low.y() - slack ||
            y > node.high.y() + slack)
            continue;
        if (node.count == 0) {
            open[waiting++] = node.first;
            open[waiting++] = number + 1;
            continue;
        }
        for (std::uint32_t t = node.first; t < node.first + node.count; ++t) {
            const std::array<double, 3> weight = sheet.triangles[t].weights(point);
            const double inside = std::min({weight[0], weight[1], weight[2]});
            if (best.triangle ? !(inside > best.inside) : std::isnan(inside)) continue;
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
    if (!found.triangle) return std::nullopt;
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
