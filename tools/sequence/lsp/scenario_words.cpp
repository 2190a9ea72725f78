#include "lsp/scenario_words.h"

#include <algorithm>
#include <array>

#include "editing/hover.h"
#include "editing/names.h"
#include "language/names.h"

namespace nplc::seqc::lsp {
namespace {

using analysis::Kind;

constexpr int kTextHighlight = 1;  // DocumentHighlightKind

bool begins_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool continues_word(char c) {
    return begins_word(c) || (c >= '0' && c <= '9');
}

/// Words of scenario statements with their meaning.
struct Sentence {
    std::string_view word;
    std::string_view does;
};
constexpr auto kSentences = std::to_array<Sentence>({
    {"at", "`at TIME ACTIONS`: acts at that time; `expect at TIME CONDITION`"},
    {"every", "`every TIME [from TIME] [until TIME] ACTIONS`: again and again"},
    {"when", "`when EVENT [from TIME] [until TIME] ACTIONS`: each time the event happens"},
    {"once", "`once EVENT ACTIONS`: the first time only"},
    {"expect",
     "`expect CONDITION [at TIME | by TIME | within TIME after EVENT | for TIME]`: what must be true"},
    {"always", "`always CONDITION [from TIME] [until TIME]`"},
    {"never", "`never CONDITION [from TIME] [until TIME]`"},
    {"end", "`end at TIME`, `end when EVENT`: ends the run"},
    {"pulse", "`pulse IN0 50 ms`: on, and off again after that time"},
    {"toggle", "`toggle IN0`"},
    {"cancel", "`cancel IN0`: drops what rules have planned for it"},
    {"set", "`set Length := 80 mm and Dwell := 800 ms`: an operator changes set-points"},
    {"recipe", "`recipe save \"Short\"`, `recipe load \"Short\"`"},
    {"follows", "`IN2 follows CONDITION [after TIME] [back after TIME]`: the plant's answer"},
    {"appears", "`IN1 appears [for TIME] every TIME`"},
    {"disappears", "`IN1 disappears [TIME] after EVENT`"},
    {"line", "`line cut`, `line restored`, `line drop 1 %`: the line to the motor"},
    {"motor", "`motor error`, `motor load 500`, `motor power off`: what happens to the motor"},
    {"gateway",
     "`gateway stop`, `gateway run`, `gateway hold`, `gateway restart`, `gateway force Start := 1`"},
    {"log", "`log \"text\"`: a remark in the timeline"},
    {"seed", "`seed 7`: sets the seed of the line's random faults"},
    {"step", "the active step: `step = Name`, `step in Group`"},
    {"INPOS", "the motor is in position"},
    {"ERROR", "the sequence sees an error"},
    {"LINK", "the gateway can reach the motor"},
    {"RUNNING", "the sequence runs"},
    {"P_IST", "the motor's position: `P_IST = 80 mm +- 0.1 mm`"},
    {"V_IST", "the motor's velocity: `V_IST = 0 rpm +- 8 rpm`"},
    {"SHAFT", "where the shaft really is since the run began"},
    {"TORQUE", "what the motor gives, 1023 being full"},
    {"TIMER", "milliseconds left"},
    {"COUNTER", "the counter"},
    {"INPUTS", "all input bits"},
    {"OUTPUTS", "all output bits"},
    {"rises", "becomes true"},
    {"falls", "becomes false"},
    {"changes", "becomes another value"},
    {"within", "`within TIME after EVENT`"},
    {"after", "a time later"},
    {"from", "not before that time"},
    {"until", "not after that time"},
    {"by", "at least once until then"},
    {"for", "all of that time"},
    {"ordered", "`ordered \"POSITION(P2)\"`: the sequence gives this order"},
    {"and", "both"},
    {"or", "one of them"},
    {"not", "the opposite"},
});

const Sentence* sentence_word(std::string_view word) {
    const auto* found = std::find_if(kSentences.begin(), kSentences.end(),
                                     [&](const Sentence& s) { return same_name(s.word, word); });
    return found == kSentences.end() ? nullptr : found;
}

bool may_be(const Word& word, Kind kind) {
    switch (kind) {
        case Kind::step:
        case Kind::group:
            return word.is_step;
        case Kind::input:
        case Kind::output:
            return !word.is_step && !word.is_of_order;
        case Kind::set_point:
            return word.is_of_order || (word.has_value && !word.is_step);
        case Kind::motor_variable:
            return word.is_of_order;
        default:
            return false;
    }
}

const analysis::Definition* definition_of(const analysis::Program& program, const Word& word) {
    for (const Kind kind :
         {Kind::step, Kind::group, Kind::input, Kind::output, Kind::set_point, Kind::motor_variable}) {
        if (!may_be(word, kind)) continue;
        if (const auto* definition = program.find(kind, word.text)) return definition;
    }
    return nullptr;
}

/// `:=`, a comparison or `changes` follows.
bool has_value_at(std::string_view text, std::size_t at) {
    while (at < text.size() && (text[at] == ' ' || text[at] == '\t')) ++at;
    const std::string_view rest = text.substr(at);
    constexpr std::string_view kChanges = "changes";
    return rest.starts_with(":=") || rest.starts_with('=') || rest.starts_with('<') ||
           rest.starts_with('>') || same_name(rest.substr(0, kChanges.size()), kChanges);
}

void add_words_of_order(std::string_view text, std::size_t begin, std::size_t end, std::vector<Word>& words) {
    for (std::size_t at = begin; at < end;) {
        std::size_t after = at;
        while (after < end && continues_word(text[after])) ++after;
        if (after == at) {
            ++at;
            continue;
        }
        Word word{{static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(after - at)},
                  text.substr(at, after - at)};
        word.is_of_order = true;
        if (begins_word(text[at])) words.push_back(word);
        at = after;
    }
}

std::optional<Word> word_at(const At& at) {
    for (const Word& word : words_of(at.document.text())) {
        if (analysis::holds(word.span, at.offset)) return word;
    }
    return std::nullopt;
}

/// The line before a place in capital letters, without blanks at its end.
std::string line_before(const At& at, std::uint32_t offset) {
    const std::uint32_t start = at.document.lines().start_of(at.document.lines().line_of(offset));
    std::string before = upper(std::string_view(at.document.text()).substr(start, offset - start));
    while (!before.empty() && before.back() == ' ') before.pop_back();
    return before;
}

}  // namespace

std::vector<std::string_view> sentence_words() {
    std::vector<std::string_view> words;
    for (const Sentence& sentence : kSentences) words.push_back(sentence.word);
    return words;
}

bool is_value_of_scenarios(std::string_view name) {
    constexpr auto kValues = std::to_array<std::string_view>({"step", "TIMER", "COUNTER", "INPOS", "IN_POS",
                                                              "ERROR", "LINK", "RUNNING", "INPUTS", "OUTPUTS",
                                                              "P_IST", "V_IST", "SHAFT", "TORQUE"});
    return std::any_of(kValues.begin(), kValues.end(),
                       [name](std::string_view value) { return same_name(value, name); });
}

const analysis::Definition* scenario_name_at(const At& at) {
    const auto word = word_at(at);
    return word && at.view.program ? definition_of(*at.view.program, *word) : nullptr;
}

std::vector<Word> words_of(std::string_view text) {
    std::vector<Word> words;
    std::string_view before;
    bool compares = false;
    bool in_group = false;
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        if (c == '#' || text.substr(at, 2) == "//") {
            at = std::min(text.find('\n', at), text.size());
        } else if (text.substr(at, 2) == "(*") {
            at = std::min(text.find("*)", at), text.size() - 2) + 2;
        } else if (c == '"' || c == '\'') {
            const std::size_t end =
                std::min(text.find_first_of(c == '"' ? "\"\n" : "'\n", at + 1), text.size() - 1);
            if (same_name(before, "ordered")) add_words_of_order(text, at + 1, end, words);
            before = {};
            at = end + 1;
        } else if (begins_word(c)) {
            std::size_t end = at;
            while (end < text.size() && continues_word(text[end])) ++end;
            const std::string_view word = text.substr(at, end - at);
            const bool is_stored = same_name(before, "motor");  // motor INPOSWIN := 20
            words.push_back({{static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(end - at)},
                             word,
                             in_group || (compares && same_name(before, "step")),
                             !is_stored && has_value_at(text, end)});
            in_group = same_name(word, "in") && same_name(before, "step");
            before = word;
            compares = false;
            at = end;
        } else if (c >= '0' && c <= '9') {  // a number with a suffix
            while (at < text.size() && (continues_word(text[at]) || text[at] == '.')) ++at;
            compares = false;
            before = {};
        } else {
            compares = compares || c == '=' || c == '<' || c == '>';
            if (c == '\n') before = {};
            ++at;
        }
    }
    return words;
}

