#include "server/trace/step_pictures.h"

#include "server/picture.h"

#include <utility>

namespace patchlight::server {
namespace {

raster::Image picture_of(DisplayMesh display, const raster::Camera& camera) {
    Solution shown;
    shown.display = std::move(display);
    return take_picture(shown, camera);
}

}  // namespace

int shown_step_after(int step) {
    if (step == 2) return 3;
    for (int decade = 1;; decade *= 10)
        for (const int digit : {1, 2, 5})
            if (digit * decade > step) return digit * decade;
}

void StepPictures::watch(const Progress& progress) {
    if (progress.stage != Stage::solve || !progress.picture || progress.iteration < next_) return;
    next_ = shown_step_after(progress.iteration);
    StepPicture step;
    step.step = progress.iteration;
    step.picture = picture_of((*progress.picture)(), camera_);
    if (progress.picture_without_ambient)
        step.without_ambient = picture_of((*progress.picture_without_ambient)(), camera_);
    taken_.push_back(std::move(step));
}

}  // namespace patchlight::server
