#include "solver/scene/touching_pairs.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <numeric>
#include <vector>

namespace patchlight {

namespace {

constexpr std::size_t fewest_at_a_time = 64;
constexpr double seconds_between = 0.005;  // two words to the observer
constexpr std::size_t surfaces_of_leaf = 8;

/// Boxes in a tree: each node has those of its half of the surfaces along its longest side.
class BoxTree {
  public:
    BoxTree(const Scene& scene, const LocalTolerance& tolerance)
        : boxes_(scene.surfaces.size()), order_(scene.surfaces.size()) {
        for (SurfaceIndex s = 0; s < boxes_.size(); ++s) {
            for (const Vec3& p : scene.surfaces[s].corners) boxes_[s].extend(p);
            boxes_[s].min().array() -= tolerance.at(s);
            boxes_[s].max().array() += tolerance.at(s);
        }
        std::iota(order_.begin(), order_.end(), SurfaceIndex{0});
        if (!order_.empty()) grow(0, order_.size());
    }

    /// visit(b) for each surface b after a whose box intersects that of a.
    template <typename Visit>
    void each_after(SurfaceIndex a, const Visit& visit) const {
        std::vector<std::uint32_t> left{0};
        while (!left.empty()) {
            const Node& node = nodes_[left.back()];
            left.pop_back();
            if (node.last <= a || !node.box.intersects(boxes_[a])) continue;
            if (node.second == 0) {
                for (std::size_t k = node.first; k < node.end; ++k)
                    if (order_[k] > a && boxes_[order_[k]].intersects(boxes_[a])) visit(order_[k]);
                continue;
            }
            left.push_back(node.second);
            left.push_back(static_cast<std::uint32_t>(&node - nodes_.data()) + 1);
        }
    }

  private:
    struct Node {
        Eigen::AlignedBox3d box;
        std::size_t first = 0, end = 0;  // in `order_`
        SurfaceIndex last = 0;           // the highest number among them
        std::uint32_t second = 0;        // child; the first follows its parent; 0: a leaf
    };

    std::uint32_t grow(std::size_t first, std::size_t end) {
        const auto number = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back();
        Node node;
        node.first = first, node.end = end;
        Eigen::AlignedBox3d centres;
        for (std::size_t k = first; k < end; ++k) {
            node.box.extend(boxes_[order_[k]]);
            centres.extend(boxes_[order_[k]].center());
            node.last = std::max(node.last, order_[k]);
        }
        if (end - first > surfaces_of_leaf) {
            Eigen::Index axis = 0;
            centres.sizes().maxCoeff(&axis);
            const std::size_t middle = first + (end - first) / 2;
            const auto at = [&](std::size_t k) {
                return order_.begin() + static_cast<std::ptrdiff_t>(k);
            };
            std::nth_element(at(first), at(middle), at(end), [&](SurfaceIndex a, SurfaceIndex b) {
                const double p = boxes_[a].center()[axis], q = boxes_[b].center()[axis];
                return p != q ? p < q : a < b;
            });
            grow(first, middle);
            node.second = grow(middle, end);
        }
        nodes_[number] = node;
        return number;
    }

    std::vector<Eigen::AlignedBox3d> boxes_;  // per surface [m]
    std::vector<SurfaceIndex> order_;
    std::vector<Node> nodes_;
};

}  // namespace

void for_each_in_parallel(std::size_t count, const std::function<bool()>& go_on,
                          const std::function<void(std::size_t)>& visit) {
    std::size_t at_a_time = fewest_at_a_time;
    for (std::size_t first = 0, end = 0; first < count; first = end) {
        if (first > 0 && go_on && !go_on()) return;
        const auto began = std::chrono::steady_clock::now();
        end = std::min(first + at_a_time, count);
        tbb::parallel_for(first, end, visit);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
        at_a_time = took.count() < seconds_between ? 2 * at_a_time
                                                   : std::max(at_a_time / 2, fewest_at_a_time);
    }
}

void for_each_touching_pair(const Scene& scene, const LocalTolerance& tolerance,
                            const std::function<bool()>& go_on,
                            const std::function<void(SurfaceIndex, SurfaceIndex)>& visit) {
    const BoxTree tree(scene, tolerance);
    for_each_in_parallel(scene.surfaces.size(), go_on, [&](std::size_t k) {
        const auto a = static_cast<SurfaceIndex>(k);
        tree.each_after(a, [&](SurfaceIndex b) { visit(a, b); });
    });
}

}  // namespace patchlight
