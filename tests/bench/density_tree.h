#pragma once

#include "tests/bench/random.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace patchlight {

using Place = Eigen::Array4d;  // where light starts on a lamp, and to where: four numbers

struct WeightedPlace {
    Place place = Place::Zero();
    double weight = 0.0;
};

/// A density from which places can be drawn, learned from weighted samples: a tree of boxes round
/// ever fewer of them. Some of the mass of every box is spread over all of it, so that a place
/// near samples is never taken for one without light.
class DensityTree {
  public:
    explicit DensityTree(std::span<WeightedPlace> samples);

    Place draw(Random& random) const;
    /// Integrates to 1.
    double density(const Place& place) const;
    /// Mean logarithm of the density at samples, by weight: the larger, the better it tells them.
    double likelihood(std::span<const WeightedPlace> samples) const;

  private:
    struct Node {
        Place low, high;           // box round its samples, a little wider
        double share = 1.0;        // of the mass of its parent
        std::uint32_t second = 0;  // child; the first follows its parent; 0: a leaf
        int axis = 0;
        double border = 0.0;  // between its children
    };
    std::uint32_t grow(std::span<WeightedPlace> samples, const Place& low, const Place& high,
                       int depth);

    std::vector<Node> nodes_;
};

}  // namespace patchlight
