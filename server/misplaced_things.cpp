#include "server/misplaced_things.h"

#include <vector>

namespace patchlight::server {

Misplaced find_misplaced(const Job& job) {
    std::vector<Viewpoint> viewpoints;
    for (const NamedCamera& camera : job.cameras)
        if (!camera.is_made) viewpoints.push_back({camera.name, camera.camera.eye});
    return patchlight::find_misplaced(job.scene, viewpoints, job.settings.seed);
}

}  // namespace patchlight::server
