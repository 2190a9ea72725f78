#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "editing/outline.h"
#include "lsp/features.h"

/// A program's names in its scenarios and property files. The simulator's parser defines the statements; only
/// their words are known here.
namespace nplc::seqc::lsp {

struct Word {
    Span span;
    std::string_view text;
    bool is_step = false;      ///< after `step =`
    bool has_value = false;    ///< before `:=` or a comparison: may be a set-point
    bool is_of_order = false;  ///< in the quotes behind `ordered`
};
/// Without comments and other texts in quotes.
std::vector<Word> words_of(std::string_view text);

/// Words of statements: at, expect, rises.
std::vector<std::string_view> sentence_words();
/// P_IST, TORQUE: a set-point of that name could not be compared.
bool is_value_of_scenarios(std::string_view name);
/// The program's definition of the name at a place of a scenario; null if it is none.
const analysis::Definition* scenario_name_at(const At& at);

Json scenario_definition(Workspace& workspace, const At& at);
Json scenario_references(Workspace& workspace, const At& at);
Json scenario_highlights(Workspace& workspace, const At& at);
Json scenario_prepare_rename(Workspace& workspace, const At& at);
Json scenario_hover(Workspace& workspace, const At& at);
Json scenario_completion(Workspace& workspace, const At& at);
std::vector<analysis::Coloured> scenario_colours(const At& at);

/// Adds to `found` the locations of a name in the scenarios and property files of a program.
void add_scenario_locations(Workspace& workspace, const std::string& program_uri, std::string_view name,
                            analysis::Kind kind, Json& found);

}  // namespace nplc::seqc::lsp
