#pragma once

#include "solver/scene/light.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace patchlight {

/// Finds the nearest of some places, by a k-d tree (Bentley 1975).
class NearPlaces {
  public:
    explicit NearPlaces(std::vector<Vec3> places);

    /// Numbers of the `most` nearest places within `reach` of p that `fits`, nearest first.
    std::vector<std::uint32_t> nearest(const Vec3& p, double reach, std::size_t most,
                                       const std::function<bool(std::uint32_t)>& fits) const;

  private:
    struct Search;
    void sort(std::size_t first, std::size_t end);
    void look(std::size_t first, std::size_t end, Search& search) const;

    std::vector<Vec3> places_;          // [m]
    std::vector<std::uint32_t> order_;  // the middle of each range divides it
    std::vector<std::uint8_t> axis_;    // along which, as `order_`
};

}  // namespace patchlight
