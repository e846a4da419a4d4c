#include "solver/findings/surface_tree.h"

#include <algorithm>
#include <utility>

namespace patchlight {

namespace {

/// Whether p, projected along the normal, lies in the outline (even-odd rule, as seen along the
/// axis nearest to the normal).
bool is_over(const Surface& surface, const Vec3& p) {
    Eigen::Index drop = 0;
    surface.normal.cwiseAbs().maxCoeff(&drop);
    const Eigen::Index x = (drop + 1) % 3, y = (drop + 2) % 3;
    bool inside = false;
    const std::size_t n = surface.corners.size();
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3 &a = surface.corners[k], &b = surface.corners[(k + 1) % n];
        if ((a[y] > p[y]) != (b[y] > p[y]) &&
            p[x] < a[x] + (b[x] - a[x]) * (p[y] - a[y]) / (b[y] - a[y]))
            inside = !inside;
    }
    return inside;
}

struct BoxQuery {
    using Volume = Box;
    const Box& wanted;
    const std::vector<Box>& boxes;
    std::vector<SurfaceIndex> found{};

    bool intersectVolume(const Box& box) const { return wanted.intersects(box); }
    bool intersectObject(SurfaceIndex s) {
        if (wanted.intersects(boxes[s])) found.push_back(s);
        return false;  // go on
    }
};

std::shared_ptr<const std::vector<Box>> boxes_of(const Scene& scene) {
    auto boxes = std::make_shared<std::vector<Box>>(scene.surfaces.size());
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s)
        for (const Vec3& p : scene.surfaces[s].corners) (*boxes)[s].extend(p);
    return boxes;
}

std::vector<SurfaceIndex> fronts_of(const Scene& scene) {
    std::vector<SurfaceIndex> fronts;
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s)
        if (scene.surfaces[s].side == Side::front) fronts.push_back(s);
    return fronts;
}

}  // namespace

Vec3 nearest_point(const Surface& surface, const Vec3& p) {
    const Vec3 foot = p - (p - surface.corners[0]).dot(surface.normal) * surface.normal;
    if (is_over(surface, foot)) return foot;
    Vec3 nearest = surface.corners[0];
    const std::size_t n = surface.corners.size();
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3& a = surface.corners[k];
        const Vec3 along = surface.corners[(k + 1) % n] - a;
        const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
        const Vec3 at = a + t * along;
        if ((p - at).squaredNorm() < (p - nearest).squaredNorm()) nearest = at;
    }
    return nearest;
}

SurfaceTree::SurfaceTree(const Scene& scene, std::shared_ptr<const std::vector<Box>> boxes,
                         std::vector<SurfaceIndex> listed)
    : scene_(scene), boxes_(std::move(boxes)), listed_(std::move(listed)) {
    std::vector<Box> listed_boxes;
    listed_boxes.reserve(listed_.size());
    for (const SurfaceIndex s : listed_) listed_boxes.push_back(box(s));
    tree_.init(listed_.begin(), listed_.end(), listed_boxes.begin(), listed_boxes.end());
}

SurfaceTree::SurfaceTree(const Scene& scene)
    : SurfaceTree(scene, boxes_of(scene), fronts_of(scene)) {}

SurfaceTree SurfaceTree::only(const std::vector<SurfaceIndex>& surfaces) const {
    return {scene_, boxes_, surfaces};
}

std::vector<SurfaceIndex> SurfaceTree::over(const Box& box) const {
    BoxQuery query{box, *boxes_};
    if (tree_.getRootIndex() >= 0)
        Eigen::BVIntersect(tree_, query);
    else
        for (const SurfaceIndex s : listed_) query.intersectObject(s);
    std::sort(query.found.begin(), query.found.end());
    return std::move(query.found);
}

std::vector<SurfaceTree::Near> SurfaceTree::within(const Vec3& p, double reach) const {
    const Box box(p - Vec3::Constant(reach), p + Vec3::Constant(reach));
    std::vector<Near> near;
    for (const SurfaceIndex s : over(box)) {
        const Vec3 point = nearest_point(scene_.surfaces[s], p);
        const double distance = (point - p).norm();
        if (distance <= reach) near.push_back({s, distance, point});
    }
    return near;
}

}  // namespace patchlight
