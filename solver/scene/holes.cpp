#include "solver/scene/holes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

namespace patchlight {

namespace {

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
    const Vec2 along = b - a;
    const double length = along.squaredNorm();
    const double t = length > 0.0 ? std::clamp((p - a).dot(along) / length, 0.0, 1.0) : 0.0;
    return (p - a - t * along).norm();
}

bool cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    return (turn(a, b, c) > 0) != (turn(a, b, d) > 0) && (turn(c, d, a) > 0) != (turn(c, d, b) > 0);
}

bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d, double touching) {
    const auto apart = [&](int axis) {
        return std::max(a[axis], b[axis]) + touching < std::min(c[axis], d[axis]) ||
               std::max(c[axis], d[axis]) + touching < std::min(a[axis], b[axis]);
    };
    if (apart(0) || apart(1)) return false;
    return cross(a, b, c, d) || distance_to_segment(a, c, d) <= touching ||
           distance_to_segment(b, c, d) <= touching || distance_to_segment(c, a, b) <= touching ||
           distance_to_segment(d, a, b) <= touching;
}

bool rings_meet(const std::vector<Vec2>& one, const std::vector<Vec2>& other, double touching) {
    for (std::size_t i = 0; i < one.size(); ++i)
        for (std::size_t j = 0; j < other.size(); ++j)
            if (segments_meet(one[i], one[(i + 1) % one.size()], other[j],
                              other[(j + 1) % other.size()], touching))
                return true;
    return false;
}

using Ring = std::vector<std::uint32_t>;  // numbers of points

/// Joins holes to the outline by bridges, so that one ring runs round all.
class Bridging {
  public:
    explicit Bridging(const Rings<Vec2>& rings) {
        for (const auto& ring : rings) {
            Ring numbers(ring.size());
            std::iota(numbers.begin(), numbers.end(), static_cast<std::uint32_t>(points_.size()));
            points_.insert(points_.end(), ring.begin(), ring.end());
            rings_.push_back(std::move(numbers));
        }
    }

    /// Empty if a hole sees no corner.
    Ring join() {
        Ring ring = rings_.front();
        std::vector<Ring> holes(rings_.begin() + 1, rings_.end());
        const auto by_x = [&](std::uint32_t a, std::uint32_t b) {
            return points_[a].x() < points_[b].x();
        };
        for (Ring& hole : holes)
            std::rotate(hole.begin(), std::max_element(hole.begin(), hole.end(), by_x), hole.end());
        // Rightmost first: its rightmost corner sees a corner of the ring, past no other hole.
        std::sort(holes.begin(), holes.end(), [&](const Ring& a, const Ring& b) {
            return points_[a.front()].x() > points_[b.front()].x();
        });
        for (std::size_t h = 0; h < holes.size(); ++h) {
            const auto at = bridge(ring, std::span(holes).subspan(h));
            if (!at) return {};
            Ring round = holes[h];
            round.push_back(holes[h].front());
            round.push_back(ring[*at]);
            ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(*at + 1), round.begin(),
                        round.end());
        }
        return ring;
    }

    const std::vector<Vec2>& points() const { return points_; }

  private:
    /// The place in the ring to which the first corner of the first hole is joined: the nearest it
    /// sees.
    std::optional<std::size_t> bridge(const Ring& ring, std::span<const Ring> holes) const {
        const std::uint32_t from = holes.front().front();
        std::vector<std::size_t> places(ring.size());
        std::iota(places.begin(), places.end(), std::size_t{0});
        const auto distance = [&](std::size_t k) {
            return (points_[ring[k]] - points_[from]).squaredNorm();
        };
        std::sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
            return std::pair(distance(a), a) < std::pair(distance(b), b);
        });
        for (const std::size_t place : places)
            if (opens_towards(ring, place, points_[from]) && is_free(from, ring[place], ring) &&
                std::all_of(holes.begin(), holes.end(),
                            [&](const Ring& hole) { return is_free(from, ring[place], hole); }))
                return place;
        return std::nullopt;
    }

    /// Whether p lies in the angle that the ring makes at a corner: where bridges end, one point is
    /// several corners.
    bool opens_towards(const Ring& ring, std::size_t place, const Vec2& p) const {
        const std::size_t n = ring.size();
        const Vec2 &before = points_[ring[(place + n - 1) % n]], &at = points_[ring[place]],
                   &after = points_[ring[(place + 1) % n]];
        const bool left_of_first = turn(before, at, p) > 0, left_of_second = turn(at, after, p) > 0;
        return turn(before, at, after) >= 0 ? left_of_first && left_of_second
                                            : left_of_first || left_of_second;
    }

    /// Whether no edge of the ring lies across the way between two points.
    bool is_free(std::uint32_t from, std::uint32_t to, const Ring& ring) const {
        const Vec2 &a = points_[from], &b = points_[to];
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const std::uint32_t c = ring[k], d = ring[(k + 1) % ring.size()];
            const bool shares_end = c == from || c == to || d == from || d == to;
            if (!shares_end && segments_meet(a, b, points_[c], points_[d], 0.0)) return false;
            const bool is_passed = c != from && c != to &&
                                   distance_to_segment(points_[c], a, b) <= 1e-12 * (b - a).norm();
            if (is_passed) return false;
        }
        return true;
    }

    std::vector<Vec2> points_;
    std::vector<Ring> rings_;
};

/// Clips ears, best-shaped first. What an ear cuts off changes those beside it alone.
class EarClipping {
  public:
    EarClipping(const std::vector<Vec2>& points, Ring ring)
        : points_(points), ring_(std::move(ring)) {
        for (std::size_t k = 0; k < ring_.size(); ++k) shapes_.push_back(shape_of(k));
    }

