#include "server/argument_hint.h"

#include "server/wording.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <vector>

namespace patchlight::server {
namespace {

std::vector<std::string> shown_commands(const CLI::App& program) {
    std::vector<std::string> names;
    for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
        if (!command->get_group().empty()) names.push_back(command->get_name());
    return names;
}

bool is_option(const std::string& argument) { return argument.starts_with("-"); }

std::string unknown_option(const CLI::App& command, const std::string& argument) {
    const std::string option = argument.substr(0, argument.find('='));
    if (!option.starts_with("--") || command.get_option_no_throw(option)) return "";
    std::vector<std::string> known;
    for (const CLI::Option* each : command.get_options())
        if (!each->get_group().empty() && !each->get_lnames().empty())
            known.push_back("--" + each->get_lnames().front());
    return "unknown option " + in_quotes(option) + suggestion(option, known);
}

}  // namespace

std::string unknown_argument(const CLI::App& program, int count, const char* const* arguments) {
    const std::vector<std::string> words(arguments + std::min(count, 1), arguments + count);
    const auto asked = program.get_subcommands();
    if (asked.empty()) {
        const bool is_command = !words.empty() && !is_option(words.front());
        return is_command ? "unknown command " + in_quotes(words.front()) +
                                suggestion(words.front(), shown_commands(program))
                          : "";
    }
    for (const std::string& word : words)
        if (std::string hint = unknown_option(*asked.front(), word); !hint.empty()) return hint;
    return "";
}

}  // namespace patchlight::server