Json scenario_definition(Workspace& workspace, const At& at) {
    const analysis::Definition* definition = scenario_name_at(at);
    return definition == nullptr ? Json() : workspace.location_json(at.view, definition->name_span);
}

Json scenario_references(Workspace& workspace, const At& at) {
    Json found = Json::array();
    const analysis::Definition* definition = scenario_name_at(at);
    if (definition == nullptr) return found;
    for (const analysis::Occurrence& occurrence :
         analysis::occurrences_at(*at.view.program, definition->name_span.offset))
        found.push_back(workspace.location_json(at.view, occurrence.span));
    add_scenario_locations(workspace, at.view.uri, definition->name, definition->kind, found);
    return found;
}

Json scenario_highlights(Workspace& workspace, const At& at) {
    Json found = Json::array();
    const auto here = word_at(at);
    const analysis::Definition* definition = scenario_name_at(at);
    if (definition == nullptr) return found;
    for (const Word& word : words_of(at.document.text())) {
        if (same_name(word.text, here->text) && definition_of(*at.view.program, word) == definition)
            found.push_back(
                {{"range", workspace.range_json(at.document.lines(), word.span)}, {"kind", kTextHighlight}});
    }
    return found;
}

Json scenario_prepare_rename(Workspace& workspace, const At& at) {
    if (scenario_name_at(at) == nullptr) return Json();
    const auto word = word_at(at);
    return {{"range", workspace.range_json(at.document.lines(), word->span)}, {"placeholder", word->text}};
}

