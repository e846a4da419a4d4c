#include "server/output_stream.h"

#include "raster/whole_file.h"

#include <iostream>

namespace patchlight::server {

void write_output(const std::string& path, const std::function<void(const TextSink&)>& write) {
    if (path == to_standard_output) {
        write([](std::string_view bytes) {
            std::cout.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        });
        return;
    }
    raster::WholeFile file(path);
    write([&](std::string_view bytes) { file.write(bytes); });
    file.commit();
}

}  // namespace patchlight::server
