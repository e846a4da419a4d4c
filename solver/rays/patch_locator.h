#pragma once

#include "solver/mesh/patch_mesh.h"
#include "solver/rays/ray_scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace patchlight {

/// Finds the patch of a surface at a point on it. Grids that are parallelograms by arithmetic, all
/// else through square cells that list the patches over them.
class PatchLocator {
  public:
    PatchLocator(const Scene& scene, const PatchMesh& mesh, const RayScene& rays);

    /// In the frame of the surface; a point off it by rounding gets the patch nearest to it.
    PatchIndex find(SurfaceIndex s, float x, float y, float z) const {
        const Cells& cells = cells_[s];
        if (cells.single) return cells.first;
        const float u =
            (x - cells.ox) * cells.ux + (y - cells.oy) * cells.uy + (z - cells.oz) * cells.uz;
        const float v =
            (x - cells.ox) * cells.vx + (y - cells.oy) * cells.vy + (z - cells.oz) * cells.vz;
        const std::int32_t i = clamp(static_cast<std::int32_t>(u), cells.nu);
        const std::int32_t j = clamp(static_cast<std::int32_t>(v), cells.nv);
        if (!cells.listed) return cells.first + static_cast<PatchIndex>(j * cells.nu + i);
        const std::size_t cell = cells.first_list + static_cast<std::size_t>(j * cells.nu + i);
        const std::uint32_t first = list_starts_[cell], end = list_starts_[cell + 1];
        return end - first == 1 ? lists_[first] : search(cells, first, end, u, v);
    }

  private:
    struct Cells {  // (p - o)·u counts cells along the first direction, (p - o)·v along the second
        float ox = 0, oy = 0, oz = 0, ux = 0, uy = 0, uz = 0, vx = 0, vy = 0, vz = 0;
        std::int32_t nu = 1, nv = 1;
        PatchIndex first = 0;
        std::uint32_t first_list = 0;
        bool single = false, listed = false;
    };
    struct Line {  // u·a + v·b + w: how far (a, b) is beyond it, in cells
        float u = 0, v = 0, w = 0;
    };
    using Shape = std::array<Line, 4>;  // round a patch
    static Shape lines_of(const std::array<Vec2, 4>& corners);
    static std::int32_t clamp(std::int32_t i, std::int32_t n) {
        return i < 0 ? 0 : i >= n ? n - 1 : i;
    }
    static void set_axes(Cells& cells, const Vec3& u, const Vec3& v);
    bool fit_grid(Cells& cells, const Surface& surface, FrameIndex frame,
                  const std::array<std::uint32_t, 2>& grid, const RayScene& rays) const;
    void list_patches(Cells& cells, SurfaceIndex s, const Surface& surface, const PatchMesh& mesh,
                      PatchIndex end, const RayScene& rays);
    PatchIndex search(const Cells& cells, std::uint32_t first, std::uint32_t end, float u,
                      float v) const;

    std::vector<Cells> cells_;                // per surface
    std::vector<std::uint32_t> list_starts_;  // per cell of a listed surface, and one more
    std::vector<PatchIndex> lists_;
    std::vector<Shape> shapes_;  // per patch; only those of listed surfaces are filled
};

}  // namespace patchlight
