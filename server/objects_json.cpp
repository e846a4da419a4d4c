#include "server/objects_json.h"

#include "server/definitions.h"
#include "server/file_objects.h"
#include "server/material_names.h"
#include "server/object_reader.h"
#include "server/polygon_count.h"

#include <set>
#include <string>
#include <vector>

namespace patchlight::server {
namespace {

using Directory = std::optional<std::filesystem::path>;

/// A definition that no object uses is read all the same, each by itself, as a mistake in it would
/// else show much later.
void check_unused(const std::set<std::string>& used, const Definitions& definitions,
                  const std::vector<Material>& declared, const Directory& directory,
                  FaultList& faults) {
    Scene elsewhere;
    elsewhere.materials = declared;
    MaterialNames names(elsewhere);
    FileObjects files(directory, 1.0, elsewhere, names);
    FluxSpreader lamps(elsewhere, names);
    PolygonCount count(definitions, files);
    Heritage root;
    root.material = names.add({});  // what the object that uses it would bring
    for (const std::string& name : definitions.names()) {
        if (used.contains(name)) continue;
        faults.attempt([&] {
            const JsonValue body = definitions.body(name);
            count.of(body);
            ObjectReader({declared, definitions, files, lamps}, elsewhere, faults,
                         Instancing::check)
                .read_definition(body, root);
        });
    }
}

}  // namespace

GeometryFiles read_objects(const JsonValue& document, double metres, const Directory& directory,
                           Scene& scene, FaultList& faults) {
    const JsonValue list = document.at("objects");
    if (list.size() == 0) list.reject("must have at least one object");
    const Definitions definitions(document);
    MaterialNames names(scene);
    const std::vector<Material> declared = scene.materials;
    FileObjects files(directory, metres, scene, names);
    PolygonCount count(definitions, files);
    FluxSpreader lamps(scene, names);
    const ObjectSources sources{declared, definitions, files, lamps};
    ObjectReader reader(sources, scene, faults);
    Heritage root;
    root.to_scene.linear() *= metres;
    std::size_t polygons = 0;
    for (std::size_t k = 0; k < list.size(); ++k)
        faults.attempt([&] {
            const JsonValue object = list[k];
            polygons += count.of(object);
            if (polygons > PolygonCount::most)
                object.reject("brings the scene to more than " +
                              std::to_string(PolygonCount::most) + " polygons, the limit");
            reader.read_object(object, k, root);
        });
    if (faults.size() == 0) lamps.spread_all(faults);
    check_unused(reader.used_definitions(), definitions, declared, directory, faults);
    if (faults.size() == 0 && scene.surfaces.empty())
        list.reject("no polygon of the scene has an area");
    return {files.files(), files.cameras()};
}

}  // namespace patchlight::server
