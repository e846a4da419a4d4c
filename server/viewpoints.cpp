#include "server/viewpoints.h"

namespace patchlight::server {

std::vector<Viewpoint> viewpoints(const Job& job) {
    std::vector<Viewpoint> found;
    for (const NamedCamera& camera : job.cameras)
        if (!camera.is_made) found.push_back({camera.name, camera.camera.eye});
    return found;
}

}  // namespace patchlight::server
