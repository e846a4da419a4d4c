#include "solver/mesh/edge_divisions.h"

#include "solver/mesh/edge_stops.h"
#include "solver/mesh/grid_shape.h"
#include "solver/mesh/welder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace patchlight {

namespace {

constexpr double largest_aspect = 8.0;      // length over width that slivers are cut down to [1]
constexpr int most_parts_for_aspect = 256;  // a needle is not cut finer than this for its shape
constexpr double rounding = 1e-9;           // 10 parts of 0.1 fit an edge of 1

int parts_for(double length, double longest) {
    return std::max(1, static_cast<int>(std::ceil(length / longest - rounding)));
}

/// Parts an edge needs so that patches `width` across are no slivers.
int parts_for_aspect(double length, double width) {
    if (!(width > 0.0)) return 1;
    return std::min(parts_for(length, largest_aspect * width), most_parts_for_aspect);
}

struct Chords {  // edges that must have one count (union-find)
    std::vector<std::uint32_t> parent;
    explicit Chords(std::size_t n) : parent(n) { std::iota(parent.begin(), parent.end(), 0u); }
    std::uint32_t root(std::uint32_t e) {
        while (parent[e] != e) e = parent[e] = parent[parent[e]];
        return e;
    }
    void tie(std::uint32_t a, std::uint32_t b) {
        parent[std::max(root(a), root(b))] = std::min(root(a), root(b));
    }
};

}  // namespace

double estimate_parts(double length, double patch_size, double width) {
    const double for_aspect = std::min(std::ceil(length / (largest_aspect * width) - rounding),
                                       static_cast<double>(most_parts_for_aspect));
    return std::max({1.0, std::ceil(length / patch_size - rounding), for_aspect});
}

EdgeDivisions::EdgeDivisions(const Scene& scene, const std::vector<std::vector<Segment>>& creases,
                             const std::vector<bool>& hidden, double patch_size, bool cut_slivers) {
    const LocalTolerance tolerance(scene);
    weld(scene, tolerance);
    find_edges(scene, hidden);
    find_stops(scene, tolerance, creases);
    choose_grids(scene, creases);
    count_parts(scene, patch_size, cut_slivers);
    place_points(patch_size);
}

void EdgeDivisions::weld(const Scene& scene, const LocalTolerance& tolerance) {
    std::vector<double> reach;
    for (std::size_t f = 0; f < tolerance.frames().size(); ++f)
        reach.push_back(tolerance.same_point(static_cast<FrameIndex>(f)));
    Welder welder(std::move(reach));
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        first_corner_.push_back(corners_.size());
        for (const Vec3& p : scene.surfaces[s].corners)
            corners_.push_back(welder.add(p, tolerance.frame_of(s)));
    }
    first_corner_.push_back(corners_.size());
    positions_ = welder.take_points();
}

void EdgeDivisions::find_edges(const Scene& scene, const std::vector<bool>& hidden) {
    std::unordered_map<std::uint64_t, std::uint32_t> known;
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        const std::size_t n = scene.surfaces[s].corners.size();
        const double coarseness =
            hidden[s] ? std::numeric_limits<double>::infinity() : scene.surfaces[s].coarseness;
        for (std::size_t k = 0; k < n; ++k) {
            const VertexIndex a = corner(s, k), b = corner(s, (k + 1) % n);
            const auto [lo, hi] = std::minmax(a, b);
            const auto [at, fresh] = known.try_emplace((std::uint64_t{lo} << 32) | hi,
                                                       static_cast<std::uint32_t>(ends_.size()));
            if (fresh) ends_.emplace_back(lo, hi);
            if (fresh) coarseness_.push_back(coarseness);
            coarseness_[at->second] = std::min(coarseness_[at->second], coarseness);
            edges_.push_back(at->second);
        }
    }
}

void EdgeDivisions::find_stops(const Scene& scene, const LocalTolerance& tolerance,
                               const std::vector<std::vector<Segment>>& creases) {
    stops_.resize(ends_.size());
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        const double reach = tolerance.at(s);
        for (const EdgeStop& stop : find_edge_stops(scene.surfaces[s], creases[s], reach)) {
            const std::uint32_t e = edges_[first_corner_[s] + stop.edge];
            const Vec3 &a = positions_[ends_[e].first], &b = positions_[ends_[e].second];
            const double length = (b - a).norm(),
                         place = (stop.point - a).dot(b - a) / (length * length);
            std::vector<double>& stops = stops_[e];
            const bool known = std::any_of(stops.begin(), stops.end(), [&](double other) {
                return std::abs(other - place) * length <= reach;
            });
            if (!known) stops.insert(std::upper_bound(stops.begin(), stops.end(), place), place);
        }
    }
}

