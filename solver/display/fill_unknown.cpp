#include "solver/display/fill_unknown.h"

#include "solver/rays/low_discrepancy.h"

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>

namespace patchlight {

namespace {

constexpr std::array<double, 4> cells_across{64.0, 16.0, 4.0, 1.0};  // the scene; finest first

struct Mean {
    Rgb sum = Rgb::Zero();
    double count = 0.0;
};

/// Means over the known corners of roots in cells of the scene, of each of six ways to face.
class CellMeans {
  public:
    CellMeans(const Scene& scene, const PatchMesh& mesh, const RefinementTree& tree)
        : scene_(scene), mesh_(mesh) {
        for (const TreeVertex& vertex : tree.vertices()) box_.extend(vertex.position);
        size_ = box_.sizes().maxCoeff();
    }

    void add(const TreeVertex& vertex, const Rgb& value) {
        for (const double across : cells_across) {
            Mean& mean = means_[key(vertex, across)];
            mean.sum += value;
            mean.count += 1.0;
        }
    }

    /// In a cell of the first `sizes` sizes.
    std::optional<Rgb> at(const TreeVertex& vertex, std::size_t sizes) const {
        for (const double across : std::span(cells_across).first(sizes))
            if (const auto found = means_.find(key(vertex, across)); found != means_.end())
                return found->second.sum / found->second.count;
        return std::nullopt;
    }

  private:
    std::uint64_t key(const TreeVertex& vertex, double across) const {
        const Vec3& normal = scene_.surfaces[mesh_.patches[vertex.patch].surface].normal;
        Eigen::Index axis = 0;
        normal.cwiseAbs().maxCoeff(&axis);
        std::uint64_t key = static_cast<std::uint64_t>(2 * axis) + (normal[axis] > 0.0 ? 1 : 0);
        const Vec3 cell = (vertex.position - box_.min()) * (0.999 * across / size_);
        for (int d = 0; d < 3; ++d) key = key * 64 + static_cast<std::uint64_t>(cell[d]);
        return mix(key, static_cast<std::uint64_t>(across));
    }

    const Scene& scene_;
    const PatchMesh& mesh_;
    Eigen::AlignedBox3d box_;
    double size_ = 1.0;  // [m]
    std::unordered_map<std::uint64_t, Mean> means_;
};

}  // namespace

void fill_unknown(const Scene& scene, const PatchMesh& mesh, const RefinementTree& tree,
                  const std::vector<bool>& known, const std::vector<Rgb>& guess,
                  std::vector<Rgb>& values) {
    CellMeans means(scene, mesh, tree);
    const std::vector<TreeVertex>& vertices = tree.vertices();
    const auto is_known = [&](std::size_t v) { return v < known.size() && known[v]; };
    for (std::size_t v = 0; v < vertices.size(); ++v)
        if (vertices[v].parent_count == 0 && is_known(v)) means.add(vertices[v], values[v]);
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        if (vertices[v].parent_count > 0 || is_known(v)) continue;
        const auto mean = means.at(vertices[v], guess.empty() ? cells_across.size() : 1);
        if (mean)
            values[v] = *mean;
        else if (!guess.empty())
            values[v] = guess[vertices[v].patch];
    }
}

}  // namespace patchlight
