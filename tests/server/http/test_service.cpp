#include "tests/server/http/test_service.h"

#include "server/http/socket_address.h"

namespace patchlight::server {

TestService::TestService(const ServiceSettings& settings) : service_(settings, log_) {
    const Listener listener = listen_on("127.0.0.1", 0);
    port_ = listener.port;
    thread_ = std::thread([this, socket = listener.socket] { service_.run(socket); });
}

TestService::~TestService() {
    service_.cancel();
    service_.stop(std::chrono::seconds(2));
    thread_.join();
}

std::string quick_scene() {
    return R"({"version": 1,
        "materials": {"white": {"reflectance": 0.5}, "lamp": {"reflectance": 0.5, "exitance": 9}},
        "objects": [
            {"name": "floor", "material": "white",
             "polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]]},
            {"name": "lamp", "material": "lamp",
             "polygon": [[0,0,1],[0,1,1],[1,1,1],[1,0,1]]}],
        "cameras": [
            {"name": "above", "eye": [0.5, 0.5, 3], "look_at": [0.5, 0.5, 0], "size": [8, 6]},
            {"name": "aside", "eye": [4, 0.5, 0.5], "look_at": [0, 0.5, 0.5], "up": [0, 0, 1],
             "size": [5, 4]}],
        "solve": {"patch_size": 0.5, "rays": 16}})";
}

std::string slow_scene() {
    std::string scene = quick_scene();
    const std::string quick = R"("patch_size": 0.5, "rays": 16)";
    return scene.replace(scene.find(quick), quick.size(),
                         R"("patch_size": 0.015, "rays": 20000, "form_factors": "ray-cast")");
}

}  // namespace patchlight::server
