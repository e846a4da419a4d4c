#include "solver/display/irradiance_records.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace patchlight {

namespace {

constexpr double by_halving = 0.25;  // of the square of what is missed, by each halving
constexpr double often_by_chance =
    1.0;  // of the mean noise, that the square of it often goes beyond [1]
constexpr double often_by_chance_of_many = 0.5;
constexpr std::size_t most_near = 12;      // records that one value is made of
constexpr double reach_of_part = 4.0;      // of a part's radius: records within it count
constexpr double least_cosine = 0.7;       // between normals
constexpr double steepest = 0.3;           // off the plane, over the distance
constexpr double ridge = 1e-3;             // of the weights: of places that lie in a row
constexpr double most_extrapolated = 3.0;  // sum of the weights' sizes [1]
constexpr double far_weight = 1e-4;        // of the farthest record's weight

}  // namespace

/// Records round a place, and the plane that fits best to them.
struct IrradianceRecords::Plane {
    std::size_t size = 0;
    std::array<std::uint32_t, most_near> record{};
    std::array<double, most_near> weight{}, x{}, y{};  // places over the farthest one's distance
    double sum = 0.0;                                  // of weights
    Eigen::LDLT<Eigen::Matrix3d> squares{};

    Eigen::Vector3d basis(std::size_t k) const { return {1.0, x[k], y[k]}; }
    /// What each counts in the value at the place itself; the sum of their sizes.
    double shares(std::array<double, most_near>& share) const {
        const Eigen::Vector3d at = squares.solve(Eigen::Vector3d::UnitX());
        double size_of_all = 0.0;
        for (std::size_t k = 0; k < size; ++k) {
            share[k] = weight[k] * at.dot(basis(k));
            size_of_all += std::abs(share[k]);
        }
        return size_of_all;
    }
};

Rgb IrradianceRecord::on(const Vec3& facing) const {
    return irradiance + facing.dot(axis[0]) * by_tilt[0] + facing.dot(axis[1]) * by_tilt[1];
}

IrradianceRecords::IrradianceRecords(std::span<const FacingPlace> places, const Rule& rule,
                                     const Gather& gather, const Sees& sees)
    : places_(places),
      rule_(rule),
      gather_(gather),
      sees_(sees),
      cutter_(places),
      part_of_(places.size()) {
    begin(rule.fewest);
    for (bool any = complete_; any;) {
        any = halve() && complete_;
        judge();
    }
    for (std::uint32_t p = 0; p < parts_.size(); ++p)
        for (const std::uint32_t k : cutter_.places(parts_[p].places)) part_of_[k] = p;
}

std::uint32_t IrradianceRecords::middle_of(const AlikeParts::Part& part) {
    Vec3 mean = Vec3::Zero();
    const std::span<const std::uint32_t> members = cutter_.places(part);
    for (const std::uint32_t k : members) mean += places_[k].position;
    mean /= static_cast<double>(members.size());
    return *std::ranges::min_element(
        members, {}, [&](std::uint32_t k) { return (places_[k].position - mean).squaredNorm(); });
}

/// How far its places are from the record's, and whether that sees all of them.
void IrradianceRecords::look_over(Part& part) {
    const std::uint32_t middle = place_of_[part.record];
    double square = 0.0;
    part.apart = false;
    for (const std::uint32_t k : cutter_.places(part.places)) {
        square = std::max(square, (places_[k].position - places_[middle].position).squaredNorm());
        part.apart = part.apart || (k != middle && !sees_(middle, k));
    }
    part.radius = std::sqrt(square);
}

/// Records in the middle of each of so many parts.
void IrradianceRecords::begin(std::size_t parts) {
    std::vector<std::uint32_t> wanted;
    for (const AlikeParts::Part& part : cutter_.cut(parts)) {
        parts_.push_back({part, static_cast<std::uint32_t>(wanted.size())});
        wanted.push_back(middle_of(part));
    }
    records_ = gather_(wanted);
    place_of_ = wanted;
    tbb::parallel_for(std::size_t{0}, parts_.size(), [&](std::size_t p) { look_over(parts_[p]); });
    complete_ = std::ranges::all_of(records_, &IrradianceRecord::known);
}

