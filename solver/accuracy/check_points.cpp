#include "solver/accuracy/check_points.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>

namespace patchlight {

namespace {

struct TrianglePick {
    std::vector<double> area;        // of triangles [m²]
    std::vector<double> cumulative;  // of the chance to be picked, ends at 1
    std::vector<double> chance;
};

/// Irradiance displayed at a vertex [W/m²].
Rgb all_shown(const TreeDisplay& shown, std::uint32_t v) {
    Rgb all = shown.arriving.indirect[v];
    if (!shown.arriving.direct.empty()) all += shown.arriving.direct[v];
    return all;
}

/// Of the points 30 % fall by area, 45 % where what is sent back of `arriving` is bright or steep,
/// for there the most may be missed; 15 % where all that is sent back is bright, for what it lights
/// nearby may not be shown at all; 10 % on all objects alike.
TrianglePick make_pick(const Scene& scene, const VertexGather& gather, const TreeDisplay& shown,
                       const std::vector<Rgb>& arriving) {
    constexpr std::array<double, 5> share{0.3, 0.25, 0.2, 0.15, 0.1};
    TrianglePick pick;
    std::vector<std::array<double, 5>> by(shown.display.triangles.size());
    std::array<double, 5> sum{};
    std::vector<double> of_object(scene.objects.size(), 0.0);  // area [m²]
    const auto surface = [&](std::size_t t) -> const Surface& {
        return scene.surfaces[gather.surface_of(shown.display.patch[t])];
    };
    for (std::size_t t = 0; t < by.size(); ++t) {
        const auto [a, b, c] = shown.display.triangles[t];
        const auto& p = shown.display.positions;
        const Rgb& reflectance = scene.materials[surface(t).material].reflectance;
        const auto level = [&](std::uint32_t v) { return luminance(reflectance * arriving[v]); };
        const auto whole = [&](std::uint32_t v) {
            return luminance(reflectance * all_shown(shown, v));
        };
        pick.area.push_back(0.5 * (p[b] - p[a]).cross(p[c] - p[a]).norm());
        const auto [low, high] = std::minmax({level(a), level(b), level(c)});
        const double most = std::max({whole(a), whole(b), whole(c)});
        by[t] = {pick.area[t], pick.area[t] * high * high,
                 pick.area[t] * (high - low) * (high - low), pick.area[t] * most * most, 0.0};
        of_object[surface(t).object] += pick.area[t];
    }
    for (std::size_t t = 0; t < by.size(); ++t) {
        const double whole = of_object[surface(t).object];
        by[t].back() = whole > 0.0 ? pick.area[t] / whole : 0.0;
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += by[t][k];
    }
    double total = 0.0;
    for (std::size_t t = 0; t < by.size(); ++t) {
        double chance = 0.0;
        for (std::size_t k = 0; k < sum.size(); ++k)
            chance += share[k] * (sum[k] > 0.0 ? by[t][k] / sum[k] : by[t][0] / sum[0]);
        pick.chance.push_back(chance);
        pick.cumulative.push_back(total += chance);
    }
    for (double& value : pick.cumulative) value /= total;
    return pick;
}

/// A random point of the display.
struct CheckPoint {
    std::size_t triangle = 0;
    std::array<double, 3> weight{};  // of its corners [1]
    Vec3 position = Vec3::Zero();    // [m]
    GatherPoint place;
    double density = 1.0;  // of points [1/m²]
    Rgb reflectance = Rgb::Zero();
    ObjectIndex object = 0;
};

/// Those that make up most of the sum.
std::vector<PointMiss> telling(const std::vector<PointMiss>& misses,
                               const std::vector<double>& products) {
    constexpr double beyond_mean = 2.0;
    double mean = 0.0;
    for (const double product : products) mean += std::abs(product);
    mean /= static_cast<double>(products.size());
    std::vector<PointMiss> most;
    for (std::size_t k = 0; k < misses.size(); ++k)
        if (products[k] > beyond_mean * mean) most.push_back(misses[k]);
    return most;
}

struct Checker {
    const Scene& scene;
    const TreeDisplay& shown;
    const VertexGather& gather;
    std::uint64_t seed;

