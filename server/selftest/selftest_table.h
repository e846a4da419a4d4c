#pragma once

#include "server/selftest/known_answer.h"
#include "server/text_sink.h"

#include <span>
#include <string>

namespace patchlight::server {

/// Column heads of the table for people, and a line of it.
std::string selftest_head();
std::string selftest_line(const KnownAnswer& answer);

/// The last line: how many answers are within their bounds. `seconds` is the whole time.
std::string selftest_verdict(std::span<const KnownAnswer> answers, double seconds);

/// Whether there are answers, and all are within their bounds.
bool all_within(std::span<const KnownAnswer> answers);

/// case,quantity,method,result,exact,published,error,bound,seconds,within: a row for each answer;
/// published is empty where there is none.
void write_selftest_csv(std::span<const KnownAnswer> answers, const TextSink& sink);

/// The same as {"patchlight", "machine", "seconds", "within", "answers": […]}.
void write_selftest_json(std::span<const KnownAnswer> answers, double seconds,
                         const TextSink& sink);

/// The build and the machine that the times are of, such as "patchlight 0.1.0 (GCC 12.2.0), 2
/// threads, AMD EPYC".
std::string build_and_machine();

}  // namespace patchlight::server
