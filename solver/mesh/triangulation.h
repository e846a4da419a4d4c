#pragma once

#include "solver/scene/polygon.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace patchlight {

/// A constrained Delaunay triangulation of a simple polygon, grown point by point
/// (Lawson, "Software for C1 Surface Interpolation", 1977).
class Triangulation {
  public:
    static constexpr int none = -1;
    struct Triangle {
        std::array<int, 3> vertices{};                // counter-clockwise
        std::array<int, 3> across{none, none, none};  // triangle beyond the edge opposite vertex k
        std::array<bool, 3> fixed{false, false, false};  // that edge is never flipped
    };

    /// Corners counter-clockwise; the polygon's edges are fixed. `ok()` is false if it is not
    /// simple.
    explicit Triangulation(std::span<const Vec2> polygon);
    bool ok() const { return ok_; }

    /// Adds a point; an edge it lies on (within the tolerance) is split. Its number; that of a
    /// vertex already there; none if it is outside.
    std::optional<int> insert(const Vec2& p);
    /// Adds a point on the polygon's edge between the vertices a and b, neighbours on it, however
    /// near another edge may be. Its number; none if a and b are not neighbours.
    std::optional<int> split_boundary(int a, int b, const Vec2& p);
    /// Makes a -> b an edge, by points added half-way where it is not one yet.
    void fix_edge(int a, int b);

    const std::vector<Vec2>& points() const { return points_; }
    const std::vector<Triangle>& triangles() const { return triangles_; }

  private:
    struct Place {
        int triangle = none;
        int edge = none;    // opposite this vertex lies the edge the point is on
        int vertex = none;  // number of the vertex the point is at
    };
    Place locate(const Vec2& p) const;
    std::optional<Place> place_in(int t, const Vec2& p) const;
    void split_triangle(int t, int p);
    void split_edge(int t, int edge, int p);
    void legalise(std::vector<std::pair<int, int>> suspects);
    bool flip_is_due(int t, int edge) const;
    void flip(int t, int edge);
    void relink(int t, int from, int to);
    int edge_towards(int t, int neighbour) const;
    bool mark_edge(int a, int b);

    std::vector<Vec2> points_;
    std::vector<Triangle> triangles_;
    double tolerance_ = 0.0;  // closer points are one; nearer an edge is on it [m]
    int last_ = 0;            // triangle found last: the next point is often near
    bool ok_ = true;
    bool flips_ = true;  // false once rounding made flips go round in circles
};

}  // namespace patchlight
