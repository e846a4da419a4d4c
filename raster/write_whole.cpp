#include "raster/write_whole.h"

#include "raster/whole_file.h"

namespace patchlight::raster {

void write_whole(const std::filesystem::path& path, std::string_view bytes) {
    WholeFile file(path);
    file.write(bytes);
    file.commit();
}

}  // namespace patchlight::raster
