#include "solver/form_factors/blocker_table.h"

#include "solver/form_factors/patch_clusters.h"
#include "solver/scene/local_tolerance.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <limits>

namespace patchlight {

namespace {

constexpr double most_work =
    1e8;  // tests of a blocker against a pair, about a second; beyond, rays are cheaper
constexpr double in_plane = 1e-9;  // of a frame's size: touching a plane is not crossing it [1]

struct Interval {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    void add(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
};

Interval along(std::span<const Vec3> points, const Vec3& direction) {
    Interval interval;
    for (const Vec3& p : points) interval.add(p.dot(direction));
    return interval;
}

bool apart(const Interval& hull_a, const Interval& hull_b, const Interval& blocker, double slack) {
    return blocker.low > std::max(hull_a.high, hull_b.high) - slack ||
           blocker.high < std::min(hull_a.low, hull_b.low) + slack;
}

/// What may stand in the way: coplanar surfaces as one, up to their convex hull.
struct Sheet {
    Vec3 normal;
    Interval level;  // along the normal: not quite flat
    std::vector<Vec3> hull;
    double slack = 0.0;  // touching it is not crossing it [m]
};

std::vector<Sheet> make_sheets(const Scene& scene, const PlaneGroups& groups) {
    const LocalTolerance tolerance(scene);
    std::vector<Sheet> sheets;
    for (const std::vector<SurfaceIndex>& members : groups.members) {
        const Surface& first = scene.surfaces[members[0]];
        std::vector<Vec3> corners;
        for (const SurfaceIndex s : members)
            corners.insert(corners.end(), scene.surfaces[s].corners.begin(),
                           scene.surfaces[s].corners.end());
        sheets.push_back({first.normal, along(corners, first.normal),
                          members.size() == 1
                              ? corners
                              : convex_hull(corners, frame_of(first.corners[0], first.normal)),
                          tolerance.rounding(members[0], in_plane)});
    }
    return sheets;
}

/// work(0) to work(count - 1) in parallel; false if `go_on` was.
template <typename Work>
bool in_batches(std::size_t count, const std::function<bool()>& go_on, const Work& work) {
    constexpr std::size_t batch = 32;
    for (std::size_t first = 0; first < count; first += batch) {
        tbb::parallel_for(first, std::min(first + batch, count), work);
        if (go_on && !go_on()) return false;
    }
    return true;
}

/// Axes that turn with the scene: those of its largest surface, the first of equals.
std::array<Vec3, 3> axes_of(const Scene& scene) {
    constexpr double larger = 1.0 + 1e-9;
    const Surface* largest = &scene.surfaces[0];
    for (const Surface& surface : scene.surfaces)
        if (surface.area > larger * largest->area) largest = &surface;
    const PlaneFrame frame = frame_along(largest->corners, largest->normal);
    return {frame.u, frame.v, frame.normal};
}

struct Tester {
    std::array<Vec3, 3> axes;

    /// About a unit direction, from the first of some vectors that is far from it.
    PlaneFrame frame_round(const Vec3& from, const Vec3& direction, const Vec3& normal) const {
        constexpr double least_sine = 0.1;
        for (const Vec3& vector : {normal, axes[0], axes[1]})
            if (vector.cross(direction).norm() > least_sine)
                return frame_along(from, vector, direction);
        return frame_of(from, direction);
    }

    bool can_block(const Sheet& blocker, std::span<const Vec3> a, const Sheet& plane_a,
                   std::span<const Vec3> b, const Sheet& plane_b) const {
        const double slack = blocker.slack;
        const Interval side_a = along(a, blocker.normal), side_b = along(b, blocker.normal);
        if (std::max(side_a.high, side_b.high) <= blocker.level.low + slack ||
            std::min(side_a.low, side_b.low) >= blocker.level.high - slack)
            return false;
        const std::span<const Vec3> corners(blocker.hull);
        if (along(corners, plane_a.normal).high <= plane_a.level.low + slack) return false;
        if (along(corners, plane_b.normal).high <= plane_b.level.low + slack) return false;
        for (const Vec3& axis : axes)
            if (apart(along(a, axis), along(b, axis), along(corners, axis), slack)) return false;
        return !parted_sideways(corners, a, b, plane_a.normal, slack);
    }

    /// Planes along the line between the two centres, in eight directions round it.
    bool parted_sideways(std::span<const Vec3> corners, std::span<const Vec3> a,
                         std::span<const Vec3> b, const Vec3& normal, double slack) const {
        Vec3 from = Vec3::Zero(), to = Vec3::Zero();
        for (const Vec3& p : a) from += p / static_cast<double>(a.size());
        for (const Vec3& p : b) to += p / static_cast<double>(b.size());
        if (!((to - from).norm() > slack)) return false;
        const PlaneFrame frame = frame_round(from, (to - from).normalized(), normal);
        constexpr double s = 0.38268343236508977, c = 0.92387953251128674;  // sine, cosine of 22.5°
        for (const auto& [x, y] :
             {std::pair(1.0, 0.0), {c, s}, {c, c}, {s, c}, {0.0, 1.0}, {-s, c}, {-c, c}, {-c, s}}) {
            const Vec3 direction = (x * frame.u + y * frame.v).normalized();
            if (apart(along(a, direction), along(b, direction), along(corners, direction), slack))
                return true;
        }
        return false;
    }
};

}  // namespace

BlockerTable::BlockerTable(const Scene& scene, const PatchMesh& mesh, const PlaneGroups& groups,
                           const std::function<bool()>& go_on) {
    const PatchClusters clusters = make_clusters(scene, mesh, groups);
    cluster_ = clusters.of_patch;
    const std::size_t n = clusters.size(), planes = groups.size();
    const double pairs = static_cast<double>(planes) * static_cast<double>(planes);
    always_ = pairs * static_cast<double>(planes) > most_work ||
              static_cast<double>(n) * static_cast<double>(n) > most_work;
    if (always_) return;
    const Tester tester{axes_of(scene)};
    const std::vector<Sheet> sheets = make_sheets(scene, groups);
    // Blockers of pairs of planes first: pairs of clusters look at those alone.
    std::vector<std::vector<std::uint32_t>> blockers(planes * planes);
    always_ = !in_batches(planes, go_on, [&](std::size_t s) {
        for (std::size_t t = s + 1; t < planes; ++t)
            for (std::uint32_t k = 0; k < planes; ++k)
                if (k != s && k != t &&
                    tester.can_block(sheets[k], sheets[s].hull, sheets[s], sheets[t].hull,
                                     sheets[t]))
                    blockers[s * planes + t].push_back(k);
    });
    if (always_) return;
    words_ = (n + 63) / 64;
    bits_.assign(n * words_, 0);
    always_ = !in_batches(n, go_on, [&](std::size_t c) {
        for (std::size_t d = 0; d < n; ++d) {
            const auto [first, second] = std::minmax(c, d);
            const std::uint32_t s = clusters.group[first], t = clusters.group[second];
            if (s == t) continue;
            for (const std::uint32_t k : blockers[s * planes + t])
                if (tester.can_block(sheets[k], clusters.points(first), sheets[s],
                                     clusters.points(second), sheets[t])) {
                    bits_[c * words_ + d / 64] |= std::uint64_t{1} << (d % 64);
                    break;
                }
        }
    });
}

}  // namespace patchlight
