#include "server/objects_json.h"

#include "server/geometry_json.h"
#include "server/materials_json.h"
#include "server/not_built.h"
#include "server/transform_json.h"
#include "server/unique_names.h"
#include "server/wording.h"

#include <optional>
#include <string>

namespace patchlight::server {
namespace {

/// What an object has from those it is a child of.
struct Heritage {
    std::string path;
    std::optional<MaterialIndex> material;
    Eigen::Affine3d to_scene = Eigen::Affine3d::Identity();
};

class ObjectReader {
  public:
    explicit ObjectReader(Scene& scene) : scene_(scene) {}

    void read_list(const JsonValue& list, const Heritage& parent) {
        if (list.size() == 0) list.reject("must have at least one object");
        for (std::size_t k = 0; k < list.size(); ++k) read_object(list[k], k, parent);
    }

  private:
    void read_object(const JsonValue& object, std::size_t k, const Heritage& parent) {
        object.require_object({"name", "material", "polygon", "mesh", "file", "instance",
                               "children", "flux", "translation", "rotation", "scale", "matrix"});
        require_one_content(object);
        refuse_not_built(object, {"file", "instance", "flux"});
        const Heritage own = heritage(object, k, parent);
        if (const auto children = object.find("children"))
            read_list(*children, own);
        else
            read_geometry(object, own);
    }

    static void require_one_content(const JsonValue& object) {
        std::string found;
        for (const char* content : {"polygon", "mesh", "children", "file", "instance"}) {
            if (!object.has(content)) continue;
            if (!found.empty())
                object.reject("has both '" + found + "' and '" + content +
                              "'; an object carries exactly one");
            found = content;
        }
        if (found.empty()) object.reject("needs one of 'polygon', 'mesh', 'children'");
    }

    Heritage heritage(const JsonValue& object, std::size_t k, const Heritage& parent) {
        Heritage own = parent;
        if (!own.path.empty()) own.path += '/';
        const auto name = object.find("name");
        own.path += name ? name->name() : name_of_unnamed(k);
        names_.claim(own.path, name ? *name : object);
        if (const auto material = object.find("material"))
            own.material = find_material(scene_.materials, *material);
        own.to_scene = parent.to_scene * read_transform(object);
        return own;
    }

    void read_geometry(const JsonValue& object, const Heritage& own) {
        if (!own.material)
            object.reject("needs a 'material', of its own or from an object above it");
        const Placement placement{static_cast<ObjectIndex>(scene_.objects.size()), *own.material,
                                  own.to_scene};
        scene_.objects.push_back({own.path});
        if (const auto polygon = object.find("polygon")) read_polygon(*polygon, placement, scene_);
        if (const auto mesh = object.find("mesh")) read_mesh(*mesh, placement, scene_);
    }

    Scene& scene_;
    UniqueNames names_;
};

}  // namespace

void read_objects(const JsonValue& list, double metres, Scene& scene) {
    Heritage root;
    root.to_scene.linear() *= metres;
    ObjectReader(scene).read_list(list, root);
    if (scene.surfaces.empty()) list.reject("no polygon of the scene has an area");
}

}  // namespace patchlight::server