Json scenario_hover(Workspace& workspace, const At& at) {
    const auto word = word_at(at);
    if (!word) return Json();
    std::string text;
    if (const analysis::Definition* definition = scenario_name_at(at)) {
        if (const auto hover = analysis::hover_at(*at.view.program, definition->name_span.offset))
            text = hover->markdown;
    } else if (const Sentence* sentence = sentence_word(word->text)) {
        text = sentence->does;
    }
    if (text.empty()) return Json();
    return {{"contents", {{"kind", "markdown"}, {"value", text}}},
            {"range", workspace.range_json(at.document.lines(), word->span)}};
}

Json scenario_completion(Workspace& workspace, const At& at) {
    Span replaced{at.offset, 0};
    bool after_step = false;
    for (const Word& word : words_of(at.document.text())) {
        if (!analysis::holds(word.span, at.offset)) continue;
        replaced = word.span;
        after_step = word.is_step;
    }
    std::string before = line_before(at, replaced.offset);
    const bool sets = before == "SET" || before.ends_with(" SET") || before.ends_with(",SET");
    if (replaced.length == 0) {
        const bool compares = before.ends_with('=') || before.ends_with("<>");
        while (!before.empty() && std::string_view("=<> ").find(before.back()) != std::string_view::npos)
            before.pop_back();
        after_step = before.ends_with("STEP IN") || (compares && before.ends_with("STEP"));
    }
    const Json range = workspace.range_json(at.document.lines(), replaced);
    Json items = Json::array();
    const auto add = [&](std::string_view label, int kind, std::string_view detail) {
        items.push_back({{"label", label},
                         {"kind", kind},
                         {"detail", detail},
                         {"textEdit", {{"range", range}, {"newText", label}}}});
    };
    if (at.view.program) {
        for (const analysis::Definition& definition : at.view.program->definitions()) {
            const bool signal = definition.kind == Kind::input || definition.kind == Kind::output;
            const bool steps = definition.kind == Kind::step || definition.kind == Kind::group;
            if (!sets && (after_step ? steps : signal))
                add(definition.name, steps ? 3 : 6, definition.address);
        }
        for (const analysis::Definition& definition : at.view.program->definitions()) {
            if (definition.kind == Kind::set_point && !after_step)
                add(definition.name, 6, at.view.program->text(definition.whole));
        }
        if (after_step) add("POWER_UP", 3, "step 0");
    }
    for (const Sentence& sentence : kSentences) {
        if (!after_step && !sets) add(sentence.word, 14, sentence.does);
    }
    return {{"isIncomplete", false}, {"items", items}};
}

std::vector<analysis::Coloured> scenario_colours(const At& at) {
    using analysis::TokenType;
    std::vector<analysis::Coloured> colours;
    for (const Word& word : words_of(at.document.text())) {
        const analysis::Definition* definition =
            at.view.program ? definition_of(*at.view.program, word) : nullptr;
        if (definition != nullptr) {
            const TokenType type = definition->kind == Kind::step     ? TokenType::step
                                   : definition->kind == Kind::group  ? TokenType::group
                                   : definition->kind == Kind::input  ? TokenType::input
                                   : definition->kind == Kind::output ? TokenType::output
                                                                      : TokenType::register_name;
            colours.push_back({word.span, type});
        } else if (sentence_word(word.text) != nullptr) {
            colours.push_back({word.span, TokenType::keyword});
        }
    }
    return colours;
}

void add_scenario_locations(Workspace& workspace, const std::string& program_uri, std::string_view name,
                            Kind kind, Json& found) {
    for (const auto& [uri, text] : workspace.dependants_of(program_uri)) {
        const analysis::Lines lines(text);
        for (const Word& word : words_of(text)) {
            if (same_name(word.text, name) && may_be(word, kind))
                found.push_back({{"uri", uri}, {"range", workspace.range_json(lines, word.span)}});
        }
    }
}

}  // namespace nplc::seqc::lsp
