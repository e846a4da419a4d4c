#pragma once

#include "server/definitions.h"
#include "server/file_objects.h"
#include "server/flux.h"
#include "server/heritage.h"
#include "server/input_errors.h"
#include "server/json_value.h"
#include "server/unique_names.h"
#include "solver/scene/scene.h"

#include <cstdint>
#include <set>
#include <span>
#include <string>

namespace patchlight::server {

/// What reading the objects of one scene needs beside them.
struct ObjectSources {
    std::span<const Material> declared;  // materials that objects may name
    const Definitions& definitions;
    FileObjects& files;
    FluxSpreader& lamps;
};

/// Whether what instances refer to is put in place, or only known to be there.
enum class Instancing : std::uint8_t { place, check };

/// Puts objects and all that is below them into a scene.
class ObjectReader {
  public:
    ObjectReader(ObjectSources sources, Scene& scene, FaultList& faults,
                 Instancing instancing = Instancing::place)
        : sources_(sources), scene_(scene), faults_(faults), instancing_(instancing) {}

    /// Object number `k` of a list. Throws InputError; what is wrong with its children goes to the
    /// list of faults.
    void read_object(const JsonValue& object, std::size_t k, const Heritage& parent);

    /// The body of a definition: throws in the same way.
    void read_definition(const JsonValue& body, const Heritage& own);

    /// Definitions that were put in place at least once.
    const std::set<std::string>& used_definitions() const { return used_definitions_; }

  private:
    void read_body(const JsonValue& body, Heritage own);
    void read_children(const JsonValue& list, const Heritage& parent);
    void read_content(const JsonValue& body, const Heritage& own);
    void read_instance(const JsonValue& instance, const Heritage& own);
    void read_shape(const JsonValue& body, const Heritage& own);

    ObjectSources sources_;
    Scene& scene_;
    FaultList& faults_;
    Instancing instancing_;
    UniqueNames paths_;
    std::set<std::string> used_definitions_;
};

}  // namespace patchlight::server
