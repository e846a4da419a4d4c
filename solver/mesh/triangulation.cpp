#include "solver/mesh/triangulation.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace patchlight {

namespace {

constexpr double relative_tolerance = 1e-9;  // of the polygon's size [1]

/// Positive if d is inside the circle through a, b, c (counter-clockwise).
double in_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    const Vec2 p = a - d, q = b - d, r = c - d;
    const double pp = p.squaredNorm(), qq = q.squaredNorm(), rr = r.squaredNorm();
    return p.x() * (q.y() * rr - r.y() * qq) - p.y() * (q.x() * rr - r.x() * qq) +
           pp * (q.x() * r.y() - r.x() * q.y());
}

}  // namespace

Triangulation::Triangulation(std::span<const Vec2> polygon)
    : points_(polygon.begin(), polygon.end()) {
    Eigen::AlignedBox2d box;
    for (const Vec2& p : points_) box.extend(p);
    tolerance_ = relative_tolerance * box.diagonal().norm();
    std::map<std::pair<int, int>, std::pair<int, int>>
        open;  // edge -> triangle, its vertex opposite
    for (const auto& ear : triangulate(points_)) {
        const int t = static_cast<int>(triangles_.size());
        triangles_.push_back(
            {{static_cast<int>(ear[0]), static_cast<int>(ear[1]), static_cast<int>(ear[2])},
             {none, none, none},
             {}});
        for (int k = 0; k < 3; ++k) {
            const int a = triangles_[t].vertices[after(k)], b = triangles_[t].vertices[before(k)];
            const auto twin = open.find({b, a});
            if (twin == open.end()) {
                open[{a, b}] = {t, k};
                continue;
            }
            triangles_[t].across[k] = twin->second.first;
            triangles_[twin->second.first].across[twin->second.second] = t;
            open.erase(twin);
        }
    }
    ok_ = triangles_.size() + 2 == points_.size();
    std::vector<std::pair<int, int>> suspects;
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t)
        for (int k = 0; k < 3; ++k) {
            triangles_[t].fixed[k] = triangles_[t].across[k] == none;
            suspects.emplace_back(t, k);
        }
    legalise(std::move(suspects));
}

std::optional<Triangulation::Place> Triangulation::place_in(int t, const Vec2& p) const {
    const Triangle& triangle = triangles_[t];
    for (int k = 0; k < 3; ++k)
        if ((points_[triangle.vertices[k]] - p).norm() <= tolerance_)
            return Place{t, none, triangle.vertices[k]};
    int on = none;
    for (int k = 0; k < 3; ++k) {
        const Vec2 &a = points_[triangle.vertices[after(k)]],
                   &b = points_[triangle.vertices[before(k)]];
        const double height = turn(a, b, p) / (b - a).norm();
        if (height < -tolerance_) return std::nullopt;
        if (height <= tolerance_) on = k;
    }
    return Place{t, on, none};
}

Triangulation::Place Triangulation::locate(const Vec2& p) const {
    int t = last_;
    for (std::size_t step = 0; step < triangles_.size(); ++step) {
        if (const auto place = place_in(t, p)) return *place;
        int onward = none;
        for (int k = 0; k < 3 && onward == none; ++k) {
            const Triangle& triangle = triangles_[t];
            if (turn(points_[triangle.vertices[after(k)]], points_[triangle.vertices[before(k)]],
                     p) < 0.0)
                onward = triangle.across[k];
        }
        if (onward == none) break;  // the walk met the polygon's edge
        t = onward;
    }
    for (t = 0; t < static_cast<int>(triangles_.size()); ++t)
        if (const auto place = place_in(t, p)) return *place;
    return {};
}

std::optional<int> Triangulation::insert(const Vec2& p) {
    const Place place = locate(p);
    if (place.triangle == none) return std::nullopt;
    last_ = place.triangle;
    if (place.vertex != none) return place.vertex;
    const int number = static_cast<int>(points_.size());
    points_.push_back(p);
    if (place.edge == none)
        split_triangle(place.triangle, number);
    else
        split_edge(place.triangle, place.edge, number);
    return number;
}

std::optional<int> Triangulation::split_boundary(int a, int b, const Vec2& p) {
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t)
        for (int k = 0; k < 3; ++k) {
            const Triangle& triangle = triangles_[t];
            if (triangle.across[k] != none || triangle.vertices[after(k)] != a ||
                triangle.vertices[before(k)] != b)
                continue;
            const int number = static_cast<int>(points_.size());
            points_.push_back(p);
            split_edge(t, k, number);
            return number;
        }
    return std::nullopt;
}

void Triangulation::relink(int t, int from, int to) {
    if (t == none) return;
    for (int& neighbour : triangles_[t].across)
        if (neighbour == from) neighbour = to;
}