    std::uint64_t key(std::size_t k, std::uint64_t use) const { return mix(seed, 8 * k + use); }

    /// Number k of n, stratified along the cumulated chance.
    CheckPoint point(const TrianglePick& pick, std::size_t k, std::size_t n) const {
        const double at = (static_cast<double>(k) + unit(key(k, 0))) / static_cast<double>(n);
        const auto found = std::upper_bound(pick.cumulative.begin(), pick.cumulative.end(), at);
        CheckPoint point;
        point.triangle = std::min(static_cast<std::size_t>(found - pick.cumulative.begin()),
                                  pick.cumulative.size() - 1);
        const double root = std::sqrt(unit(key(k, 1))), v = unit(key(k, 2));
        point.weight = {1.0 - root, root * (1.0 - v), root * v};
        const auto& corners = shown.display.triangles[point.triangle];
        for (std::size_t c = 0; c < 3; ++c)
            point.position += point.weight[c] * shown.display.positions[corners[c]];
        const PatchIndex patch = shown.display.patch[point.triangle];
        const Surface& surface = scene.surfaces[gather.surface_of(patch)];
        point.place = gather.point(patch, point.position);
        point.density = pick.chance[point.triangle] / pick.area[point.triangle];
        point.reflectance = scene.materials[surface.material].reflectance;
        point.object = surface.object;
        return point;
    }

    Rgb shown_at(const CheckPoint& point, const std::vector<Rgb>& values) const {
        const auto& corners = shown.display.triangles[point.triangle];
        Rgb sum = Rgb::Zero();
        for (std::size_t c = 0; c < 3; ++c) sum += point.weight[c] * values[corners[c]];
        return sum;
    }

