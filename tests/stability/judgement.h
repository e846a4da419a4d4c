#pragma once

#include "tests/stability/column.h"
#include "tests/stability/markdown_table.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace patchlight::stability {

/// Where theory lets a method miss what a robust solver must do, by how much at most, and why.
struct Excuse {
    double most = 0.0;
    std::string reason;
};

/// Notes that `column` meets failure mode `mode` with an error of `measured`: it holds where that
/// is no more than `required`, degrades where the excuse covers it, and else the test fails, as it
/// does where `measured` is no number. A solve to an accuracy owes no more than it was asked for:
/// what excuses it is what it is held to.
void judge(const std::string& mode, const Column& column, double measured, double required,
           const Excuse& excuse = {});

/// The same of a mode that concerns one part that all methods share.
void judge_all(const std::string& mode, double measured, double required);

/// Notes that the scene is refused. The test fails unless `work` throws an InputError with `words`
/// somewhere in its place or message.
void judge_refused(const std::string& mode, const Column& column, const std::string& words,
                   const std::function<void()>& work);
void judge_all_refused(const std::string& mode, const std::string& words,
                       const std::function<void()>& work);

/// A row of the table of furnaces.
void note_furnace(const std::vector<std::string>& cells);

/// A table as the run wrote it so far, and by how many of its cells its rows are told apart.
struct FoundTable {
    MarkdownTable table;
    std::size_t keys = 0;
};
/// By name: "verdicts", "parts", "degrades", "furnaces".
std::map<std::string, FoundTable> found_tables();

/// Modes of the catalogue that nothing judged.
std::vector<std::string> modes_not_judged();

}  // namespace patchlight::stability
