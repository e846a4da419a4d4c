#include "solver/mesh/triangulation.h"

#include <cmath>
#include <deque>
#include <utility>

namespace patchlight {

bool Triangulation::mark_edge(int a, int b) {
    const Place here = edge_between(a, b);
    if (here.triangle == none) return false;
    Triangle& triangle = triangles_[here.triangle];
    triangle.fixed[here.edge] = true;
    if (const int other = triangle.across[here.edge]; other != none)
        triangles_[other].fixed[edge_towards(other, here.triangle)] = true;
    return true;
}

Triangulation::Place Triangulation::edge_between(int a, int b) const {
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t)
        for (int k = 0; k < 3; ++k) {
            const int p = triangles_[t].vertices[after(k)], q = triangles_[t].vertices[before(k)];
            if ((p == a && q == b) || (p == b && q == a)) return {t, k, none};
        }
    return {};
}

/// From triangle t, entered over the edge opposite vertex `from` (or at the vertex a, if `from` is
/// its place there): where the way to b leaves it. False if the walk is over.
bool Triangulation::step(int t, int from, int a, int b, Walk& walk, Place& onward) const {
    const Triangle& triangle = triangles_[t];
    const Vec2 &start = points_[a], &goal = points_[b];
    const double length = (goal - start).norm();
    const int apex = triangle.vertices[from];
    if (apex == b) return false;
    if (apex != a && std::abs(turn(start, goal, points_[apex])) <= tolerance_ * length) {
        walk.vertex = apex;
        return false;
    }
    int edge = from;  // from a vertex the way leads over the edge opposite
    if (apex != a) edge = turn(start, goal, points_[apex]) > 0.0 ? after(from) : before(from);
    if (triangle.fixed[edge] || triangle.across[edge] == none) {
        walk.wall = {t, edge, none};
        return false;
    }
    walk.crossed.push_back({triangle.vertices[after(edge)], triangle.vertices[before(edge)]});
    onward = {triangle.across[edge], edge_towards(triangle.across[edge], t), none};
    return true;
}

Triangulation::Walk Triangulation::walk(int a, int b) const {
    Walk walk;
    const Vec2 &start = points_[a], &goal = points_[b];
    const double near = tolerance_ * (goal - start).norm();
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t)
        for (int k = 0; k < 3; ++k) {
            if (triangles_[t].vertices[k] != a) continue;
            const int right = triangles_[t].vertices[after(k)],
                      left = triangles_[t].vertices[before(k)];
            for (const int v : {right, left}) {  // on the way, and not behind
                const bool ahead = (points_[v] - start).dot(goal - start) > 0.0;
                if (ahead && std::abs(turn(start, goal, points_[v])) <= near) {
                    walk.vertex = v;
                    return walk;
                }
            }
            if (turn(start, goal, points_[right]) >= 0.0 || turn(start, goal, points_[left]) <= 0.0)
                continue;
            Place place{t, k, none};
            std::size_t steps = 0;
            while (++steps <= triangles_.size() &&
                   step(place.triangle, place.edge, a, b, walk, place)) {
            }
            return walk;
        }
    return walk;
}

/// A vertex where a -> b meets the wall; none if it runs along the polygon's outside.
int Triangulation::cut_wall(const Place& wall, int a, int b) {
    const Triangle& triangle = triangles_[wall.triangle];
    const int p = triangle.vertices[after(wall.edge)], q = triangle.vertices[before(wall.edge)];
    const double at_p = turn(points_[a], points_[b], points_[p]),
                 at_q = turn(points_[a], points_[b], points_[q]);
    if ((at_p > 0.0) == (at_q > 0.0)) return none;
    const Vec2 meeting = points_[p] + at_p / (at_p - at_q) * (points_[q] - points_[p]);
    for (const int end : {p, q})
        if ((points_[end] - meeting).norm() <= 4.0 * tolerance_) return end;
    if (triangle.across[wall.edge] == none) return none;  // vertices on the outline are given
    const int number = static_cast<int>(points_.size());
    points_.push_back(meeting);
    split_edge(wall.triangle, wall.edge, number);
    return number;
}

void Triangulation::flip_aside(int a, int b, std::vector<std::array<int, 2>> crossed) {
    std::deque<std::array<int, 2>> waiting(crossed.begin(), crossed.end());
    std::size_t tries_left = 100 + 10 * waiting.size() * waiting.size();
    while (!waiting.empty() && tries_left-- > 0) {
        const auto edge = waiting.front();
        waiting.pop_front();
        const Place place = edge_between(edge[0], edge[1]);
        if (place.triangle == none) continue;
        const Triangle& here = triangles_[place.triangle];
        const int other = here.across[place.edge];
        if (other == none) continue;
        const int p = here.vertices[place.edge], q = here.vertices[after(place.edge)],
                  r = here.vertices[before(place.edge)],
                  s = triangles_[other].vertices[edge_towards(other, place.triangle)];
        if (turn(points_[p], points_[q], points_[s]) <= 0.0 ||
            turn(points_[p], points_[s], points_[r]) <= 0.0) {
            waiting.push_back(edge);  // not convex yet: once its neighbours are flipped
            continue;
        }
        flip(place.triangle, place.edge);
        const bool meets = p != a && p != b && s != a && s != b &&
                           (turn(points_[a], points_[b], points_[p]) > 0.0) !=
                               (turn(points_[a], points_[b], points_[s]) > 0.0);
        if (meets) waiting.push_back({p, s});
    }
}

void Triangulation::fix_edge(int a, int b) {
    int detours = most_detours;
    fix_edge(a, b, detours);
}

void Triangulation::fix_edge(int a, int b, int& detours) {
    if (a == b || mark_edge(a, b) || --detours < 0) return;
    if ((points_[b] - points_[a]).norm() <= 4.0 * tolerance_) return;
    Walk way = walk(a, b);
    int by = way.vertex;
    if (by == none && way.wall.triangle != none) {
        by = cut_wall(way.wall, a, b);
        if (by == none) return;
    }
    if (by != none) {
        if (by == a || by == b) return;
        fix_edge(a, by, detours);
        fix_edge(by, b, detours);
        return;
    }
    flip_aside(a, b, std::move(way.crossed));
    if (!mark_edge(a, b)) return;
    const Place made = edge_between(a, b);
    std::vector<std::pair<int, int>> suspects;
    for (const int t : {made.triangle, triangles_[made.triangle].across[made.edge]})
        for (int k = 0; t != none && k < 3; ++k) suspects.emplace_back(t, k);
    legalise(std::move(suspects));
}

}  // namespace patchlight
