#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/outline.h"
#include "lsp/features.h"

/// The names of a program in its scenarios and property files. What a scenario's sentences mean is the
/// simulator's business; here are its words.
namespace nplc::seqc::lsp {

struct Word {
    Span span;
    std::string_view text;
    bool is_step = false;  ///< behind `step =`
};
/// Without comments and texts in quotes.
std::vector<Word> words_of(std::string_view text);

/// What sentences are made of: at, expect, rises.
std::vector<std::string_view> sentence_words();
/// What the program calls the thing at a place of a scenario; null if it is nothing of the program.
const analysis::Definition* scenario_name_at(const At& at);

Json scenario_definition(Workspace& workspace, const At& at);
Json scenario_references(Workspace& workspace, const At& at);
Json scenario_highlights(Workspace& workspace, const At& at);
Json scenario_prepare_rename(Workspace& workspace, const At& at);
Json scenario_hover(Workspace& workspace, const At& at);
Json scenario_completion(Workspace& workspace, const At& at);
std::vector<analysis::Coloured> scenario_colours(const At& at);

/// Where the scenarios and property files of a program name something of it, as locations added to `found`.
void add_scenario_locations(Workspace& workspace, const std::string& program_uri, std::string_view name,
                            analysis::Kind kind, Json& found);

}  // namespace nplc::seqc::lsp
