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

const CLI::App* command_of(const CLI::App& program, const std::vector<std::string>& words) {
    for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
        if (!words.empty() && command->get_name() == words.front()) return command;
    return nullptr;
}

/// Whether a word is meant as an option: a number may begin with a minus, too.
bool names_option(const CLI::App& command, const std::string& word) {
    return word.starts_with("--") || (is_option(word) && command.get_option_no_throw(word));
}

}  // namespace

std::string option_for_value(const CLI::App& program, int count, const char* const* arguments) {
    const std::vector<std::string> words(arguments + std::min(count, 1), arguments + count);
    const CLI::App* const command = command_of(program, words);
    if (!command) return "";
    for (std::size_t k = 1; k + 1 < words.size(); ++k) {
        const CLI::Option* const option =
            is_option(words[k]) ? command->get_option_no_throw(words[k]) : nullptr;
        const bool needs_value = option && option->get_items_expected_min() > 0;
        if (!needs_value || !names_option(*command, words[k + 1])) continue;
        return words[k] + ": needs " + option->get_type_name() + " after it, not the option " +
               in_quotes(words[k + 1]) + "; what is called so is written './" + words[k + 1] + "'";
    }
    return "";
}

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