/// Halves the parts in which too much is missed; what was expected at the new records tells
/// whether it is in their halves. False if there was none.
bool IrradianceRecords::halve() {
    std::vector<std::uint32_t> wanted;
    std::vector<std::array<std::size_t, 2>> halves;  // numbers; the second has a new record
    std::vector<double> radius;                      // of both together
    const std::size_t parts = parts_.size();
    for (std::size_t p = 0; p < parts; ++p) {
        Part& part = parts_[p];
        if (part.settled || part.alone()) continue;
        std::array<AlikeParts::Part, 2> cut = cutter_.halves(part.places);
        const std::uint32_t old_place = place_of_[part.record];
        const auto first = cutter_.places(cut[0]);
        if (std::ranges::find(first, old_place) == first.end()) std::swap(cut[0], cut[1]);
        radius.push_back(part.radius);
        part.places = cut[0];
        halves.push_back({p, parts_.size()});
        const auto fresh = static_cast<std::uint32_t>(records_.size() + wanted.size());
        wanted.push_back(middle_of(cut[1]));
        parts_.push_back({cut[1], fresh});
    }
    if (wanted.empty()) return false;
    const NearPlaces near = places_of_records();
    const std::vector<IrradianceRecord> fresh = gather_together(wanted);
    std::vector<char> misses(wanted.size());
    tbb::parallel_for(std::size_t{0}, wanted.size(), [&](std::size_t n) {
        const FacingPlace& place = places_[wanted[n]];
        misses[n] =
            fresh[n].known &&
            is_missed(fresh[n], wanted[n],
                      plane(seen_from(wanted[n], records_near(near, place, radius[n])), place));
    });
    records_.insert(records_.end(), fresh.begin(), fresh.end());
    place_of_.insert(place_of_.end(), wanted.begin(), wanted.end());
    complete_ = complete_ && std::ranges::all_of(fresh, &IrradianceRecord::known);
    tbb::parallel_for(std::size_t{0}, wanted.size(), [&](std::size_t n) {
        for (const std::size_t p : halves[n]) {
            look_over(parts_[p]);
            parts_[p].settled = !misses[n] && !parts_[p].apart;
        }
    });
    return true;
}

/// In an order in which neighbours come together, so that their rays meet what is in the cache.
std::vector<IrradianceRecord> IrradianceRecords::gather_together(
    std::span<const std::uint32_t> wanted) const {
    std::vector<std::uint32_t> rank(places_.size()), order(wanted.size()), sorted;
    for (std::uint32_t k = 0; k < places_.size(); ++k) rank[cutter_.order()[k]] = k;
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {}, [&](std::uint32_t n) { return rank[wanted[n]]; });
    for (const std::uint32_t n : order) sorted.push_back(wanted[n]);
    const std::vector<IrradianceRecord> found = gather_(sorted);
    std::vector<IrradianceRecord> records(wanted.size());
    for (std::size_t k = 0; k < order.size(); ++k) records[order[k]] = found[k];
    return records;
}

/// Lists the records each part is lit by. Those that fit no plane tell that there is more between.
void IrradianceRecords::judge() {
    const NearPlaces near = places_of_records();
    near_.resize(parts_.size());
    seen_.resize(parts_.size());
    tbb::parallel_for(std::size_t{0}, parts_.size(), [&](std::size_t p) {
        Part& part = parts_[p];
        if (part.alone()) return;
        const std::uint32_t middle = place_of_[part.record];
        std::vector<std::uint32_t> now = records_near(near, places_[middle], part.radius);
        if (now == near_[p]) return;
        near_[p] = std::move(now);
        seen_[p] = seen_from(middle, near_[p]);
        if (is_rough(middle, plane(seen_[p], places_[middle]))) part.settled = false;
    });
}

std::vector<std::uint32_t> IrradianceRecords::seen_from(std::uint32_t place,
                                                        std::vector<std::uint32_t> records) const {
    std::erase_if(records, [&](std::uint32_t r) {
        return place_of_[r] != place && !sees_(place, place_of_[r]);
    });
    return records;
}

NearPlaces IrradianceRecords::places_of_records() const {
    std::vector<Vec3> places;
    for (const std::uint32_t k : place_of_) places.push_back(places_[k].position);
    return NearPlaces(std::move(places));
}

std::vector<std::uint32_t> IrradianceRecords::records_near(const NearPlaces& near,
                                                           const FacingPlace& place,
                                                           double radius) const {
    return near.nearest(place.position, reach_of_part * radius, most_near, [&](std::uint32_t r) {
        return records_[r].known && records_[r].normal.dot(place.normal) >= least_cosine;
    });
}

