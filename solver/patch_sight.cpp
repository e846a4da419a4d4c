#include "solver/patch_sight.h"

#include "solver/make_engine.h"
#include "solver/mesh/make_patches.h"
#include "solver/transport/row_source.h"

namespace patchlight {

PatchSight look_from_patch(const Scene& scene, const PatchMesh& mesh, const SolveSettings& planned,
                           PatchIndex i, int resolution) {
    const RayScene rays(scene, find_mesh_lines(scene).overlaps);
    const auto engine = make_engine(scene, mesh, rays, planned, [] { return true; });
    PatchSight sight;
    sight.patch = i;
    sight.factors.assign(mesh.size(), 0.0);
    sight.hemicube_factors.assign(mesh.size(), 0.0);
    RowSource rows(*engine, mesh.size(), 0);
    const PatchIndex wanted[] = {i};
    const ClosedRow& row = *rows.fetch(wanted).front();
    for (std::size_t k = 0; k < row.columns.size(); ++k)
        sight.factors[row.columns[k]] = static_cast<double>(row.factors[k]);
    sight.backs = row.outside.backs;
    sight.escaped = row.outside.escaped;
    sight.faces = hemicube_faces(scene, mesh, rays, i, resolution);
    for (const HemicubeFace& face : sight.faces)
        for (std::size_t cell = 0; cell < face.seen.size(); ++cell)
            if (face.seen[cell] < mesh.size())
                sight.hemicube_factors[face.seen[cell]] += face.delta_factors[cell];
    return sight;
}

PatchIndex brightest_emitter(const Scene& scene, const PatchMesh& mesh) {
    PatchIndex best = 0;
    double most = -1.0;
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        const Patch& patch = mesh.patches[i];
        if (patch.covered) continue;
        const Material& material = scene.materials[scene.surfaces[patch.surface].material];
        const double power = luminance(material.exitance) * patch.area;
        if (power > most) {
            most = power;
            best = i;
        }
    }
    return best;
}

}  // namespace patchlight
