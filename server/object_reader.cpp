#include "server/object_reader.h"

#include "server/geometry_json.h"
#include "server/materials_json.h"
#include "server/transform_json.h"

namespace patchlight::server {
namespace {

void require_one_content(const JsonValue& body) {
    std::string found;
    for (const char* content : {"polygon", "mesh", "children", "file", "instance"}) {
        if (!body.has(content)) continue;
        if (!found.empty())
            body.reject("has both '" + found + "' and '" + content +
                        "'; an object carries exactly one");
        found = content;
    }
    if (found.empty())
        body.reject("needs one of 'polygon', 'mesh', 'children', 'file', 'instance'");
    if (const auto holes = body.find("holes"); holes && found != "polygon")
        holes->reject("stands beside 'polygon' alone");
}

}  // namespace

void ObjectReader::read_object(const JsonValue& object, std::size_t k, const Heritage& parent) {
    object.require_object({"name", "material", "polygon", "holes", "mesh", "file", "instance",
                           "children", "flux", "translation", "rotation", "scale", "matrix"});
    Heritage own = parent;
    if (!own.path.empty()) own.path += '/';
    const auto name = object.find("name");
    own.path += name ? name->name() : name_of_unnamed(k);
    constexpr std::size_t longest = 2048;
    if (own.path.size() > longest) object.reject("its path has more than 2048 bytes");
    paths_.claim(own.path, name ? *name : object);
    read_body(object, std::move(own));
}

void ObjectReader::read_body(const JsonValue& body, Heritage own) {
    require_one_content(body);
    if (const auto material = body.find("material"))
        own.material = find_material(sources_.declared, *material);
    own.to_scene = own.to_scene * read_transform(body);
    const auto first = static_cast<SurfaceIndex>(scene_.surfaces.size());
    const std::size_t faults_before = faults_.size();
    read_content(body, own);
    const auto flux = body.find("flux");
    const bool is_complete = faults_.size() == faults_before && instancing_ == Instancing::place;
    if (flux && is_complete) sources_.lamps.ask(*flux, own.path, first);
}

void ObjectReader::read_children(const JsonValue& list, const Heritage& parent) {
    if (list.size() == 0) list.reject("must have at least one object");
    for (std::size_t k = 0; k < list.size(); ++k)
        faults_.attempt([&] { read_object(list[k], k, parent); });
}

void ObjectReader::read_content(const JsonValue& body, const Heritage& own) {
    if (const auto children = body.find("children")) return read_children(*children, own);
    if (const auto file = body.find("file")) return sources_.files.add(*file, own, paths_);
    if (const auto instance = body.find("instance")) return read_instance(*instance, own);
    read_shape(body, own);
}

void ObjectReader::read_instance(const JsonValue& instance, const Heritage& own) {
    const JsonValue definition = sources_.definitions.body(instance);
    if (instancing_ == Instancing::check) return;
    used_definitions_.insert(instance.text());
    read_definition(definition, own);
}

void ObjectReader::read_definition(const JsonValue& body, const Heritage& own) {
    body.require_object({"material", "polygon", "holes", "mesh", "file", "instance", "children",
                         "flux", "translation", "rotation", "scale", "matrix"});
    read_body(body, own);
}

void ObjectReader::read_shape(const JsonValue& body, const Heritage& own) {
    if (!own.material) body.reject("needs a 'material', of its own or from an object above it");
    const Placement placement{static_cast<ObjectIndex>(scene_.objects.size()), *own.material,
                              own.to_scene};
    scene_.objects.push_back({own.path});
    if (body.has("polygon")) read_polygon(body, placement, scene_);
    if (const auto mesh = body.find("mesh")) read_mesh(*mesh, placement, scene_);
}

}  // namespace patchlight::server
