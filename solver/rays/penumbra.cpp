#include "solver/rays/penumbra.h"

#include <algorithm>

namespace patchlight {

namespace {
constexpr std::size_t reach = 2;  // neighbours on either side
}

std::vector<bool> in_penumbra(std::span<const FirstLook> looks) {
    std::vector<bool> chosen(looks.size());
    for (std::size_t k = 0; k < looks.size(); ++k) {
        int clear = 0, taken = 0, neighbours = 0;
        for (std::size_t l = k < reach ? 0 : k - reach; l < std::min(looks.size(), k + reach + 1);
             ++l) {
            if (l == k || looks[l].sheet != looks[k].sheet) continue;
            clear += looks[l].clear;
            taken += looks[l].taken;
            ++neighbours;
        }
        chosen[k] = neighbours < 2 || (clear > 0 && clear < taken);
    }
    return chosen;
}

}  // namespace patchlight