    /// Products of two differences at n points, and their sums by object.
    MeasuredError compare(std::size_t n, const std::vector<Rgb>& values,
                          const std::function<Rgb(const GatherPoint&, std::uint64_t)>& anew,
                          CheckReport& report, std::vector<ResidualPoint>& points) const {
        std::vector<double> products(n), means(n);
        std::vector<ObjectIndex> objects(n);
        std::vector<PatchIndex> patches(n);
        std::vector<Rgb> missing(n);
        std::vector<PointMiss> misses(n);
        points.resize(n);
        const TrianglePick pick = make_pick(scene, gather, shown, values);
        tbb::parallel_for(std::size_t{0}, n, [&](std::size_t k) {
            const CheckPoint checked = point(pick, k, n);
            const Rgb value = shown_at(checked, values);
            std::array<double, 2> miss{};
            Rgb arriving = Rgb::Zero();
            missing[k] = Rgb::Zero();
            points[k] = {checked.place,       checked.object, checked.density,
                         checked.reflectance, value,          {Rgb::Zero(), Rgb::Zero()}};
            for (std::uint64_t half = 0; half < 2; ++half) {
                const Rgb there = anew(checked.place, key(k, 3 + half)), beyond = value - there;
                arriving += 0.5 * there;
                miss[half] = luminance(checked.reflectance * beyond);
                missing[k] -= 0.5 * beyond / checked.density;
                points[k].missing[half] = -beyond;
            }
            products[k] = miss[0] * miss[1] / checked.density;
            means[k] = 0.5 * (miss[0] + miss[1]) / checked.density;
            misses[k] = {shown.display.patch[checked.triangle], checked.position, miss[0] * miss[1],
                         arriving};
            objects[k] = checked.object;
            patches[k] = shown.display.patch[checked.triangle];
        });
        const double all = static_cast<double>(n);
        for (std::size_t k = 0; k < n; ++k) {
            CheckReport::OfObject& object = report.of_object[objects[k]];
            object.square += products[k] / all;
            object.variance += products[k] * products[k] / (all * all);
            ++object.points;
            report.missing[k % 2][patches[k]] += 2.0 * missing[k] / all;
        }
        report.missed = telling(misses, products);
        MeasuredError error = mean_of(products);
        for (const double mean : means) error.mean += mean / static_cast<double>(n);
        return error;
    }
};

}  // namespace

MeasuredError mean_of(const std::vector<double>& numbers) {
    const double n = static_cast<double>(numbers.size());
    MeasuredError error;
    if (numbers.size() < 2) return error;
    error.points = static_cast<int>(numbers.size());
    for (const double number : numbers) error.square += number / n;
    for (const double number : numbers)
        error.variance += (number - error.square) * (number - error.square) / (n * (n - 1.0));
    return error;
}

double MeasuredError::at_most(double standard_errors) const {
    return std::sqrt(std::max(square + standard_errors * std::sqrt(variance), 0.0));
}

namespace {

MeasuredError joined(const MeasuredError& a, const MeasuredError& b) {
    const int points = a.points + b.points;
    if (points == 0) return a;
    const double share = static_cast<double>(a.points) / points;
    const auto mean = [&](double x, double y) { return share * x + (1.0 - share) * y; };
    return {mean(a.square, b.square),
            share * share * a.variance + (1.0 - share) * (1.0 - share) * b.variance,
            mean(a.mean, b.mean), points};
}

}  // namespace

CheckReport joined(const CheckReport& a, const CheckReport& b) {
    CheckReport both = a;
    both.direct = joined(a.direct, b.direct);
    both.indirect = joined(a.indirect, b.indirect);
    const auto append = [](auto& to, const auto& more) {
        to.insert(to.end(), more.begin(), more.end());
    };
    append(both.missed, b.missed);
    append(both.direct_points, b.direct_points);
    append(both.indirect_points, b.indirect_points);
    // An object's part is a sum over direct and indirect points, taken as alike in share.
    const int points = a.indirect.points + b.indirect.points;
    const double share = points > 0 ? static_cast<double>(a.indirect.points) / points : 1.0;
    for (std::size_t o = 0; o < both.of_object.size(); ++o) {
        CheckReport::OfObject& object = both.of_object[o];
        object.square = share * object.square + (1.0 - share) * b.of_object[o].square;
        object.variance = share * share * object.variance +
                          (1.0 - share) * (1.0 - share) * b.of_object[o].variance;
        object.points += b.of_object[o].points;
    }
    for (std::size_t half = 0; half < 2; ++half) {
        for (std::size_t i = 0; i < both.missing[half].size(); ++i)
            both.missing[half][i] = share * a.missing[half][i] + (1.0 - share) * b.missing[half][i];
    }
    return both;
}

double CheckReport::at_most(double standard_errors) const {
    const double spread = standard_errors * std::sqrt(direct.variance + indirect.variance);
    return std::sqrt(std::max(direct.square + indirect.square + spread, 0.0));
}

CheckReport check_display(const Scene& scene, const TreeDisplay& shown, const VertexGather& gather,
                          const ReflectedField& field, const CheckEffort& effort,
                          std::uint64_t seed) {
    CheckReport report;
    const std::size_t patches = gather.patches();
    report.of_object.resize(scene.objects.size());
    for (std::vector<Rgb>& missing : report.missing) missing.assign(patches, Rgb::Zero());
    if (shown.display.triangles.empty()) return report;
    const Checker checker{scene, shown, gather, seed};
    const auto direct = [&](const GatherPoint& point, std::uint64_t key) {
        return gather.gather().direct(point, effort.direct, key).irradiance;
    };
    const auto indirect = [&](const GatherPoint& point, std::uint64_t key) {
        return gather.gather().indirect(point, field, effort.rays, key).irradiance;
    };
    const auto all = [&](const GatherPoint& point, std::uint64_t key) {
        return Rgb(direct(point, key) + indirect(point, key));
    };
    const auto n = static_cast<std::size_t>(effort.indirect_points);
    if (shown.arriving.direct.empty()) {
        report.indirect =
            checker.compare(n, shown.arriving.indirect, all, report, report.indirect_points);
        return report;
    }
    report.direct = checker.compare(static_cast<std::size_t>(effort.direct_points),
                                    shown.arriving.direct, direct, report, report.direct_points);
    report.indirect =
        checker.compare(n, shown.arriving.indirect, indirect, report, report.indirect_points);
    return report;
}

}  // namespace patchlight
