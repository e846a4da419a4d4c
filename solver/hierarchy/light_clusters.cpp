#include "solver/hierarchy/light_clusters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

namespace patchlight {

namespace {

/// Weight of squared differences of normals beside those of places over the scene's size: a radian
/// counts as much as a tenth of that size.
constexpr double normals_beside_places = 0.01;

/// Sides that face away from each other, as those of a thin wall, have nothing in common.
constexpr double opposed = 0.5;             // length of the mean normal: below, some are
constexpr double sooner_if_opposed = 10.0;  // times as likely to be cut

using Coordinates = std::array<double, 6>;  // of a patch: its centre over the scene's size, then
                                            // its normal, weighed as above

struct Candidate {
    double spread = 0.0;  // sum of area times the variance of its coordinates
    std::size_t first = 0, end = 0;
    std::size_t widest = 0;  // coordinate
    double middle = 0.0;     // mean of that coordinate
    bool operator<(const Candidate& other) const {
        return spread != other.spread ? spread < other.spread : first > other.first;
    }
};

class Cutter {
  public:
    Cutter(const Scene& scene, const PatchMesh& mesh) : mesh_(mesh), at_(mesh.size()) {
        Vec3 mean = Vec3::Zero();
        double area = 0.0, square = 0.0;
        for (PatchIndex i = 0; i < mesh.size(); ++i) {
            if (mesh.patches[i].covered) continue;
            patches_.push_back(i);
            area += mesh.patches[i].area;
            mean += mesh.patches[i].area * mesh.patches[i].centre;
        }
        if (area > 0.0) mean /= area;
        for (const PatchIndex i : patches_)
            square += mesh.patches[i].area * (mesh.patches[i].centre - mean).squaredNorm();
        const double size = square > 0.0 ? std::sqrt(square / area) : 1.0;
        for (const PatchIndex i : patches_) {
            const Vec3 place = (mesh.patches[i].centre - mean) / size;
            const Vec3 facing =
                std::sqrt(normals_beside_places) * scene.surfaces[mesh.patches[i].surface].normal;
            at_[i] = {place.x(), place.y(), place.z(), facing.x(), facing.y(), facing.z()};
        }
    }

    LightClusters cut(std::size_t most) {
        std::priority_queue<Candidate> queue;
        std::vector<Candidate> done;
        if (!patches_.empty()) queue.push(measure(0, patches_.size()));
        while (!queue.empty() && queue.size() + done.size() < most) {
            const Candidate widest = queue.top();
            queue.pop();
            if (!(widest.spread > 0.0)) {
                done.push_back(widest);
                continue;
            }
            const std::size_t middle = divide(widest);
            queue.push(measure(widest.first, middle));
            queue.push(measure(middle, widest.end));
        }
        for (; !queue.empty(); queue.pop()) done.push_back(queue.top());
        return list(done);
    }

  private:
    Candidate measure(std::size_t first, std::size_t end) const {
        Coordinates sum{}, square{};
        double area = 0.0;
        for (std::size_t k = first; k < end; ++k) {
            const double a = mesh_.patches[patches_[k]].area;
            const Coordinates& at = at_[patches_[k]];
            area += a;
            for (std::size_t d = 0; d < at.size(); ++d) {
                sum[d] += a * at[d];
                square[d] += a * at[d] * at[d];
            }
        }
        Candidate candidate{0.0, first, end};
        if (end - first < 2) return candidate;
        double most = 0.0;
        for (std::size_t d = 0; d < sum.size(); ++d) {
            const double spread = std::max(0.0, square[d] - sum[d] * sum[d] / area);
            candidate.spread += spread;
            if (spread <= most) continue;
            most = spread;
            candidate.widest = d;
            candidate.middle = sum[d] / area;
        }
        if (candidate.spread <= rounding * area) candidate.spread = 0.0;
        double mean_normal = 0.0;
        for (std::size_t d = 3; d < sum.size(); ++d) mean_normal += sum[d] * sum[d];
        if (mean_normal < normals_beside_places * std::pow(opposed * area, 2))
            candidate.spread *= sooner_if_opposed;
        return candidate;
    }

    /// Where the second half begins; neither is empty.
    std::size_t divide(const Candidate& candidate) {
        const auto begin = patches_.begin() + static_cast<std::ptrdiff_t>(candidate.first),
                   end = patches_.begin() + static_cast<std::ptrdiff_t>(candidate.end);
        const std::size_t d = candidate.widest;
        auto middle =
            std::partition(begin, end, [&](PatchIndex i) { return at_[i][d] < candidate.middle; });
        if (middle == begin || middle == end) middle = begin + (end - begin) / 2;
        return static_cast<std::size_t>(middle - patches_.begin());
    }

    LightClusters list(std::vector<Candidate>& parts) {
        std::sort(parts.begin(), parts.end(),
                  [](const Candidate& a, const Candidate& b) { return a.first < b.first; });
        LightClusters clusters;
        clusters.of_patch.assign(mesh_.size(), 0);
        for (const Candidate& part : parts) {
            double area = 0.0;
            std::sort(patches_.begin() + static_cast<std::ptrdiff_t>(part.first),
                      patches_.begin() + static_cast<std::ptrdiff_t>(part.end));
            for (std::size_t k = part.first; k < part.end; ++k) {
                clusters.of_patch[patches_[k]] = static_cast<std::uint32_t>(clusters.size());
                area += mesh_.patches[patches_[k]].area;
            }
            clusters.first.push_back(part.first);
            clusters.area.push_back(area);
        }
        clusters.first.push_back(patches_.size());
        clusters.patches = std::move(patches_);
        return clusters;
    }

    static constexpr double rounding = 1e-14;  // of squared coordinates

    const PatchMesh& mesh_;
    std::vector<Coordinates> at_;      // per patch
    std::vector<PatchIndex> patches_;  // that are not covered, by parts
};

}  // namespace

LightClusters make_light_clusters(const Scene& scene, const PatchMesh& mesh, std::size_t most) {
    return Cutter(scene, mesh).cut(most);
}

}  // namespace patchlight
