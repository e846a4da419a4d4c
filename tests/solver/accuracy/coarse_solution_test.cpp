#include "solver/accuracy/coarse_solution.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patchlight::coarse_solution_test {
namespace {

constexpr double rho = 0.5;  // of all walls
constexpr double rounding = 1e-12;

/// As inside a sphere: every point sees all others alike, F = A / sum of all areas.
class SphereTransport final : public CoarseTransport {
  public:
    explicit SphereTransport(const PatchMesh& mesh, bool has_matrix = true)
        : has_matrix_(has_matrix) {
        for (const Patch& patch : mesh.patches) area_.push_back(patch.area);
    }
    Transported solve(const Field& exitance, double, const Observe&) const override {
        Transported result;
        for (const auto& given : exitance) {
            // The mean of B = E + rho <B> is <E> / (1 - rho).
            const double mean = mean_of(given) / (1.0 - rho);
            std::vector<double> radiosity;
            for (const double e : given) radiosity.push_back(e + rho * mean);
            result.radiosity.push_back(radiosity);
            result.irradiance.emplace_back(given.size(), mean);
        }
        return result;
    }
    bool has_matrix() const override { return has_matrix_; }
    bool is_exact() const override { return has_matrix_; }
    std::optional<Field> once(const Field& radiosity) const override {
        if (!has_matrix_) return std::nullopt;
        Field arriving;
        for (const auto& values : radiosity) arriving.emplace_back(values.size(), mean_of(values));
        return arriving;
    }

  private:
    double mean_of(const std::vector<double>& values) const {
        double sum = 0.0, all = 0.0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            sum += area_[i] * values[i];
            all += area_[i];
        }
        return sum / all;
    }
    std::vector<double> area_;
    bool has_matrix_;
};

struct Walls {
    CutScene pieces = cut(room(), 0.5);
    std::size_t count = pieces.mesh.size();
    SphereTransport transport;
    CoarseSolution coarse;

    explicit Walls(bool has_matrix = true)
        : transport(pieces.mesh, has_matrix),
          coarse(pieces.scene, pieces.mesh, transport,
                 std::vector<Rgb>(pieces.mesh.size(), Rgb::Zero())) {
        coarse.solve(std::vector<Rgb>(count, Rgb::Constant(2.0)), 1e-9, {});
    }
};

TEST(CoarseSolution, SendsDirectLightBackAndRound) {
    const Walls walls;
    const double exact = rho * 2.0 / (1.0 - rho);
    for (const Rgb& reflected : walls.coarse.reflected())
        EXPECT_NEAR(reflected[1], exact, rounding);
    for (const Rgb& irradiance : walls.coarse.irradiance())
        EXPECT_NEAR(irradiance[1], exact, rounding);
    EXPECT_NEAR(walls.coarse.norm(), exact * std::sqrt(6.0), rounding) << "of six square metres";
}

TEST(CoarseSolution, SendsAChangeOnSoThatTheSolutionIsThatOfBoth) {
    const Walls walls;
    constexpr double change = 0.1;
    const CoarseSolution::Correction correction =
        walls.coarse.correct(std::vector<Rgb>(walls.count, Rgb::Constant(change)), 1e-9);
    for (const Rgb& more : correction.irradiance)
        EXPECT_NEAR(more[0], change / (1.0 - rho), rounding);
    const double reflected = rho * change / (1.0 - rho);
    EXPECT_NEAR(correction.size, reflected / (rho * 2.0 / (1.0 - rho)), rounding);
}

TEST(CoarseSolution, WithoutAMatrixTellsHowMuchChangedAlone) {
    const Walls walls(false);
    const CoarseSolution::Correction correction =
        walls.coarse.correct(std::vector<Rgb>(walls.count, Rgb::Constant(0.1)), 1e-9);
    for (const Rgb& more : correction.irradiance) EXPECT_EQ(more[0], 0.0);
    EXPECT_NEAR(correction.size, 0.1 / 2.0, rounding);
}

}  // namespace
}  // namespace patchlight::coarse_solution_test
