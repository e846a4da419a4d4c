#include "solver/form_factors/contour_exchange.h"

#include "solver/form_factors/gauss_legendre.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace patchlight {

namespace {

struct Edge {
    Vec3 start;
    Vec3 direction;  // unit
    double length;   // [m]
    Vec3 end() const { return start + length * direction; }
};

/// Antiderivative of ln sqrt(τ² + h²) in τ.
double log_distance_integral(double tau, double h) {
    const double squared = tau * tau + h * h;
    if (squared == 0.0) return 0.0;
    const double angle_term = h > 0.0 ? h * std::atan2(tau, h) : 0.0;
    return tau * (0.5 * std::log(squared) - 1.0) + angle_term;
}

/// ∫ ln |x − y| over the edge, y on it.
double inner(const Vec3& x, const Edge& edge) {
    const Vec3 to = x - edge.start;
    const double along = to.dot(edge.direction);
    const double h = (to - along * edge.direction).norm();
    return log_distance_integral(edge.length - along, h) - log_distance_integral(-along, h);
}

/// Tanh–sinh nodes on (0, 1) for integrands that are singular, or nearly, at the ends
/// (Takahasi & Mori, 1974).
struct EndRule {
    std::vector<double> nodes, weights;
    EndRule() {
        constexpr double step = 0.16;
        for (int k = -20; k <= 20; ++k) {
            const double t = step * k;
            const double s = 0.5 * std::numbers::pi * std::sinh(t);
            nodes.push_back(1.0 / (1.0 + std::exp(-2.0 * s)));
            weights.push_back(step * 0.25 * std::numbers::pi * std::cosh(t) /
                              (std::cosh(s) * std::cosh(s)));
        }
    }
};

double graded(const Edge& outer, const Edge& other, double from, double to) {
    static const EndRule rule;
    double sum = 0.0;
    for (std::size_t k = 0; k < rule.nodes.size(); ++k)
        sum += rule.weights[k] *
               inner(outer.start + (from + (to - from) * rule.nodes[k]) * outer.direction, other);
    return (to - from) * sum;
}

/// Where along `outer` the integrand may bend sharply: opposite the other edge's ends, and where
/// the two lines come closest.
double graded_integral(const Edge& outer, const Edge& other) {
    std::array<double, 5> places{0.0, outer.length, 0.0, 0.0, 0.0};
    std::size_t count = 2;
    const auto add = [&](double s) {
        if (s > 1e-12 * outer.length && s < (1.0 - 1e-12) * outer.length) places[count++] = s;
    };
    add((other.start - outer.start).dot(outer.direction));
    add((other.end() - outer.start).dot(outer.direction));
    const double cosine = outer.direction.dot(other.direction);
    const double sine2 = 1.0 - cosine * cosine;
    if (sine2 > 1e-9) {
        const Vec3 between = other.start - outer.start;
        add((between.dot(outer.direction) - cosine * between.dot(other.direction)) / sine2);
    }
    for (std::size_t k = 1; k < count; ++k)  // a handful: insertion sort
        for (std::size_t l = k; l > 0 && places[l - 1] > places[l]; --l)
            std::swap(places[l - 1], places[l]);
    double sum = 0.0;
    for (std::size_t k = 1; k < count; ++k)
        if (places[k] > places[k - 1]) sum += graded(outer, other, places[k - 1], places[k]);
    return sum;
}

template <std::size_t N>
double plain_integral(const Edge& outer, const Edge& other) {
    const GaussRule<N>& rule = gauss_rule<N>();
    double sum = 0.0;
    for (std::size_t k = 0; k < N; ++k)
        sum += rule.weights[k] *
               inner(outer.start + rule.nodes[k] * outer.length * outer.direction, other);
    return outer.length * sum;
}

double distance_to(const Edge& edge, const Vec3& x) {
    const double t = std::clamp((x - edge.start).dot(edge.direction), 0.0, edge.length);
    return (edge.start + t * edge.direction - x).norm();
}

/// Lower bound of the distance between two edges, exact where their ends are nearest.
double separation(const Edge& a, const Edge& b) {
    const double ends = std::min({distance_to(a, b.start), distance_to(a, b.end()),
                                  distance_to(b, a.start), distance_to(b, a.end())});
    Vec3 across(a.direction.y() * b.direction.z() - a.direction.z() * b.direction.y(),
                a.direction.z() * b.direction.x() - a.direction.x() * b.direction.z(),
                a.direction.x() * b.direction.y() - a.direction.y() * b.direction.x());
    const double sine = across.norm();
    if (sine < 1e-6) return ends;
    return std::min(ends, std::abs((b.start - a.start).dot(across)) / sine);
}

double edge_pair(const Edge& a, const Edge& b) {
    const double cosine = a.direction.dot(b.direction);
    if (std::abs(cosine) < 1e-15) return 0.0;
    const bool swap = a.length > b.length;  // the shorter edge is integrated by quadrature
    const Edge &outer = swap ? b : a, &other = swap ? a : b;
    const double relative = separation(outer, other) / outer.length;
    if (relative > 3.0) return cosine * plain_integral<6>(outer, other);
    if (relative > 1.0) return cosine * plain_integral<10>(outer, other);
    if (relative > 0.4) return cosine * plain_integral<16>(outer, other);
    return cosine * graded_integral(outer, other);
}

}  // namespace

double contour_exchange(const ConvexPolygon& p, const ConvexPolygon& q) {
    // Lengths relative to the distance, so that ln r is small and little cancels.
    Vec3 p_centre = Vec3::Zero(), q_centre = Vec3::Zero();
    for (const Vec3& x : p.view()) p_centre += x / static_cast<double>(p.size);
    for (const Vec3& y : q.view()) q_centre += y / static_cast<double>(q.size);
    const double unit = (q_centre - p_centre).norm();
    if (!(unit > 0.0)) return 0.0;
    const auto edges = [unit, &p_centre](const ConvexPolygon& polygon) {
        std::array<Edge, ConvexPolygon::most_corners> result;
        std::size_t count = 0;
        for (std::size_t k = 0; k < polygon.size; ++k) {
            const Vec3 a = (polygon.corners[k] - p_centre) / unit;
            const Vec3 along = (polygon.corners[(k + 1) % polygon.size] - p_centre) / unit - a;
            const double length = along.norm();
            if (length > 0.0) result[count++] = {a, along / length, length};
        }
        return std::pair(result, count);
    };
    const auto [p_edges, p_count] = edges(p);
    const auto [q_edges, q_count] = edges(q);
    double sum = 0.0;
    for (std::size_t k = 0; k < p_count; ++k)
        for (std::size_t l = 0; l < q_count; ++l) sum += edge_pair(p_edges[k], q_edges[l]);
    return std::max(0.0, sum / (2.0 * std::numbers::pi)) * unit * unit;
}

}  // namespace patchlight
