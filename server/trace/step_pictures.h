#pragma once

#include "raster/camera.h"
#include "raster/image.h"
#include "solver/settings.h"

#include <optional>
#include <vector>

namespace patchlight::server {

/// A step of a solver as it is shown: what is displayed so far, linear light.
struct StepPicture {
    int step = 0;  // shots or sweeps done
    raster::Image picture;
    std::optional<raster::Image> without_ambient;  // where shooting adds ambient light
};

/// Takes pictures while a solver works, after steps 1, 2, 3, 5, 10, 20, 50, 100, 200, 500 and so
/// on, and keeps them. Changes nothing of the solution.
class StepPictures {
  public:
    explicit StepPictures(const raster::Camera& camera) : camera_(camera) {}

    /// To be told each step of progress.
    void watch(const Progress& progress);

    const std::vector<StepPicture>& taken() const { return taken_; }

  private:
    raster::Camera camera_;
    std::vector<StepPicture> taken_;
    int next_ = 1;  // step to be shown, or the first one after it
};

/// The first of 1, 2, 3, 5, 10, 20, 50, 100 … above `step`.
int shown_step_after(int step);

}  // namespace patchlight::server
