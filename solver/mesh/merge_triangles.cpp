#include "solver/mesh/merge_triangles.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace patchlight {

namespace {

constexpr double worst_corner = 0.65;  // |cosine| of a quad's corner: 49 to 131 degrees [1]

constexpr double ties = 1e9;  // quads as rectangular to 1e-9 are chosen by number, not by rounding

using Quad = std::array<std::uint32_t, 4>;

Quad quad_of(const Triangulation::Triangle& here, int edge, std::uint32_t apex_beyond) {
    const auto vertex = [&](int k) { return static_cast<std::uint32_t>(here.vertices[k % 3]); };
    return {vertex(edge), vertex(edge + 1), apex_beyond, vertex(edge + 2)};
}

/// Largest |cosine| of its corners; above 1 if it is not convex.
double skewness(const std::vector<Vec2>& points, const Quad& quad) {
    double worst = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec2 before = points[quad[(k + 3) % 4]] - points[quad[k]];
        const Vec2 after = points[quad[(k + 1) % 4]] - points[quad[k]];
        if (after.x() * before.y() - after.y() * before.x() <= 0.0) return 2.0;
        worst = std::max(worst, std::abs(before.dot(after)) / (before.norm() * after.norm()));
    }
    return worst;
}

}  // namespace

MergedFaces merge_triangles(const Triangulation& triangulation) {
    const auto& triangles = triangulation.triangles();
    std::vector<std::tuple<double, int, int, Quad>> pairs;  // skewness, both triangles, the quad
    for (int t = 0; t < static_cast<int>(triangles.size()); ++t)
        for (int k = 0; k < 3; ++k) {
            const int s = triangles[t].across[k];
            if (s <= t || triangles[t].fixed[k]) continue;
            for (int l = 0; l < 3; ++l) {
                if (triangles[s].across[l] != t) continue;
                const Quad quad =
                    quad_of(triangles[t], k, static_cast<std::uint32_t>(triangles[s].vertices[l]));
                const double skew = skewness(triangulation.points(), quad);
                if (skew <= worst_corner)
                    pairs.emplace_back(std::round(skew * ties) / ties, t, s, quad);
            }
        }
    std::sort(pairs.begin(), pairs.end());
    std::vector<bool> taken(triangles.size(), false);
    MergedFaces merged;
    for (const auto& [skew, t, s, quad] : pairs) {
        if (taken[t] || taken[s]) continue;
        taken[t] = taken[s] = true;
        merged.faces.push_back(quad);
    }
    for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
        if (taken[t]) continue;
        const auto& v = triangles[t].vertices;
        const auto last = static_cast<std::uint32_t>(v[2]);
        merged.faces.push_back(
            {static_cast<std::uint32_t>(v[0]), static_cast<std::uint32_t>(v[1]), last, last});
    }
    return merged;
}

}  // namespace patchlight
