#include "solver/display/near_places.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>
#include <utility>

namespace patchlight {

NearPlaces::NearPlaces(std::vector<Vec3> places)
    : places_(std::move(places)), order_(places_.size()), axis_(places_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    sort(0, order_.size());
}

void NearPlaces::sort(std::size_t first, std::size_t end) {
    if (end - first < 2) return;
    Eigen::AlignedBox3d box;
    for (std::size_t k = first; k < end; ++k) box.extend(places_[order_[k]]);
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    const std::size_t middle = first + (end - first) / 2;
    const auto at = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(first), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
        return places_[a][axis] != places_[b][axis] ? places_[a][axis] < places_[b][axis] : a < b;
    });
    axis_[middle] = static_cast<std::uint8_t>(axis);
    sort(first, middle);
    sort(middle + 1, end);
}

struct NearPlaces::Search {
    const Vec3& p;
    double square;  // of what is still of interest [m²]
    std::size_t most;
    const std::function<bool(std::uint32_t)>& fits;
    std::vector<std::pair<double, std::uint32_t>> found{};  // a heap, the farthest on top

    void offer(double distance, std::uint32_t place) {
        if (distance > square || !fits(place)) return;
        found.emplace_back(distance, place);
        std::push_heap(found.begin(), found.end());
        if (found.size() > most) {
            std::pop_heap(found.begin(), found.end());
            found.pop_back();
        }
        if (found.size() == most) square = found.front().first;
    }
};

void NearPlaces::look(std::size_t first, std::size_t end, Search& search) const {
    if (first >= end) return;
    const std::size_t middle = first + (end - first) / 2;
    const Vec3& place = places_[order_[middle]];
    search.offer((place - search.p).squaredNorm(), order_[middle]);
    if (end - first < 2) return;
    const double beyond = search.p[axis_[middle]] - place[axis_[middle]];
    const bool is_before = beyond < 0.0;
    is_before ? look(first, middle, search) : look(middle + 1, end, search);
    if (beyond * beyond > search.square) return;
    is_before ? look(middle + 1, end, search) : look(first, middle, search);
}

std::vector<std::uint32_t> NearPlaces::nearest(
    const Vec3& p, double reach, std::size_t most,
    const std::function<bool(std::uint32_t)>& fits) const {
    Search search{p, reach * reach, most, fits};
    look(0, order_.size(), search);
    std::sort_heap(search.found.begin(), search.found.end());
    std::vector<std::uint32_t> numbers;
    for (const auto& [distance, place] : search.found) numbers.push_back(place);
    return numbers;
}

}  // namespace patchlight
