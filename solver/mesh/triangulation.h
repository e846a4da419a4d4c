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
    static constexpr int most_detours = 1024;  // on the way of one edge
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
    /// Makes a -> b an edge: edges in its way are flipped, fixed ones are cut where it meets them
    /// (Sloan, "A Fast Algorithm for Generating Constrained Delaunay Triangulations", 1993).
    void fix_edge(int a, int b);

    const std::vector<Vec2>& points() const { return points_; }
    const std::vector<Triangle>& triangles() const { return triangles_; }

  private:
    /// The other vertices of a triangle, counter-clockwise.
    static constexpr int after(int k) { return (k + 1) % 3; }
    static constexpr int before(int k) { return (k + 2) % 3; }

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

    /// What a walk from one vertex towards another meets first that it cannot pass.
    struct Walk {
        std::vector<std::array<int, 2>> crossed;  // edges that can be flipped, by their vertices
        int vertex = none;                        // one that lies on the way
        Place wall;                               // a fixed edge
    };
    void fix_edge(int a, int b, int& detours);
    bool mark_edge(int a, int b);
    Place edge_between(int a, int b) const;
    Walk walk(int a, int b) const;
    bool step(int t, int from, int a, int b, Walk& walk, Place& onward) const;
    int cut_wall(const Place& wall, int a, int b);
    void flip_aside(int a, int b, std::vector<std::array<int, 2>> crossed);

    std::vector<Vec2> points_;
    std::vector<Triangle> triangles_;
    double tolerance_ = 0.0;  // closer points are one; nearer an edge is on it [m]
    int last_ = 0;            // triangle found last: the next point is often near
    bool ok_ = true;
    bool flips_ = true;  // false once rounding made flips go round in circles
};

}  // namespace patchlight
