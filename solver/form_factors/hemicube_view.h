#pragma once

#include "raster/item_buffer.h"
#include "solver/form_factors/hemicube_cells.h"
#include "solver/rays/ray_scene.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace patchlight {

/// Where a hemicube stands, in ray space: right-handed frame, `normal` towards the top face.
struct HemicubePose {
    Vec3 eye = Vec3::Zero();
    Vec3 tangent = Vec3::UnitX(), bitangent = Vec3::UnitY(), normal = Vec3::UnitZ();
    double near_depth = 0.0;  // nothing nearer to the eye's plane is seen
    FrameIndex frame = 0;     // in which its rays are cast; all places are told in frame 0
};

/// What is seen through one cell.
struct HemicubeSight {
    SurfaceIndex surface = 0;
    bool front = false;         // else its back
    double distance = 0.0;      // from the eye [ray space]
    Vec3 point = Vec3::Zero();  // in ray space
};

/// The scene's polygons in ray space, cut into triangles for item buffers: whole polygons, not
/// patches, for the patch of a cell follows from where its line of sight meets the polygon's plane.
class HemicubeScene {
  public:
    HemicubeScene(const Scene& scene, const RayScene& rays);
    /// More than any point of it is off the origin [ray space].
    double extent() const { return extent_; }

    struct Triangle {
        std::array<std::uint32_t, 3> vertices;
        SurfaceIndex surface;
    };
    const std::vector<Vec3>& vertices() const { return vertices_; }
    const std::vector<Triangle>& triangles() const { return triangles_; }
    double height_above(SurfaceIndex s, const Vec3& p) const {
        return normals_[s].dot(p) - levels_[s];
    }

    /// What lies on surface s in `direction`, which need not be a unit vector, from `eye`.
    HemicubeSight sight(SurfaceIndex s, const Vec3& eye, const Vec3& direction) const;

  private:
    std::vector<Vec3> vertices_;
    std::vector<Triangle> triangles_;
    std::vector<Vec3> normals_;   // per surface
    std::vector<double> levels_;  // normal · p of its plane
    double extent_ = 1.0;
};

/// Draws the scene on the faces of hemicubes of one resolution. Of a front and a back that
/// coincide the front is seen, of coplanar fronts the one listed last. Corners on the screen are
/// whole multiples of 1/256 cell, so where polygons meet a cell may look past an edge, and light
/// would cross a wall: cells beside a cell of another polygon, or at the border of a face, are
/// decided by a ray. Not for several threads.
class HemicubeView {
  public:
    HemicubeView(const HemicubeScene& scene, const HemicubeCells& cells, const RayScene& rays);

    /// Calls visit(share, sight) for every cell; sight is nullptr where nothing is seen. Returns
    /// how many rays were cast.
    template <typename Visit>
    std::uint64_t look(const HemicubePose& pose, const Visit& visit) {
        return look_through(pose, [&](int, std::size_t, double share, const HemicubeSight* sight) {
            visit(share, sight);
        });
    }

    static constexpr int faces = 5;  // the top is the first, then +x, -x, +y, -y of the pose

    /// The same with visit(face, cell, share, sight), cells in no order.
    template <typename Visit>
    std::uint64_t look_through(const HemicubePose& pose, const Visit& visit) {
        std::uint64_t rays = 0;
        choose_triangles(pose);
        for (int face = 0; face < faces; ++face) {
            const Directions directions = draw(pose, face);
            const std::span<const std::uint32_t> items = buffer(face).items();
            const std::vector<double>& shares = face == 0 ? cells_.top() : cells_.side();
            doubtful_.clear();
            for (std::size_t k = 0; k < items.size(); ++k) {
                if (is_doubtful(items, k, face == 0)) {
                    doubtful_.push_back(k);
                } else if (items[k] == raster::ItemBuffer::nothing) {
                    visit(face, k, shares[k], nullptr);
                } else {
                    const HemicubeSight sight =
                        scene_.sight(items[k], pose.eye, directions.at(k, cells_.width()));
                    visit(face, k, shares[k], &sight);
                }
            }
            for (std::size_t first = 0; first < doubtful_.size(); first += ray_batch) {
                const int count = cast(pose, directions, first);
                for (int k = 0; k < count; ++k) {
                    const std::size_t cell = doubtful_[first + static_cast<std::size_t>(k)];
                    visit(face, cell, shares[cell], landed_[k] ? &sights_[k] : nullptr);
                }
            }
            rays += doubtful_.size();
        }
        return rays;
    }

  private:
    struct Directions {  // of the cell centres of one face
        Vec3 first, per_column, per_row;
        Vec3 at(std::size_t cell, int width) const {
            const int row = static_cast<int>(cell) / width, column = static_cast<int>(cell) % width;
            return first + column * per_column + row * per_row;
        }
    };
    raster::ItemBuffer& buffer(int face) { return face == 0 ? top_ : side_; }
    void choose_triangles(const HemicubePose& pose);
    Directions draw(const HemicubePose& pose, int face);
    bool is_doubtful(std::span<const std::uint32_t> items, std::size_t cell, bool is_top) const;
    int cast(const HemicubePose& pose, const Directions& directions, std::size_t first);

    const HemicubeScene& scene_;
    const HemicubeCells& cells_;
    const RayScene& rays_;
    raster::ItemBuffer top_, side_;
    std::vector<Vec3> local_;                              // vertices in the pose's frame
    std::vector<Eigen::Vector4d> canonical_;               // of the face in hand
    std::vector<std::array<std::uint32_t, 3>> triangles_;  // backs first, then fronts
    std::vector<std::uint32_t> items_;                     // their surfaces
    std::vector<std::size_t> doubtful_;                    // cells of the face in hand
    std::array<HemicubeSight, ray_batch> sights_;          // where the last rays landed
    std::array<bool, ray_batch> landed_{};
};

}  // namespace patchlight
