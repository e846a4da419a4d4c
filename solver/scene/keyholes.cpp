#include "solver/scene/keyholes.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace patchlight {

namespace {

/// Takes out corners at which an edge turns back on itself.
void remove_spikes(std::vector<Vec3>& ring, double same_point) {
    for (std::size_t k = 0; k < ring.size() && ring.size() > 2;) {
        const std::size_t n = ring.size();
        const Vec3 &before = ring[(k + n - 1) % n], &after = ring[(k + 1) % n];
        if ((before - after).norm() > same_point) {
            ++k;
            continue;
        }
        const std::size_t next = (k + 1) % n;  // the point that both neighbours are
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(std::max(k, next)));
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(std::min(k, next)));
        k = 0;
    }
}

/// Parts the ring at the first bridge, if it has one: what lies behind it is returned.
std::optional<std::vector<Vec3>> part_at_bridge(std::vector<Vec3>& ring, double same_point) {
    const auto same = [&](std::size_t a, std::size_t b) {
        return (ring[a] - ring[b]).norm() <= same_point;
    };
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i + 1 < n; ++i)
        for (std::size_t j = i + 4; j < n; ++j) {  // three corners lie between
            if (!same(i + 1, j) || !same(i, (j + 1) % n)) continue;
            std::vector<Vec3> behind(ring.begin() + static_cast<std::ptrdiff_t>(i + 1),
                                     ring.begin() + static_cast<std::ptrdiff_t>(j));
            std::vector<Vec3> rest(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(i + 1));
            for (std::size_t k = j + 2; k < n; ++k) rest.push_back(ring[k]);
            if (j + 1 == n) rest.erase(rest.begin());  // the end of the bridge is the first corner
            ring = std::move(rest);
            return behind;
        }
    return std::nullopt;
}

}  // namespace

Rings<Vec3> without_bridges(std::span<const Vec3> corners, double same_point) {
    Rings<Vec3> whole;
    Rings<Vec3> left{{corners.begin(), corners.end()}};
    while (!left.empty()) {
        std::vector<Vec3> ring = std::move(left.back());
        left.pop_back();
        bool is_parted = false;
        while (auto behind = part_at_bridge(ring, same_point)) {
            left.push_back(std::move(*behind));
            remove_spikes(ring, same_point);
            is_parted = true;
        }
        if (is_parted || !whole.empty()) remove_spikes(ring, same_point);
        if (ring.size() >= 3) whole.push_back(std::move(ring));
    }
    const auto larger = [](const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
        return vector_area(a).norm() < vector_area(b).norm();
    };
    if (whole.size() > 1)
        std::iter_swap(whole.begin(), std::max_element(whole.begin(), whole.end(), larger));
    return whole;
}

}  // namespace patchlight
