#include "tests/stability/judgement.h"

#include "solver/scene/input_error.h"
#include "tests/stability/catalogue.h"

#include <algorithm>
#include <cmath>

namespace patchlight::stability {

namespace {

const std::string everything = "all";

struct Judgement {
    std::string mode, column, required, verdict, measured, allowed, reason;
};

std::vector<Judgement>& judgements() {
    static std::vector<Judgement> all;
    return all;
}

std::vector<std::vector<std::string>>& furnaces() {
    static std::vector<std::vector<std::string>> rows;
    return rows;
}

void note(const Judgement& judgement) {
    const auto& modes = catalogue();
    EXPECT_TRUE(std::any_of(modes.begin(), modes.end(),
                            [&](const auto& mode) { return mode.id == judgement.mode; }))
        << judgement.mode << " is not in the catalogue";
    for (const Judgement& other : judgements())
        EXPECT_FALSE(other.mode == judgement.mode && other.column == judgement.column)
            << judgement.mode << ", " << judgement.column << " is judged twice";
    judgements().push_back(judgement);
}

void judge(const std::string& mode, const std::string& column, double measured, double required,
           const Excuse& excuse) {
    Judgement judgement{mode,    column,           required > 0.0 ? figure(required) : "exact",
                        "holds", figure(measured), "",
                        ""};
    if (!(measured <= required)) {
        judgement.verdict = "degrades";
        judgement.allowed = figure(excuse.most);
        judgement.reason = excuse.reason;
        EXPECT_LE(measured, excuse.most)
            << mode << ", " << column << ": beyond " << required << " and what excuses it";
    }
    note(judgement);
}

void refuse(const std::string& mode, const std::string& column, const std::string& words,
            const std::function<void()>& work) {
    try {
        work();
        ADD_FAILURE() << mode << ", " << column << ": accepted";
    } catch (const InputError& error) {
        const std::string message = error.pointer() + ": " + error.what();
        EXPECT_NE(message.find(words), std::string::npos) << message << "\nlacks: " << words;
    }
    note({mode, column, "", "refused", "", "", ""});
}

const Judgement* found(const std::string& mode, const std::string& column) {
    for (const Judgement& judgement : judgements())
        if (judgement.mode == mode && judgement.column == column) return &judgement;
    return nullptr;
}

std::string cell_of(const Judgement* judgement) {
    if (!judgement) return "–";
    return judgement->verdict + (judgement->measured.empty() ? "" : " " + judgement->measured);
}

bool is_judged(const std::string& mode) {
    return std::any_of(judgements().begin(), judgements().end(),
                       [&](const Judgement& judgement) { return judgement.mode == mode; });
}

std::string required_of(const std::string& mode) {
    for (const Judgement& judgement : judgements())
        if (judgement.mode == mode && !judgement.required.empty()) return judgement.required;
    return "–";
}

MarkdownTable verdicts() {
    MarkdownTable table{{"mode", "what goes wrong elsewhere", "required"}, {}};
    for (const Column& column : every_column()) table.head.push_back(column.name);
    for (const FailureMode& mode : catalogue()) {
        if (!is_judged(mode.id) || found(mode.id, everything)) continue;
        std::vector<std::string> row{mode.id, mode.what, required_of(mode.id)};
        for (const Column& column : every_column())
            row.push_back(cell_of(found(mode.id, column.name)));
        table.rows.push_back(row);
    }
    return table;
}

MarkdownTable parts() {
    MarkdownTable table{{"mode", "what goes wrong elsewhere", "required", "all methods"}, {}};
    for (const FailureMode& mode : catalogue())
        if (const Judgement* judgement = found(mode.id, everything))
            table.rows.push_back({mode.id, mode.what, required_of(mode.id), cell_of(judgement)});
    return table;
}

MarkdownTable degraded() {
    MarkdownTable table{{"mode", "method", "measured", "theory allows", "reason"}, {}};
    for (const FailureMode& mode : catalogue())
        for (const Column& column : every_column()) {
            const Judgement* judgement = found(mode.id, column.name);
            if (judgement && judgement->verdict == "degrades")
                table.rows.push_back({mode.id, column.name, judgement->measured, judgement->allowed,
                                      judgement->reason});
        }
    return table;
}

}  // namespace

void judge(const std::string& mode, const Column& column, double measured, double required,
           const Excuse& excuse) {
    if (column.to_accuracy && excuse.most > 0.0)
        judge(mode, column.name, measured, std::max(required, excuse.most), {});
    else
        judge(mode, column.name, measured, required, excuse);
}

void judge_all(const std::string& mode, double measured, double required) {
    judge(mode, everything, measured, required, {});
}

void judge_refused(const std::string& mode, const Column& column, const std::string& words,
                   const std::function<void()>& work) {
    refuse(mode, column.name, words, work);
}

void judge_all_refused(const std::string& mode, const std::string& words,
                       const std::function<void()>& work) {
    refuse(mode, everything, words, work);
}

void note_furnace(const std::vector<std::string>& cells) { furnaces().push_back(cells); }

std::map<std::string, FoundTable> found_tables() {
    return {{"verdicts", {verdicts(), 1}},
            {"parts", {parts(), 1}},
            {"degrades", {degraded(), 2}},
            {"furnaces",
             {{{"reflectance", "solver", "iterations", "true error", "bound", "change",
                "error over change", "seconds"},
               furnaces()},
              2}}};
}

std::vector<std::string> modes_not_judged() {
    std::vector<std::string> missing;
    for (const FailureMode& mode : catalogue())
        if (!is_judged(mode.id)) missing.push_back(mode.id);
    return missing;
}

}  // namespace patchlight::stability
