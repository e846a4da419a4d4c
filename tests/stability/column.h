#pragma once

#include "tests/physics/rooms.h"

#include <string>
#include <vector>

namespace patchlight::stability {

/// A column of the table: an engine and a solver with patches and rays set by hand, or a solve to
/// an accuracy, which chooses both.
struct Column {
    std::string name;
    Way way;
    bool to_accuracy = false;

    bool shoots() const { return !to_accuracy && way.method == Method::shooting; }
    bool casts() const { return !to_accuracy && way.engine == Engine::ray_cast; }
    bool draws() const { return !to_accuracy && way.engine == Engine::hemicube; }
    bool is_analytic() const { return !to_accuracy && way.engine == Engine::analytic; }
    /// Rows are counts of rays or cells.
    bool counts() const { return casts() || draws(); }
};

const std::vector<Column>& every_column();
std::string column_name(const testing::TestParamInfo<Column>& info);

/// What is set by hand; a solve to an accuracy takes none of it.
struct HandSet {
    double patch_size = 0.25;  // [m]
    int rays = 1024;           // per patch, or cells of a hemicube's top face
    double tolerance = 1e-6;
};

constexpr double default_accuracy = 0.02;

SolveSettings settings_for(const Column& column, const HandSet& by_hand = {});
Solution solve(const Scene& scene, const Column& column, const HandSet& by_hand = {},
               std::uint64_t seed = 1);

/// Failure modes that concern every engine and solver.
class EveryColumn : public testing::TestWithParam<Column> {};

#define PATCHLIGHT_EVERY_COLUMN(suite) \
    INSTANTIATE_TEST_SUITE_P(Each, suite, testing::ValuesIn(every_column()), column_name)

}  // namespace patchlight::stability
