#pragma once

#include "solver/mesh/patch_mesh.h"
#include "solver/rays/ray_scene.h"
#include "solver/solution.h"

#include <array>
#include <unordered_map>
#include <vector>

namespace patchlight {

/// A field on a display mesh, averaged over small cells of each patch, to be looked up quickly: as
/// fine as shadows are, where patches are not, and finer where the display is.
class FieldTable {
  public:
    /// `values` at the display's vertices, less what each patch is `without`, but not below 0; or
    /// nothing. Patches that share a vertex may be without different things.
    FieldTable(const PatchMesh& mesh, const DisplayMesh& display, const RayScene& rays,
               const std::vector<Rgb>& values, const std::vector<Rgb>& without = {});

    /// Adds a linear function to the cells of a patch: its value at the centroid and its slope,
    /// rows channels, columns world axes [1/m].
    void add_linear(PatchIndex i, const Rgb& value, const Eigen::Matrix3d& slope);

    /// Number of the cell at a point of patch i in ray space.
    std::size_t cell(PatchIndex i, float x, float y, float z) const {
        const Frame& frame = frames_[i];
        const float u = (x - frame.ox) * frame.ux + (y - frame.oy) * frame.uy +
                        (z - frame.oz) * frame.uz,
                    v = (x - frame.ox) * frame.vx + (y - frame.oy) * frame.vy +
                        (z - frame.oz) * frame.vz;
        return frame.first + row(v, frame.count) * frame.count + row(u, frame.count);
    }
    const std::array<float, 3>& value(std::size_t cell) const { return cells_[cell]; }

    std::size_t cells() const { return cells_.size(); }
    /// Cells of patch i are those from its first up to that of the next.
    std::size_t first_cell(PatchIndex i) const { return frames_[i].first; }
    std::size_t end_cell(PatchIndex i) const {
        return frames_[i].first + frames_[i].count * frames_[i].count;
    }
    /// Of each cell of patch i in ray space.
    double cell_area(PatchIndex i) const { return areas_[i]; }

    struct Spot {
        RayPoint position;     // [ray space]
        bool on_patch = true;  // false: of the cell's part that lies beside it
    };
    /// A point of a cell from two numbers in [0, 1). Cells fill the parallelogram about the patch.
    Spot spot(PatchIndex i, std::size_t cell, float u, float v) const;

  private:
    struct Frame {  // (p - o)·u counts cells along the first edge, (p - o)·v along the last
        float ox = 0, oy = 0, oz = 0, ux = 0, uy = 0, uz = 0, vx = 0, vy = 0, vz = 0;
        std::size_t first = 0, count = 1;  // cells, and how many along each direction
    };
    struct Edges {  // of the cells of a patch, from one corner [ray space]
        RayPoint origin, first, last;
    };
    using Outline = std::array<Eigen::Vector2f, 4>;  // corners along these edges [1]
    bool is_on_patch(PatchIndex i, float u, float v) const;
    struct Filler;
    /// Of what lies far off a needle, or nowhere, too.
    static std::size_t row(float u, std::size_t count) {
        const auto last = static_cast<float>(count - 1);
        if (!(u > 0.0f)) return 0;
        return u < last ? static_cast<std::size_t>(u) : count - 1;
    }

    const PatchMesh& mesh_;
    const RayScene& rays_;
    std::vector<Frame> frames_;
    std::vector<Edges> edges_;
    std::unordered_map<PatchIndex, Outline> outlines_;  // of quads that are no parallelograms
    std::vector<double> areas_;
    std::vector<std::array<float, 3>> cells_;
};

}  // namespace patchlight
