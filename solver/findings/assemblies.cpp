#include "solver/findings/assemblies.h"

#include "solver/scene/touching_pairs.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>
#include <optional>

namespace patchlight {

namespace {

constexpr double sheet_distance = 0.01;  // of a sheet's size: it lies on what is nearer [1]
constexpr double parallel = 0.99;        // cosine between normals

bool has_corner_at(const Surface& a, const Surface& b, double reach) {
    return std::any_of(a.corners.begin(), a.corners.end(), [&](const Vec3& p) {
        return std::abs((p - b.corners[0]).dot(b.normal)) <= reach &&
               (nearest_point(b, p) - p).norm() <= reach;
    });
}

bool has_edge_through(const Surface& a, const Surface& b, double reach) {
    const std::size_t n = a.corners.size();
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3 &p = a.corners[k], &q = a.corners[(k + 1) % n];
        const double at_p = (p - b.corners[0]).dot(b.normal),
                     at_q = (q - b.corners[0]).dot(b.normal);
        if ((at_p > 0.0) == (at_q > 0.0)) continue;
        const Vec3 through = p + (q - p) * (at_p / (at_p - at_q));
        if ((nearest_point(b, through) - through).norm() <= reach) return true;
    }
    return false;
}

/// Sets of surfaces that grow together.
class UnionFind {
  public:
    explicit UnionFind(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }
    std::uint32_t find(std::uint32_t s) {
        while (parent_[s] != s) s = parent_[s] = parent_[parent_[s]];
        return s;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a), b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace

namespace {

/// For each surface the earlier ones whose boxes come within reach of its own.
std::vector<std::vector<SurfaceIndex>> near_ones(const FlawSearch& search,
                                                 const SurfaceTree& tree) {
    const Scene& scene = search.scene;
    std::vector<std::vector<SurfaceIndex>> near(scene.surfaces.size());
    for_each_in_parallel(near.size(), search.go_on, [&](std::size_t number) {
        const auto s = static_cast<SurfaceIndex>(number);
        if (scene.surfaces[s].side == Side::back) return;
        const Vec3 margin = Vec3::Constant(2.0 * search.tolerance.at(s));
        const Box& box = tree.box(s);
        near[s] = tree.over(Box(box.min() - margin, box.max() + margin));
        std::erase_if(near[s], [&](SurfaceIndex other) { return other >= s; });
    });
    return near;
}

/// The first surface of each object that is a flat sheet.
std::vector<SurfaceIndex> flat_sheets(const Scene& scene, const LocalTolerance& tolerance) {
    std::vector<std::optional<SurfaceIndex>> first(scene.objects.size());
    std::vector<bool> flat(scene.objects.size(), true);
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        const Surface& surface = scene.surfaces[s];
        if (!first[surface.object]) first[surface.object] = s;
        const Surface& sheet = scene.surfaces[*first[surface.object]];
        for (const Vec3& p : surface.corners)
            if (std::abs((p - sheet.corners[0]).dot(sheet.normal)) >
                tolerance.between(*first[surface.object], s))
                flat[surface.object] = false;
    }
    std::vector<SurfaceIndex> sheets;
    for (ObjectIndex object = 0; object < scene.objects.size(); ++object)
        if (first[object] && flat[object]) sheets.push_back(*first[object]);
    return sheets;
}

/// Joins flat sheets to what they lie along.
void attach_sheets(const Scene& scene, const SurfaceTree& tree, const LocalTolerance& tolerance,
                   UnionFind& sets) {
    for (const SurfaceIndex s : flat_sheets(scene, tolerance)) {
        const Surface& sheet = scene.surfaces[s];
        const double reach = sheet_distance * tree.box(s).diagonal().norm();
        for (const Vec3& p : sheet.corners)
            for (const SurfaceTree::Near& near : tree.within(p, reach)) {
                const Surface& other = scene.surfaces[near.surface];
                if (other.object != sheet.object &&
                    std::abs(other.normal.dot(sheet.normal)) > parallel)
                    sets.join(s, near.surface);
            }
    }
}

}  // namespace

bool touch(const Surface& a, const Surface& b, double reach) {
    return has_corner_at(a, b, reach) || has_corner_at(b, a, reach) ||
           has_edge_through(a, b, reach) || has_edge_through(b, a, reach);
}

Assemblies find_assemblies(const FlawSearch& search, const SurfaceTree& tree) {
    const Scene& scene = search.scene;
    const LocalTolerance& tolerance = search.tolerance;
    const std::vector<std::vector<SurfaceIndex>> neighbours = near_ones(search, tree);
    UnionFind sets(scene.surfaces.size());
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        if (scene.surfaces[s].side == Side::back) {
            sets.join(s, s - 1);  // its front comes right before it
            continue;
        }
        for (const SurfaceIndex other : neighbours[s])
            if (sets.find(other) != sets.find(s) &&
                touch(scene.surfaces[s], scene.surfaces[other], tolerance.between(s, other)))
                sets.join(s, other);
    }
    attach_sheets(scene, tree, tolerance, sets);
    Assemblies assemblies{std::vector<std::uint32_t>(scene.surfaces.size()), {}};
    std::vector<std::uint32_t> number(scene.surfaces.size());
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        const std::uint32_t root = sets.find(s);
        if (root == s) {
            number[s] = static_cast<std::uint32_t>(assemblies.members.size());
            assemblies.members.emplace_back();
        }
        assemblies.of_surface[s] = number[root];
        if (scene.surfaces[s].side == Side::front) assemblies.members[number[root]].push_back(s);
    }
    return assemblies;
}

}  // namespace patchlight
