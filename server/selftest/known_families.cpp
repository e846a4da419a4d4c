#include "server/selftest/known_families.h"

#include <array>

namespace patchlight::server {

std::span<const KnownFamily> known_families() {
    static constexpr std::array families{KnownFamily{"view-factors", answer_view_factors},
                                         KnownFamily{"furnaces", answer_furnaces},
                                         KnownFamily{"cubes", answer_cubes},
                                         KnownFamily{"plates", answer_plates},
                                         KnownFamily{"cie-171", answer_cie_cases},
                                         KnownFamily{"penumbra", answer_penumbrae},
                                         KnownFamily{"rooms", answer_rooms}};
    return families;
}

}  // namespace patchlight::server
