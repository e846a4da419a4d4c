#include "server/selftest/selftest_table.h"

#include "server/csv_table.h"
#include "server/summary.h"
#include "server/version.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <thread>

namespace patchlight::server {
namespace {

constexpr std::size_t name_width = 31, quantity_width = 27, method_width = 25, number_width = 11,
                      small_width = 9;

/// Letters are counted, not bytes.
std::string padded(std::string text, std::size_t width, bool to_the_right = false) {
    const auto letters =
        static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
            return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
        }));
    const std::string gap(width > letters ? width - letters : 0, ' ');
    return to_the_right ? gap + text : text + gap;
}

std::string shown(const char* format, double number) {
    char text[32];
    std::snprintf(text, sizeof text, format, number);
    return text;
}

std::string number(double value) { return padded(shown("%.7g", value), number_width, true) + " "; }
std::string small(double value) { return padded(shown("%.1e", value), small_width, true) + " "; }

std::string compiler() {
#if defined(__clang__)
    return "Clang " __clang_version__;
#else
    return "GCC " __VERSION__;
#endif
}

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name") && line.find(": ") != std::string::npos)
            return line.substr(line.find(": ") + 2);
    return "";
}

}  // namespace

std::string selftest_head() {
    const auto right = [](const char* text, std::size_t width) {
        return padded(text, width, true) + " ";
    };
    return padded("case", name_width) + padded("quantity", quantity_width) +
           padded("method", method_width) + right("result", number_width) +
           right("exact", number_width) + right("published", number_width) +
           right("error", small_width) + right("bound", small_width) + "    time\n";
}

std::string selftest_line(const KnownAnswer& answer) {
    return padded(answer.name, name_width) + padded(answer.quantity, quantity_width) +
           padded(answer.method, method_width) + number(answer.result) + number(answer.exact) +
           (answer.published ? number(*answer.published) : std::string(number_width + 1, ' ')) +
           small(answer.error()) + small(answer.bound) + shown("%6.3f s", answer.seconds) +
           (answer.is_within() ? "" : "  OUT OF BOUND") + "\n";
}

bool all_within(std::span<const KnownAnswer> answers) {
    return !answers.empty() && std::all_of(answers.begin(), answers.end(),
                                           [](const KnownAnswer& a) { return a.is_within(); });
}

std::string selftest_verdict(std::span<const KnownAnswer> answers, double seconds) {
    const auto within = std::count_if(answers.begin(), answers.end(),
                                      [](const KnownAnswer& a) { return a.is_within(); });
    return (all_within(answers) ? "passed: " : "FAILED: ") + std::to_string(within) + " of " +
           std::to_string(answers.size()) + " answers are within their bounds, " +
           rounded(seconds) + " s\n";
}

void write_selftest_csv(std::span<const KnownAnswer> answers, const TextSink& sink) {
    CsvTable table("case,quantity,method,result,exact,published,error,bound,seconds,within", sink);
    for (const KnownAnswer& answer : answers) {
        table.text(answer.name).text(answer.quantity).text(answer.method);
        table.number(answer.result).number(answer.exact);
        answer.published ? table.number(*answer.published) : table.text("");
        table.number(answer.error()).number(answer.bound).number(answer.seconds);
        table.text(answer.is_within() ? "true" : "false").end_row();
    }
    table.finish();
}

void write_selftest_json(std::span<const KnownAnswer> answers, double seconds,
                         const TextSink& sink) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const KnownAnswer& answer : answers) {
        nlohmann::ordered_json row{{"case", answer.name},
                                   {"quantity", answer.quantity},
                                   {"method", answer.method},
                                   {"result", answer.result},
                                   {"exact", answer.exact}};
        if (answer.published) row["published"] = *answer.published;
        row["error"] = answer.error();
        row["bound"] = answer.bound;
        row["seconds"] = answer.seconds;
        row["within"] = answer.is_within();
        list.push_back(std::move(row));
    }
    const nlohmann::ordered_json whole{{"patchlight", program_version()},
                                       {"machine", build_and_machine()},
                                       {"seconds", seconds},
                                       {"within", all_within(answers)},
                                       {"answers", std::move(list)}};
    sink(whole.dump(1) + "\n");
}

std::string build_and_machine() {
    const unsigned threads = std::thread::hardware_concurrency();
    return std::string("patchlight ") + program_version() + " (" + compiler() + "), " +
           std::to_string(threads) + " threads, " + processor();
}

}  // namespace patchlight::server