int Triangulation::edge_towards(int t, int neighbour) const {
    for (int k = 0; k < 3; ++k)
        if (triangles_[t].across[k] == neighbour) return k;
    return none;
}

void Triangulation::split_triangle(int t, int p) {
    const Triangle old = triangles_[t];
    const std::array<int, 3> part{t, static_cast<int>(triangles_.size()),
                                  static_cast<int>(triangles_.size()) + 1};
    triangles_.resize(triangles_.size() + 2);
    for (int k = 0; k < 3; ++k) {  // part k keeps the edge opposite vertex k
        triangles_[part[k]] = {{p, old.vertices[after(k)], old.vertices[before(k)]},
                               {old.across[k], part[after(k)], part[before(k)]},
                               {old.fixed[k], false, false}};
        if (k > 0) relink(old.across[k], t, part[k]);
    }
    legalise({{part[0], 0}, {part[1], 0}, {part[2], 0}});
}

void Triangulation::split_edge(int t, int edge, int p) {
    const int other = triangles_[t].across[edge];
    std::vector<std::pair<int, int>> suspects;
    const auto halve = [&](int s, int k) {  // the triangle s, cut from its vertex k to p
        const Triangle old = triangles_[s];
        const int fresh = static_cast<int>(triangles_.size());
        const int apex = old.vertices[k], a = old.vertices[after(k)], b = old.vertices[before(k)];
        triangles_.push_back({{apex, p, b},
                              {none, old.across[after(k)], s},
                              {old.fixed[k], old.fixed[after(k)], false}});
        triangles_[s] = {{apex, a, p},
                         {none, fresh, old.across[before(k)]},
                         {old.fixed[k], false, old.fixed[before(k)]}};
        relink(old.across[after(k)], s, fresh);
        suspects.emplace_back(s, 2);
        suspects.emplace_back(fresh, 1);
        return fresh;
    };
    const int other_edge = other == none ? none : edge_towards(other, t);
    const int fresh = halve(t, edge);
    if (other != none) {
        const int other_fresh = halve(other, other_edge);
        triangles_[t].across[0] = other_fresh;  // t holds a..p, which other's second half borders
        triangles_[other_fresh].across[0] = t;
        triangles_[fresh].across[0] = other;
        triangles_[other].across[0] = fresh;
    }
    legalise(std::move(suspects));
}

bool Triangulation::flip_is_due(int t, int edge) const {
    const Triangle& here = triangles_[t];
    if (here.fixed[edge] || here.across[edge] == none) return false;
    const Triangle& there = triangles_[here.across[edge]];
    const Vec2 &a = points_[here.vertices[edge]], &b = points_[here.vertices[after(edge)]],
               &c = points_[here.vertices[before(edge)]];
    const Vec2& d = points_[there.vertices[edge_towards(here.across[edge], t)]];
    if (turn(a, b, d) <= 0.0 || turn(a, d, c) <= 0.0) return false;  // not convex
    if (turn(a, b, c) <= 0.0 || turn(b, d, c) <= 0.0) return false;  // turned over by rounding
    const double scale =
        std::max({(b - a).squaredNorm(), (c - a).squaredNorm(), (d - a).squaredNorm()});
    // Beside the triangle's own area, so that needles are made as even as other triangles.
    return in_circle(a, b, c, d) > 1e-10 * scale * turn(a, b, c);
}

void Triangulation::flip(int t, int edge) {
    const int s = triangles_[t].across[edge];
    const int back = edge_towards(s, t);
    const Triangle here = triangles_[t], there = triangles_[s];
    const int a = here.vertices[edge], b = here.vertices[after(edge)],
              c = here.vertices[before(edge)], d = there.vertices[back];
    triangles_[t] = {{a, b, d},
                     {there.across[after(back)], s, here.across[before(edge)]},
                     {there.fixed[after(back)], false, here.fixed[before(edge)]}};
    triangles_[s] = {{a, d, c},
                     {there.across[before(back)], here.across[after(edge)], t},
                     {there.fixed[before(back)], here.fixed[after(edge)], false}};
    relink(there.across[after(back)], s, t);
    relink(here.across[after(edge)], t, s);
}

void Triangulation::legalise(std::vector<std::pair<int, int>> suspects) {
    // A few for each triangle are due at most, but where points are near to one line rounding could
    // make flips go round in circles: then the triangles stay as they are.
    std::size_t flips_left = flips_ ? 1000 + 100 * triangles_.size() : 0;
    while (!suspects.empty()) {
        const auto [t, edge] = suspects.back();
        suspects.pop_back();
        if (!flip_is_due(t, edge)) continue;
        if (flips_left-- == 0) {
            flips_ = false;
            return;
        }
        const int s = triangles_[t].across[edge];
        flip(t, edge);
        for (const int changed : {t, s})
            for (int k = 0; k < 3; ++k) suspects.emplace_back(changed, k);
    }
}

}  // namespace patchlight
