#pragma once

#include "server/selftest/answer_sheet.h"

#include <span>
#include <string_view>

namespace patchlight::server {

/// Cases of one kind.
struct KnownFamily {
    std::string_view name;
    void (*answer)(AnswerSheet& sheet);
};

/// All there are, in the order in which they are run.
std::span<const KnownFamily> known_families();

void answer_view_factors(AnswerSheet& sheet);
void answer_furnaces(AnswerSheet& sheet);
void answer_cubes(AnswerSheet& sheet);
void answer_plates(AnswerSheet& sheet);
void answer_cie_cases(AnswerSheet& sheet);
void answer_penumbrae(AnswerSheet& sheet);
void answer_rooms(AnswerSheet& sheet);

}  // namespace patchlight::server