bool IrradianceRecords::is_missed(const IrradianceRecord& found, std::uint32_t place,
                                  const Plane& around) const {
    const Value expected = fit(around, found.normal);
    const double miss =
                     rule_.reflectance[place] * luminance(found.irradiance - expected.irradiance),
                 noise = found.variance + expected.variance;
    return !expected.known || miss * miss - noise > std::max(allowed(), often_by_chance * noise);
}

bool IrradianceRecords::is_rough(std::uint32_t place, const Plane& around) const {
    const Roughness rough = roughness(around, places_[place].normal);
    return std::pow(rule_.reflectance[place], 2) * rough.square - rough.noise >
           std::max(allowed(), often_by_chance_of_many * rough.noise);
}

double IrradianceRecords::allowed() const { return rule_.may_miss * rule_.may_miss / by_halving; }

IrradianceRecords::Plane IrradianceRecords::plane(std::span<const std::uint32_t> records,
                                                  const FacingPlace& place) const {
    Plane plane;
    const Vec3 u = place.normal.unitOrthogonal(), v = place.normal.cross(u);
    double farthest = 1e-300;
    for (const std::uint32_t r : records) {
        const Vec3 way = records_[r].position - place.position;
        const double distance = way.norm();
        if (!records_[r].known || std::abs(way.dot(place.normal)) > steepest * distance) continue;
        const std::size_t k = plane.size++;
        plane.record[k] = r;
        plane.x[k] = way.dot(u), plane.y[k] = way.dot(v), plane.weight[k] = distance;
        farthest = std::max(farthest, distance);
    }
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    for (std::size_t k = 0; k < plane.size; ++k) {
        plane.weight[k] = std::pow(1.0 - std::pow(plane.weight[k] / farthest, 2), 2) + far_weight;
        plane.x[k] /= farthest, plane.y[k] /= farthest;
        squares += plane.weight[k] * plane.basis(k) * plane.basis(k).transpose();
        plane.sum += plane.weight[k];
    }
    squares(1, 1) += ridge * plane.sum;
    squares(2, 2) += ridge * plane.sum;
    plane.squares.compute(squares);
    return plane;
}

/// The value there of the plane that fits best to the records, near ones more than far ones.
IrradianceRecords::Value IrradianceRecords::fit(const Plane& plane, const Vec3& facing) const {
    if (plane.size == 0) return {};
    std::array<double, most_near> share{};
    const bool is_sound = plane.shares(share) < most_extrapolated && plane.size > 3;
    Value value{Rgb::Zero(), 0.0, true};
    for (std::size_t k = 0; k < plane.size; ++k) {
        const double part = is_sound ? share[k] : plane.weight[k] / plane.sum;
        const IrradianceRecord& record = records_[plane.record[k]];
        value.irradiance += part * record.on(facing);
        value.variance += part * part * record.variance;
    }
    value.irradiance = value.irradiance.max(0.0);
    return value;
}

/// Square of what the records are off the plane, less what their noise makes of that; luminance.
IrradianceRecords::Roughness IrradianceRecords::roughness(const Plane& plane,
                                                          const Vec3& facing) const {
    constexpr std::size_t unknowns = 3;
    if (plane.size <= unknowns) return {};
    std::array<double, most_near> seen{};
    Eigen::Vector3d moments = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < plane.size; ++k) {
        seen[k] = luminance(records_[plane.record[k]].on(facing));
        moments += plane.weight[k] * seen[k] * plane.basis(k);
    }
    const Eigen::Vector3d fitted = plane.squares.solve(moments);
    Roughness found;
    for (std::size_t k = 0; k < plane.size; ++k) {
        const double off = seen[k] - fitted.dot(plane.basis(k));
        found.square += plane.weight[k] / plane.sum * off * off;
        found.noise += plane.weight[k] / plane.sum * records_[plane.record[k]].variance;
    }
    found.square *= static_cast<double>(plane.size) / static_cast<double>(plane.size - unknowns);
    return found;
}

IrradianceRecords::Value IrradianceRecords::at(std::uint32_t k, const Vec3& facing) const {
    const Part& part = parts_[part_of_[k]];
    if (!part.alone())
        if (const Value value = fit(plane(seen_[part_of_[k]], places_[k]), facing); value.known)
            return value;
    const IrradianceRecord& record = records_[part.record];
    return {record.on(facing).max(0.0), record.variance, record.known};
}

}  // namespace patchlight