    /// Fewer than n - 2 if rounding leaves no ear.
    std::vector<Ring> triangles() {
        std::vector<Ring> cut;
        while (ring_.size() >= 3) {
            const auto best = std::max_element(shapes_.begin(), shapes_.end());
            if (*best <= least_shape) break;
            const auto k = static_cast<std::size_t>(best - shapes_.begin());
            const std::size_t n = ring_.size();
            cut.push_back({ring_[(k + n - 1) % n], ring_[k], ring_[(k + 1) % n]});
            ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(k));
            shapes_.erase(best);
            if (ring_.size() < 3) break;
            const std::size_t after = k % ring_.size();
            const std::size_t before = (k + ring_.size() - 1) % ring_.size();
            shapes_[after] = shape_of(after);
            shapes_[before] = shape_of(before);
        }
        return cut;
    }

  private:
    static constexpr double least_shape = 1e-14;

    /// Height over the longest edge [1]; 0 of what is no ear.
    double shape_of(std::size_t k) const {
        const std::size_t n = ring_.size();
        const Vec2 &a = points_[ring_[(k + n - 1) % n]], &b = points_[ring_[k]],
                   &c = points_[ring_[(k + 1) % n]];
        const double longest =
            std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
        const double shape = longest > 0.0 ? turn(a, b, c) / longest : 0.0;
        if (shape <= least_shape) return 0.0;
        for (const std::uint32_t i : ring_) {
            const Vec2& p = points_[i];
            if (p == a || p == b || p == c) continue;
            if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return 0.0;
        }
        return shape;
    }

    const std::vector<Vec2>& points_;
    Ring ring_;
    std::vector<double> shapes_;
};

/// Drops diagonals, longest first, where the piece that arises is convex.
class Merging {
  public:
    Merging(const std::vector<Vec2>& points, std::vector<Ring> pieces)
        : points_(points), pieces_(std::move(pieces)) {
        for (std::size_t p = 0; p < pieces_.size(); ++p) claim_edges(p);
    }

    std::vector<Ring> merge() {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> diagonals;
        for (const auto& [edge, piece] : piece_of_)
            if (edge.first < edge.second && piece_of_.contains({edge.second, edge.first}))
                diagonals.push_back(edge);
        const auto length = [&](const auto& edge) {
            return (points_[edge.first] - points_[edge.second]).squaredNorm();
        };
        std::stable_sort(diagonals.begin(), diagonals.end(),
                         [&](const auto& a, const auto& b) { return length(a) > length(b); });
        for (const auto& [from, to] : diagonals) try_to_drop(from, to);
        std::erase_if(pieces_, [](const Ring& piece) { return piece.empty(); });
        return std::move(pieces_);
    }

  private:
    void claim_edges(std::size_t p) {
        const Ring& piece = pieces_[p];
        for (std::size_t k = 0; k < piece.size(); ++k)
            piece_of_[{piece[k], piece[(k + 1) % piece.size()]}] = p;
    }

    void try_to_drop(std::uint32_t from, std::uint32_t to) {
        const std::size_t one = piece_of_.at({from, to}), other = piece_of_.at({to, from});
        if (one == other) return;
        Ring merged = pieces_[one];
        std::rotate(merged.begin(), std::find(merged.begin(), merged.end(), to), merged.end());
        Ring more = pieces_[other];
        std::rotate(more.begin(), std::find(more.begin(), more.end(), from), more.end());
        merged.insert(merged.end(), more.begin() + 1, more.end() - 1);  // from … to, both in
        for (std::size_t k = 0; k < merged.size(); ++k) {
            const std::size_t n = merged.size();
            const Vec2 &a = points_[merged[k]], &b = points_[merged[(k + 1) % n]],
                       &c = points_[merged[(k + 2) % n]];
            constexpr double straight = 1e-12;  // of the edges' lengths: rounding [1]
            if (turn(a, b, c) < -straight * (b - a).norm() * (c - b).norm()) return;
        }
        pieces_[one] = std::move(merged);
        pieces_[other].clear();
        claim_edges(one);
    }

    const std::vector<Vec2>& points_;
    std::vector<Ring> pieces_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> piece_of_;
};

}  // namespace

std::string fault_of(const Rings<Vec2>& rings, double touching) {
    for (const std::vector<Vec2>& ring : rings)
        if (crosses_itself(ring))
            return "the polygon or a hole in it touches or crosses itself; corners must run once "
                   "round an edge";
    for (std::size_t i = 0; i < rings.size(); ++i)
        for (std::size_t j = i + 1; j < rings.size(); ++j)
            if (rings_meet(rings[i], rings[j], touching))
                return i == 0 ? "a hole touches or crosses the edge of its polygon; let the "
                                "polygon's corners run round it instead"
                              : "two holes touch or cross; make one of them";
    for (std::size_t h = 1; h < rings.size(); ++h) {
        if (!contains(rings[0], rings[h][0])) return "a hole lies outside its polygon";
        for (std::size_t other = 1; other < rings.size(); ++other)
            if (other != h && contains(rings[other], rings[h][0]))
                return "a hole lies inside another; what fills it is a polygon of its own";
    }
    return "";
}

std::vector<std::vector<std::uint32_t>> cut_round_holes(const Rings<Vec2>& rings, bool triangles) {
    Bridging bridging(rings);
    Ring ring = bridging.join();
    const std::size_t corners = ring.size();
    std::vector<Ring> pieces = EarClipping(bridging.points(), std::move(ring)).triangles();
    if (corners < 3 || pieces.size() + 2 != corners) return {};
    return triangles ? pieces : Merging(bridging.points(), std::move(pieces)).merge();
}

}  // namespace patchlight
