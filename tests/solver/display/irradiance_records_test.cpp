#include "solver/display/irradiance_records.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace patchlight::irradiance_records_test {
namespace {

/// A square of 1 m cut into n by n cells.
std::vector<FacingPlace> square(int n) {
    std::vector<FacingPlace> places;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            places.push_back({Vec3((i + 0.5) / n, (j + 0.5) / n, 0.0), Vec3::UnitZ(), 1.0 / n / n});
    return places;
}

/// Half a ball of radius 1 m.
std::vector<FacingPlace> dome(int n) {
    std::vector<FacingPlace> places;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < 4 * n; ++i) {
            const double z = (j + 0.5) / n, turn = std::numbers::pi * (i + 0.5) / (2 * n),
                         r = std::sqrt(1.0 - z * z);
            const Vec3 p(r * std::cos(turn), r * std::sin(turn), z);
            places.push_back({p, p, 2.0 * std::numbers::pi / (4 * n * n)});
        }
    return places;
}

/// Records of light E(position, normal), with noise.
template <typename Light>
IrradianceRecords::Gather gatherer(const std::vector<FacingPlace>& places, const Light& light,
                                   double noise = 0.0) {
    return [&places, light, noise](std::span<const std::uint32_t> wanted) {
        std::vector<IrradianceRecord> records;
        for (const std::uint32_t k : wanted) {
            constexpr double step = 1e-4;
            const auto& [p, normal, area] = places[k];
            std::mt19937 random(k);
            std::normal_distribution<double> chance(0.0, 1.0);
            IrradianceRecord record{p, normal};
            record.irradiance = Rgb::Constant(light(p, normal) + noise * chance(random));
            record.axis[0] = normal.unitOrthogonal();
            record.axis[1] = normal.cross(record.axis[0]);
            for (std::size_t a = 0; a < 2; ++a)
                record.by_tilt[a] = Rgb::Constant(
                    (light(p, (normal + step * record.axis[a]).normalized()) - light(p, normal)) /
                    step);
            record.variance = noise * noise;
            record.known = true;
            records.push_back(record);
        }
        return records;
    };
}

struct Lit {
    double worst = 0.0, mean_square = 0.0;
    std::size_t records = 0;
};

template <typename Light>
Lit light_up(
    const std::vector<FacingPlace>& places, const Light& light, double may_miss, double noise = 0.0,
    const IrradianceRecords::Sees& sees = [](auto, auto) { return true; }) {
    const std::vector<double> reflectance(places.size(), 1.0);
    const IrradianceRecords::Gather gather = gatherer(places, light, noise);
    const IrradianceRecords records(places, {may_miss, 100, reflectance}, gather, sees);
    EXPECT_TRUE(records.complete());
    Lit lit{0.0, 0.0, records.size()};
    for (std::uint32_t k = 0; k < places.size(); ++k) {
        const IrradianceRecords::Value value = records.at(k, places[k].normal);
        EXPECT_TRUE(value.known);
        const double off = value.irradiance[0] - light(places[k].position, places[k].normal);
        lit.worst = std::max(lit.worst, std::abs(off));
        lit.mean_square += off * off / static_cast<double>(places.size());
    }
    return lit;
}

TEST(IrradianceRecords, OfSmoothLightAreFewAndMissLittle) {
    const auto light = [](const Vec3& p, const Vec3&) {
        return 2.0 + std::sin(3.0 * p.x()) * std::cos(2.0 * p.y());
    };
    const Lit lit = light_up(square(150), light, 0.01);
    EXPECT_LT(lit.records, 150u * 150u / 20u);
    EXPECT_LT(std::sqrt(lit.mean_square), 0.01);
    EXPECT_LT(lit.worst, 0.05);
}

TEST(IrradianceRecords, FollowTheFacingOfACurvedSurface) {
    // A sky from above, and light that is alike all round.
    const auto light = [](const Vec3&, const Vec3& normal) {
        return 1.0 + 0.5 * (1.0 + normal.z());
    };
    const Lit lit = light_up(dome(60), light, 0.02);
    EXPECT_LT(lit.records, 60u * 240u / 20u);
    EXPECT_LT(std::sqrt(lit.mean_square), 0.02);
}

TEST(IrradianceRecords, AreCloserWhereLightVaries) {
    const auto light = [](const Vec3& p, const Vec3&) {
        const double square = (p - Vec3(0.3, 0.6, 0.0)).squaredNorm();
        return 1.0 + 5.0 * std::exp(-square / (2.0 * 0.03 * 0.03));
    };
    const Lit lit = light_up(square(150), light, 0.02);
    EXPECT_LT(lit.records, 150u * 150u / 4u);
    EXPECT_LT(std::sqrt(lit.mean_square), 0.03);
}

TEST(IrradianceRecords, NeverReachThroughAWall) {
    const std::vector<FacingPlace> places = square(120);
    const auto is_left = [](const Vec3& p) { return p.x() < 0.37; };
    const auto light = [&](const Vec3& p, const Vec3&) { return is_left(p) ? 10.0 : 1e-3; };
    const Lit lit = light_up(places, light, 0.02, 0.0, [&](std::uint32_t a, std::uint32_t b) {
        return is_left(places[a].position) == is_left(places[b].position);
    });
    EXPECT_LT(lit.worst, 1e-6);
    EXPECT_LT(lit.records, places.size() / 4);
}

TEST(IrradianceRecords, EvenOutNoiseAndAreNotDrivenByIt) {
    constexpr double noise = 0.1;
    const auto light = [](const Vec3& p, const Vec3&) { return 2.0 + p.x(); };
    const Lit lit = light_up(square(150), light, 0.02, noise);
    EXPECT_LT(lit.records, 150u * 150u / 3u);
    EXPECT_LT(std::sqrt(lit.mean_square), 0.8 * noise);
}

TEST(IrradianceRecords, TellWhenTheWorkWasStopped) {
    const std::vector<FacingPlace> places = square(40);
    const std::vector<double> reflectance(places.size(), 1.0);
    const IrradianceRecords::Gather none = [](std::span<const std::uint32_t> wanted) {
        return std::vector<IrradianceRecord>(wanted.size());
    };
    const IrradianceRecords::Sees sees = [](auto, auto) { return true; };
    EXPECT_FALSE(IrradianceRecords(places, {0.01, 100, reflectance}, none, sees).complete());
}

}  // namespace
}  // namespace patchlight::irradiance_records_test
