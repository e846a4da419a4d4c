#include "solver/foretell_time.h"

#include "solver/scene/input_error.h"
#include "solver/solve_scene.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

namespace patchlight::foretell_time_test {
namespace {

TEST(ForetellSeconds, IsNoMoreThanTheLimitThatIsSet) {
    SolveSettings settings;
    settings.accuracy = 1e-4;
    settings.time_limit = 0.05;
    const double seconds = foretell_seconds(room_with_box(), settings);
    EXPECT_GT(seconds, 0.0);
    EXPECT_LE(seconds, 0.05);
}

TEST(ForetellSeconds, IsMoreThanWasTriedWhereTheAccuracyIsFarFromReached) {
    SolveSettings settings;
    settings.accuracy = 2e-5;
    EXPECT_GT(foretell_seconds(room_with_box(), settings), 4.0);
}

TEST(ForetellSeconds, RefusesWhatASolveRefuses) {
    SolveSettings settings;
    settings.patch_size = 0.5;
    settings.memory_limit = 1;
    EXPECT_THROW(foretell_seconds(room_with_box(), settings), InputError);
}

}  // namespace
}  // namespace patchlight::foretell_time_test
