#include "tests/server/files/written_files.h"

#include "server/files/geometry_file.h"
#include "server/scene_json.h"
#include "tests/server/run_program.h"

#include <gtest/gtest.h>

namespace patchlight::server {

ImportedGeometry read_written(const std::string& name, const std::string& bytes) {
    write_test_file(name, bytes);
    return read_geometry_file(test_file(name), name);
}

void expect_file_rejected(const std::string& name, const std::string& bytes,
                          const std::string& words) {
    try {
        read_written(name, bytes);
        ADD_FAILURE() << "accepted: " << bytes.substr(0, 300);
    } catch (const InputError& error) {
        const std::string message = error.pointer() + ": " + error.what();
        EXPECT_TRUE(message.starts_with(name)) << message;
        EXPECT_NE(message.find(words), std::string::npos) << message << "\nlacks: " << words;
    }
}

Job read_beside(const std::string& scene) {
    return read_scene_text(scene, {std::filesystem::path(test_file("x")).parent_path()});
}

Job scene_of_file(const std::string& name, const std::string& members, const std::string& blocks) {
    return read_beside(R"({"version": 1, "objects": [{"name": "thing", "file": ")" + name + "\"" +
                       (members.empty() ? "" : ", ") + members + "}]" +
                       (blocks.empty() ? "" : ", ") + blocks + "}");
}

std::vector<Finding> findings_of(const Scene& scene, const std::string& kind) {
    std::vector<Finding> found;
    for (const Finding& finding : scene.findings)
        if (finding.kind == kind) found.push_back(finding);
    return found;
}

}  // namespace patchlight::server
