#include "server/trace/step_pictures.h"

#include "solver/solution.h"

#include <gtest/gtest.h>

#include <vector>

namespace patchlight::server::step_pictures_test {
namespace {

TEST(StepPictures, StepsAreShownInOneTwoFive) {
    std::vector<int> shown;
    for (int step = shown_step_after(0); step <= 5000; step = shown_step_after(step))
        shown.push_back(step);
    EXPECT_EQ(shown, (std::vector<int>{1, 2, 3, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000}));
}

TEST(StepPictures, StepsThatAreNotToBeShownCostNoPicture) {
    raster::Camera camera;
    camera.width = camera.height = 8;
    StepPictures pictures(camera);
    int made = 0;
    const std::function<DisplayMesh()> picture = [&] {
        ++made;
        return DisplayMesh();
    };
    for (const int step : {1, 2, 3, 4, 7, 8, 9, 12}) {
        Progress progress{Stage::solve, 0.0, step, 0.5};
        progress.picture = &picture;
        pictures.watch(progress);
    }
    pictures.watch({Stage::solve, 0.0, 100, 0.5});  // without a picture
    std::vector<int> taken;
    for (const StepPicture& step : pictures.taken()) taken.push_back(step.step);
    EXPECT_EQ(taken, (std::vector<int>{1, 2, 3, 7, 12}));
    EXPECT_EQ(made, 5);
    EXPECT_FALSE(pictures.taken().front().without_ambient.has_value());
}

}  // namespace
}  // namespace patchlight::server::step_pictures_test
