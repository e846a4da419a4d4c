#include "solver/mesh/cover_lines.h"

#include "solver/scene/polygon.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace patchlight {

namespace {

struct Part {  // convex
    std::vector<Vec2> corners;
    Eigen::AlignedBox2d box;
    std::size_t cover = 0;
};

using Interval = std::array<double, 2>;  // of places along a segment [1]

bool is_convex(const std::vector<Vec2>& p) {
    for (std::size_t k = 0; k < p.size(); ++k)
        if (turn(p[k], p[(k + 1) % p.size()], p[(k + 2) % p.size()]) < 0.0) return false;
    return true;
}

void add_parts(std::vector<Vec2> outline, std::size_t cover, std::vector<Part>& parts) {
    const auto add = [&](std::vector<Vec2> corners) {
        Part part{std::move(corners), {}, cover};
        for (const Vec2& p : part.corners) part.box.extend(p);
        parts.push_back(std::move(part));
    };
    if (is_convex(outline)) return add(std::move(outline));
    for (const auto& t : triangulate(outline)) add({outline[t[0]], outline[t[1]], outline[t[2]]});
}

/// Where a segment is inside a convex part; nowhere if it runs along its outline.
Interval inside(const Part& part, const Vec2& a, const Vec2& b, double reach) {
    Interval in{0.0, 1.0};
    for (std::size_t k = 0; k < part.corners.size(); ++k) {
        const Vec2 &p = part.corners[k], &q = part.corners[(k + 1) % part.corners.size()];
        const double length = (q - p).norm(), at_a = turn(p, q, a), at_b = turn(p, q, b);
        if (std::max(std::abs(at_a), std::abs(at_b)) <= reach * length) return {1.0, 0.0};
        if (at_a <= 0.0 && at_b <= 0.0) return {1.0, 0.0};
        if (at_a < 0.0) in[0] = std::max(in[0], at_a / (at_a - at_b));
        if (at_b < 0.0) in[1] = std::min(in[1], at_a / (at_a - at_b));
    }
    return in;
}

/// Where a segment is within an outline.
std::vector<Interval> within(const std::vector<Vec2>& outline, const Vec2& a, const Vec2& b) {
    std::vector<double> places{0.0, 1.0};
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Vec2 &p = outline[k], &q = outline[(k + 1) % outline.size()];
        const double at_a = turn(p, q, a), at_b = turn(p, q, b);
        if ((at_a > 0.0) != (at_b > 0.0)) places.push_back(at_a / (at_a - at_b));
    }
    std::sort(places.begin(), places.end());
    std::vector<Interval> in;
    for (std::size_t k = 1; k < places.size(); ++k) {
        const double from = places[k - 1], to = places[k];
        if (!(from < to) || !contains(outline, a + 0.5 * (from + to) * (b - a))) continue;
        if (!in.empty() && in.back()[1] == from)
            in.back()[1] = to;
        else
            in.push_back({from, to});
    }
    return in;
}

void take_out(std::vector<Interval>& left, const Interval& out) {
    if (!(out[0] < out[1])) return;
    std::vector<Interval> rest;
    for (const Interval& one : left) {
        if (out[1] <= one[0] || out[0] >= one[1]) {
            rest.push_back(one);
            continue;
        }
        if (one[0] < out[0]) rest.push_back({one[0], out[0]});
        if (out[1] < one[1]) rest.push_back({out[1], one[1]});
    }
    left = std::move(rest);
}

bool is_known(const std::vector<Segment>& lines, const Segment& line, double reach) {
    const auto same = [&](const Vec3& p, const Vec3& q) { return (p - q).norm() <= reach; };
    return std::any_of(lines.begin(), lines.end(), [&](const Segment& other) {
        return (same(line[0], other[0]) && same(line[1], other[1])) ||
               (same(line[0], other[1]) && same(line[1], other[0]));
    });
}

}  // namespace

std::vector<Segment> cover_lines(const Scene& scene, SurfaceIndex s,
                                 const std::vector<SurfaceIndex>& covers, double reach) {
    const PlaneFrame frame = frame_along(scene.surfaces[s].corners, scene.surfaces[s].normal);
    std::vector<Part> parts;
    for (std::size_t k = 0; k < covers.size() && covers.size() > 1; ++k) {
        std::vector<Vec2> outline;
        for (const Vec3& p : scene.surfaces[covers[k]].corners) outline.push_back(frame.flat(p));
        add_parts(std::move(outline), k, parts);
    }
    std::vector<Vec2> own;
    for (const Vec3& p : scene.surfaces[s].corners) own.push_back(frame.flat(p));
    std::vector<Segment> lines;
    for (std::size_t k = 0; k < covers.size(); ++k) {
        const std::vector<Vec3>& corners = scene.surfaces[covers[k]].corners;
        for (std::size_t c = 0; c < corners.size(); ++c) {
            const Vec3 &p = corners[c], &q = corners[(c + 1) % corners.size()];
            const Vec2 a = frame.flat(p), b = frame.flat(q);
            Eigen::AlignedBox2d box(a.cwiseMin(b), a.cwiseMax(b));
            std::vector<Interval> left = within(own, a, b);
            for (const Part& part : parts)
                if (part.cover != k && !left.empty() && part.box.intersects(box))
                    take_out(left, inside(part, a, b, reach));
            for (const auto& [from, to] : left) {
                const Segment line{from == 0.0 ? p : Vec3(p + from * (q - p)),
                                   to == 1.0 ? q : Vec3(p + to * (q - p))};
                if ((line[1] - line[0]).norm() > reach && !is_known(lines, line, reach))
                    lines.push_back(line);
            }
        }
    }
    return lines;
}

}  // namespace patchlight
