#include "solver/form_factors/hemicube_view.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace patchlight {

namespace {

constexpr double far_depth = 8.0;      // over the scene's extent [1]
constexpr double edge_on = 1e-12;      // an eye so close to a plane sees nothing of it
constexpr double most_distance = 4.0;  // over its extent: of any two points, and more [1]

}  // namespace

HemicubeScene::HemicubeScene(const Scene& scene, const RayScene& rays) {
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        const Surface& surface = scene.surfaces[s];
        const PlaneFrame frame = frame_of(surface.corners[0], surface.normal);
        const auto first = static_cast<std::uint32_t>(vertices_.size());
        std::vector<Vec2> flat;
        for (const Vec3& p : surface.corners) {
            flat.push_back(frame.flat(p));
            vertices_.push_back(rays.to_ray_space(p, rays.frame(s)).cast<double>() +
                                rays.shift(rays.frame(s), 0));
            extent_ = std::max(extent_, vertices_.back().cwiseAbs().maxCoeff());
        }
        for (const auto& t : triangulate(flat))
            triangles_.push_back({{first + t[0], first + t[1], first + t[2]}, s});
        normals_.push_back(surface.normal);
        levels_.push_back(surface.normal.dot(vertices_[first]));
    }
}

HemicubeSight HemicubeScene::sight(SurfaceIndex s, const Vec3& eye, const Vec3& direction) const {
    const double height = height_above(s, eye);
    const double towards = normals_[s].dot(direction);
    const double length = direction.norm();
    // The pixel's centre may miss the polygon's plane by a rounding: then it is far off on it.
    const double reach = most_distance * extent_ / length;
    const double t = height * towards < 0.0 ? std::min(reach, -height / towards) : reach;
    return {s, height > 0.0, t * length, eye + t * direction};
}

HemicubeView::HemicubeView(const HemicubeScene& scene, const HemicubeCells& cells,
                           const RayScene& rays)
    : scene_(scene),
      cells_(cells),
      rays_(rays),
      top_(cells.width(), cells.width()),
      side_(cells.width(), cells.side_height()) {}

void HemicubeView::choose_triangles(const HemicubePose& pose) {
    local_.clear();
    for (const Vec3& p : scene_.vertices()) {
        const Vec3 d = p - pose.eye;
        local_.emplace_back(d.dot(pose.tangent), d.dot(pose.bitangent), d.dot(pose.normal));
    }
    triangles_.clear();
    items_.clear();
    for (const bool front : {false, true})
        for (const HemicubeScene::Triangle& t : scene_.triangles()) {
            const double height = scene_.height_above(t.surface, pose.eye);
            if (std::abs(height) < edge_on || (height > 0.0) != front) continue;
            if (std::all_of(t.vertices.begin(), t.vertices.end(),
                            [&](std::uint32_t v) { return local_[v].z() <= 0.0; }))
                continue;
            triangles_.push_back(t.vertices);
            items_.push_back(t.surface);
        }
}

HemicubeView::Directions HemicubeView::draw(const HemicubePose& pose, int face) {
    const Vec3 axes[] = {Vec3::UnitZ(), Vec3::UnitX(), -Vec3::UnitX(), Vec3::UnitY(),
                         -Vec3::UnitY()};
    const bool is_top = face == 0;
    const Vec3 ahead = axes[face], up = is_top ? Vec3::UnitY() : Vec3::UnitZ();
    const Vec3 right = ahead.cross(up);
    const double near_depth = pose.near_depth, end = far_depth * scene_.extent();
    canonical_.clear();
    for (const Vec3& p : local_) {
        // |x|, |y| <= w and 0 <= z <= w within 45 degrees of the axis, z = w at the near depth;
        // a side face keeps its upper half, y from 0 to w.
        const double w = p.dot(ahead) / near_depth, y = p.dot(up) / near_depth;
        canonical_.emplace_back(p.dot(right) / near_depth, is_top ? y : 2.0 * y - w,
                                (end - w * near_depth) / (end - near_depth), w);
    }
    raster::ItemBuffer& target = buffer(face);
    target.clear();
    target.draw(canonical_, triangles_, items_);
    const auto world = [&](const Vec3& v) {
        return Vec3(v.x() * pose.tangent + v.y() * pose.bitangent + v.z() * pose.normal);
    };
    const double dx = 2.0 / cells_.width(), dy = is_top ? dx : 1.0 / cells_.side_height();
    return {world(ahead + (0.5 * dx - 1.0) * right + (1.0 - 0.5 * dy) * up), world(dx * right),
            world(-dy * up)};
}

bool HemicubeView::is_doubtful(std::span<const std::uint32_t> items, std::size_t cell,
                               bool is_top) const {
    const auto width = static_cast<std::size_t>(cells_.width());
    const std::uint32_t item = items[cell];
    const std::size_t column = cell % width;
    const bool last_row = cell + width >= items.size();
    // At the face's border the neighbour is on another face; below the horizon there is none.
    if (column == 0 || column + 1 == width || cell < width || (last_row && is_top)) return true;
    return items[cell - 1] != item || items[cell + 1] != item || items[cell - width] != item ||
           (!last_row && items[cell + width] != item);
}

/// Rays through doubtful cells from number `first` on, up to ray_batch; how many.
int HemicubeView::cast(const HemicubePose& pose, const Directions& directions, std::size_t first) {
    RayBatch batch;
    LandingBatch landings;
    const int count = static_cast<int>(std::min<std::size_t>(ray_batch, doubtful_.size() - first));
    const RayPoint eye = (pose.eye - rays_.shift(pose.frame, 0)).cast<float>();
    for (int k = 0; k < ray_batch; ++k) {
        const std::size_t cell =
            doubtful_[first + static_cast<std::size_t>(std::min(k, count - 1))];
        const RayPoint d = directions.at(cell, cells_.width()).cast<float>();
        batch.ox[k] = eye.x(), batch.oy[k] = eye.y(), batch.oz[k] = eye.z();
        batch.dx[k] = d.x(), batch.dy[k] = d.y(), batch.dz[k] = d.z();
        batch.frame[k] = pose.frame;
    }
    rays_.land(batch, count, landings);
    for (int k = 0; k < count; ++k) {
        landed_[k] = landings.landing[k] != Landing::escaped;
        if (!landed_[k]) continue;
        const Vec3 point = Vec3(landings.x[k], landings.y[k], landings.z[k]) +
                           rays_.shift(rays_.frame(landings.surface[k]), 0);
        sights_[k] = {landings.surface[k], landings.landing[k] == Landing::front,
                      (point - pose.eye).norm(), point};
    }
    return count;
}

}  // namespace patchlight