void EdgeDivisions::choose_grids(const Scene& scene,
                                 const std::vector<std::vector<Segment>>& creases) {
    gridded_.resize(scene.surfaces.size());
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        bool plain = creases[s].empty();
        for (std::size_t at = first_corner_[s]; at < first_corner_[s + 1]; ++at)
            plain = plain && stops_[edges_[at]].empty();
        gridded_[s] = plain && fits_a_grid(scene.surfaces[s]);
    }
}

void EdgeDivisions::count_parts(const Scene& scene, double patch_size, bool cut_slivers) {
    Chords chords(ends_.size());
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s)
        if (gridded_[s])
            for (std::size_t k = 0; k < 2; ++k)
                chords.tie(edges_[first_corner_[s] + k], edges_[first_corner_[s] + k + 2]);
    std::vector<double> longest(ends_.size(), 0.0);  // edge of each chord [m]
    std::vector<int> parts(ends_.size(), 1);
    for (std::uint32_t e = 0; e < ends_.size(); ++e) {
        const double length = (positions_[ends_[e].first] - positions_[ends_[e].second]).norm();
        const std::uint32_t root = chords.root(e);
        longest[root] = std::max(longest[root], length);
        parts[root] = std::max(parts[root], parts_for(length, coarseness_[e] * patch_size));
    }
    const auto raise = [&](std::uint32_t root, double width) {
        parts[root] = std::max(parts[root], parts_for_aspect(longest[root], width));
    };
    const int passes = cut_slivers ? 3 : 0;  // a finer chord makes narrower cells beside it
    for (int pass = 0; pass < passes; ++pass)
        for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
            const std::size_t first = first_corner_[s], n = first_corner_[s + 1] - first;
            if (gridded_[s]) {
                const std::uint32_t u = chords.root(edges_[first]),
                                    v = chords.root(edges_[first + 1]);
                const double coarseness = std::max(1.0, scene.surfaces[s].coarseness);
                raise(u, coarseness * longest[v] / parts[v]);
                raise(v, coarseness * longest[u] / parts[u]);
            } else {
                const double width =
                    std::max(1.0, scene.surfaces[s].coarseness) * width_of(scene.surfaces[s]);
                for (std::size_t k = 0; k < n; ++k) raise(chords.root(edges_[first + k]), width);
            }
        }
    parts_.resize(ends_.size());
    for (std::uint32_t e = 0; e < ends_.size(); ++e) parts_[e] = parts[chords.root(e)];
}

void EdgeDivisions::place_points(double patch_size) {
    places_.resize(ends_.size());
    first_inner_.resize(ends_.size());
    vertex_count_ = positions_.size();
    for (std::size_t e = 0; e < ends_.size(); ++e) {
        const double length = (positions_[ends_[e].first] - positions_[ends_[e].second]).norm();
        std::vector<double> stops = stops_[e];
        stops.push_back(1.0);
        double from = 0.0;
        for (const double to : stops) {
            const int parts = stops.size() == 1
                                  ? parts_[e]
                                  : parts_for((to - from) * length, coarseness_[e] * patch_size);
            for (int k = 1; k < parts; ++k) places_[e].push_back(from + (to - from) * k / parts);
            if (to < 1.0) places_[e].push_back(to);
            from = to;
        }
        first_inner_[e] = static_cast<VertexIndex>(vertex_count_);
        vertex_count_ += places_[e].size();
    }
}

std::vector<VertexIndex> EdgeDivisions::points(SurfaceIndex s, std::size_t k) const {
    const std::uint32_t e = edges_[first_corner_[s] + k];
    std::vector<VertexIndex> points{ends_[e].first};
    for (std::size_t i = 0; i < places_[e].size(); ++i)
        points.push_back(first_inner_[e] + static_cast<VertexIndex>(i));
    points.push_back(ends_[e].second);
    if (corner(s, k) != ends_[e].first) std::reverse(points.begin(), points.end());
    return points;
}

std::vector<Vec3> EdgeDivisions::vertices() const {
    std::vector<Vec3> vertices = positions_;
    vertices.reserve(vertex_count_);
    for (std::size_t e = 0; e < ends_.size(); ++e) {
        const Vec3 &a = positions_[ends_[e].first], &b = positions_[ends_[e].second];
        for (const double place : places_[e]) vertices.push_back(a + (b - a) * place);
    }
    return vertices;
}

}  // namespace patchlight
