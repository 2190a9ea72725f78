#include "editing/completion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "diagnostics/codes.h"
#include "diagnostics/reference.h"
#include "editing/register_text.h"
#include "language/lexer.h"
#include "language/names.h"
#include "language/parser.h"
#include "registers/details.h"
#include "symbols/commands.h"
#include "symbols/motors.h"

namespace nplc::seqc::analysis {
namespace {

using ast::Role;

struct Context {
    Expected expected;
    Span replaced;
    std::string_view last_register;  ///< the name that a value or unit belongs to
    bool in_property = false;
};

bool is_word(const Token& token) {
    return token.kind == TokenKind::identifier || token.kind == TokenKind::direct;
}

/// Queries the parser: replaces the word under the cursor by a token that is not valid anywhere.
Context context_at(const Program& program, std::uint32_t offset) {
    Context context;
    std::vector<Token> tokens = program.tokens();
    auto at = std::find_if(tokens.begin(), tokens.end(), [&](const Token& t) {
        return t.kind == TokenKind::end || end_of(t.span) > offset ||
               (is_word(t) && end_of(t.span) == offset);
    });
    context.replaced = {offset, 0};
    Token place;
    place.kind = TokenKind::symbol;
    place.text = kPlace;
    if (at != tokens.end() && is_word(*at) && at->span.offset < offset) {
        context.replaced = at->span;
        place.span = at->span;
        *at = place;
    } else {
        place.span = {offset, 0};
        tokens.insert(at, place);
    }
    Report noise;
    Parser parser(program.source(), std::move(tokens), noise);
    parser.collect(context.expected);
    const ast::Program tree = program.is_part() ? parser.parse_part() : parser.parse();
    for (const ast::Use& use : tree.uses) {
        if (use.span.offset < context.replaced.offset && !use.declares && use.role == Role::register_name)
            context.last_register = program.text(use.span);
    }
    context.in_property = std::any_of(tree.claims.begin(), tree.claims.end(),
                                      [&](const ast::Claim& claim) { return holds(claim.span, offset); }) ||
                          program.in_property(offset);
    return context;
}

bool has(const Expected& expected, std::string_view word) {
    return std::find(expected.words.begin(), expected.words.end(), word) != expected.words.end();
}
bool has(const Expected& expected, Role role) {
    return std::find(expected.names.begin(), expected.names.end(), role) != expected.names.end();
}

constexpr std::array kBlockEnds = {std::string_view("END_IF"), std::string_view("END_STEP"),
                                   std::string_view("END_POWER_UP"), std::string_view("END_VAR"),
                                   std::string_view("END_PROGRAM")};

/// Words that the parser accepts only to report that they are not allowed here.
bool only_refused(const Expected& expected, std::string_view word) {
    const auto innermost = std::find_if(kBlockEnds.begin(), kBlockEnds.end(),
                                        [&](std::string_view end) { return has(expected, end); });
    const std::string_view end = innermost == kBlockEnds.end() ? "" : *innermost;
    if (std::find(kBlockEnds.begin(), kBlockEnds.end(), word) != kBlockEnds.end()) return word != end;
    const bool in_if = end == "END_IF";
    const bool in_step = end == "END_STEP" || end == "END_POWER_UP";
    if (word == "STEP") return in_if || in_step;
    if (word == "POWER_UP") return in_if || in_step;
    if (in_if && (word == "IF" || word == "OUT")) return true;
    if ((word == "NOT" || word == "SET" || word == "RESET") && has(expected, Role::output)) return true;
    if (has(expected, Role::tested) && (word == "THEN" || word == "AND" || word == "OR" || word == "XOR"))
        return true;
    return false;
}

struct Shape {
    std::string_view word;
    std::string_view snippet;
};

constexpr auto kShapes = std::to_array<Shape>({
    {"IF", "IF ${1:condition} THEN\n    $0\nEND_IF"},
    {"ELSIF", "ELSIF ${1:condition} THEN\n    $0"},
    {"STEP", "STEP ${1:Name}:\n    $0\nEND_STEP"},
    {"POWER_UP", "POWER_UP\n    NEXT := ${1:Step};\nEND_POWER_UP"},
    {"VAR_INPUT", "VAR_INPUT\n    ${1:Name} AT IN${2:0} : BOOL;\nEND_VAR"},
    {"VAR_OUTPUT", "VAR_OUTPUT\n    ${1:Name} AT OUT${2:0} : BOOL;\nEND_VAR"},
    {"VAR_MOTOR", "VAR_MOTOR\n    ${1:Name} AT ${2:P1} := ${3:0};\nEND_VAR"},
    {"NEXT", "NEXT := ${1:Step};"},
    {"ENTRY", "ENTRY $0"},
    {"OWN", "OWN ERROR;"},
    {"MOTOR", "MOTOR ${1:MAC140};"},
    {"SCALE", "SCALE 1 rev = ${1:10} ${2:mm};"},
    {"COUNT_DOWN", "COUNT_DOWN;"},
    {"CLEAR_COUNTER", "CLEAR_COUNTER;"},
    {"NO_HELPER", "NO_HELPER;"},
    {"PROPERTY", "PROPERTY ${1:Name}: NEVER $0;"},
    {"GROUP", "GROUP ${1:Name}: $0;"},
    {"ANY", "ANY ERROR"},
});

void add_word(Proposals& result, const Expected& expected, std::string_view word) {
    Proposal proposal{Proposal::Kind::keyword, std::string(word), std::string(word), false, "", ""};
    if ((word == "TIMER" || word == "COUNTER") && has(expected, Role::tested)) {
        proposal.label = proposal.insert = std::string(word) + ".Q";
    } else if (word == "TIMER") {
        proposal.insert = "TIMER := T#${1:500ms};";
        proposal.is_snippet = true;
    } else if (word == "COUNTER") {
        proposal.insert = "COUNTER := ${1:1};";
        proposal.is_snippet = true;
    } else if (word == "ON" && has(expected, "MOTOR")) {
        proposal.insert = "ON ${1:ERROR} NEXT := ${2:Fault};";
        proposal.is_snippet = true;
    }
    for (const Shape& shape : kShapes) {
        if (shape.word != word || has(expected, Role::tested) != (word == "ANY")) continue;
        proposal.insert = std::string(shape.snippet);
        proposal.is_snippet = true;
    }
    const auto same = [&](const Proposal& other) { return other.label == proposal.label; };
    if (std::none_of(result.list.begin(), result.list.end(), same))
        result.list.push_back(std::move(proposal));
}

void add_definitions(Proposals& result, const Program& program, Kind kind, Proposal::Kind shown) {
    for (const Definition& definition : program.definitions()) {
        if (definition.kind != kind || definition.name_span == result.replaced) continue;
        Proposal proposal{shown, std::string(definition.name), std::string(definition.name), false, "", ""};
        proposal.detail = std::string(definition.address);
        if (kind == Kind::motor_variable) {
            if (const auto* reg = program.register_named(definition.name))
                proposal.detail += fmt::format(": {}", register_line(program, *reg));
        }
        result.list.push_back(std::move(proposal));
    }
}

/// Those of a register are selected; the others are times and counts.
void add_set_points(Proposals& result, const Program& program, bool of_register) {
    for (const Definition& definition : program.definitions()) {
        const auto* reg = program.register_named(definition.name);
        if (definition.kind != Kind::set_point || definition.name_span == result.replaced ||
            (reg != nullptr) != of_register)
            continue;
        result.list.push_back({of_register ? Proposal::Kind::register_name : Proposal::Kind::value,
                               std::string(definition.name), std::string(definition.name), false,
                               fmt::format("set-point {}", program.text(definition.whole)), ""});
    }
}

void add_registers(Proposals& result, const Program& program, bool selectable_only, bool assigns) {
    for (const registers::Register& reg : registers::map_of(program.symbols().motor)) {
        if (reg.number > 127 || (selectable_only && !selection_of(reg.number))) continue;
        if (!selectable_only && reg.access == registers::Access::read_only) continue;
        const registers::Details* details = registers::details_of(program.symbols().motor, reg.number);
        Proposal proposal{
            Proposal::Kind::register_name, std::string(reg.name), std::string(reg.name), false, "", ""};
        proposal.detail = fmt::format("{}{}{}", details != nullptr ? details->title : "",
                                      details != nullptr ? "; " : "", register_line(program, reg));
        if (assigns) proposal.insert += " := ";
        result.list.push_back(std::move(proposal));
    }
}

void add_addresses(Proposals& result, const Program& program, std::string_view prefix, int count) {
    for (int i = 0; i < count; ++i) {
        const std::string name = fmt::format("{}{}", prefix, i);
        const std::string located = fmt::format("%{}X0.{}", prefix == "IN" ? 'I' : 'Q', i);
        const bool taken = std::any_of(
            program.definitions().begin(), program.definitions().end(),
            [&](const Definition& d) { return same_name(d.address, name) || same_name(d.address, located); });
        if (!taken) result.list.push_back({Proposal::Kind::value, name, name, false, "free", ""});
    }
}

void add_commands(Proposals& result) {
    for (std::string_view name : command_names()) {
        const NamedCommand* command = find_command(name);
        if (command != nullptr && command->is_of_link) continue;
        const bool selects = mode_named(name).has_value();
        Proposal proposal{Proposal::Kind::command, std::string(name), std::string(name) + ";", false, "", ""};
        if (selects || same_name(name, "USE_SET")) {
            proposal.insert = fmt::format("{}(${{1}});", name);
            proposal.is_snippet = true;
        }
        result.list.push_back(std::move(proposal));
    }
}

void add_units(Proposals& result, const Program& program, const Context& context) {
    const registers::Register* reg = program.register_named(context.last_register);
    if (reg == nullptr) return;
    for (const std::string& unit : fitting_units(*reg, program.length_unit()))
        result.list.push_back({Proposal::Kind::unit, unit, unit, false, register_line(program, *reg), ""});
}

void add_names(Proposals& result, const Program& program, const Context& context) {
    const Expected& expected = context.expected;
    if (has(expected, Role::step) || has(expected, Role::step_or_group)) {
        add_definitions(result, program, Kind::step, Proposal::Kind::step);
        if (has(expected, Role::step)) add_word(result, {}, "POWER_UP");
    }
    if (has(expected, Role::step_or_group))
        add_definitions(result, program, Kind::group, Proposal::Kind::group);
    if (has(expected, Role::tested)) add_definitions(result, program, Kind::input, Proposal::Kind::signal);
    if (has(expected, Role::output) || (has(expected, Role::tested) && context.in_property))
        add_definitions(result, program, Kind::output, Proposal::Kind::signal);
    if (has(expected, Role::command)) {
        add_commands(result);
        add_definitions(result, program, Kind::motor_variable, Proposal::Kind::register_name);
        add_registers(result, program, false, true);
    }
    if (has(expected, Role::register_name)) {
        add_definitions(result, program, Kind::motor_variable, Proposal::Kind::register_name);
        add_set_points(result, program, true);
        add_registers(result, program, !has(expected, "REG"), false);
    }
    if (has(expected, Role::constant)) {
        for (const Definition& definition : program.definitions()) {
            if (definition.kind == Kind::constant)
                result.list.push_back({Proposal::Kind::value, std::string(definition.name),
                                       std::string(definition.name), false, "", ""});
        }
        add_set_points(result, program, false);
    }
    if (has(expected, Role::motor)) {
        for (std::string_view name : motor_names())
            result.list.push_back(
                {Proposal::Kind::motor, std::string(name), std::string(name), false, "", ""});
    }
    if (has(expected, Role::address)) {
        add_addresses(result, program, "IN", 6);
        add_addresses(result, program, "OUT", 4);
    }
    if (has(expected, Role::check)) {
        for (const CodeRow& row : kCodes) {
            if (row.phase == Phase::courses)
                result.list.push_back(
                    {Proposal::Kind::value, std::string(row.code), std::string(row.code), false, "", ""});
        }
    }
}

}  // namespace

Proposals complete(const Program& program, std::uint32_t offset) {
    Proposals result;
    result.replaced = {offset, 0};
    if (program.in_comment(offset)) return result;
    const Context context = context_at(program, offset);
    result.replaced = context.replaced;
    add_names(result, program, context);
    if (context.expected.unit) add_units(result, program, context);
    if (context.expected.value && context.expected.words.empty() && !context.expected.unit)
        result.list.push_back({Proposal::Kind::value, "T#", "T#${1:500ms}", true, "a time", ""});
    for (std::string_view word : context.expected.words) {
        const bool refused = only_refused(context.expected, word) ||
                             (context.expected.value && (word == "TRUE" || word == "FALSE"));
        if (!refused) add_word(result, context.expected, word);
    }
    const auto rank = [&](const Proposal& proposal) {
        if (proposal.kind == Proposal::Kind::keyword) return 1;
        if (proposal.kind == Proposal::Kind::command) return 2;
        if (proposal.kind != Proposal::Kind::register_name) return 0;
        const bool is_own = program.find(Kind::motor_variable, proposal.label) != nullptr ||
                            program.find(Kind::set_point, proposal.label) != nullptr;
        return is_own ? 1 : 3;
    };
    std::stable_sort(result.list.begin(), result.list.end(),
                     [&](const Proposal& a, const Proposal& b) { return rank(a) < rank(b); });
    return result;
}

std::string documentation_of(std::string_view word) {
    std::string text;
    for (const Paragraph& passage : passages_about(word)) {
        if (passage.section.ends_with("Grammar") || text.size() > 1'200) break;
        text += fmt::format("{}\n\n", shown(passage));
    }
    return text;
}

std::vector<Signature> signatures_at(const Program& program, std::uint32_t offset) {
    const auto& tokens = program.tokens();
    std::size_t at = 0;
    while (at < tokens.size() && tokens[at].kind != TokenKind::end && tokens[at].span.offset < offset) ++at;
    std::size_t commas = 0;
    for (; at > 1; --at) {
        const Token& token = tokens[at - 1];
        if (token.text == ",") ++commas;
        if (token.text == ";" || token.text == ")" || same_name(token.text, "THEN")) return {};
        if (token.text != "(") continue;
        const std::string name = upper(tokens[at - 2].text);
        Signature signature;
        signature.documentation = documentation_of(name);
        signature.active = commas;
        if (mode_named(name)) {
            signature.parameters = {"P", "V", "A", "T", "L", "Z"};
            if (name != "POSITION") signature.parameters.erase(signature.parameters.begin());
            signature.label = fmt::format("{}({})", name, fmt::join(signature.parameters, ", "));
            signature.documentation =
                "Registers to select, one of a kind: names of VAR_MOTOR, or P1..P8, V1..V8, "
                "A1..A4, T1..T4, L1..L4, Z1..Z4.\n\n" +
                signature.documentation;
        } else if (name == "USE_SET") {
            signature.parameters = {"1..4"};
            signature.label = "USE_SET(1..4)";
        } else if (name == "REG") {
            signature.parameters = {"1..127"};
            signature.label = "REG(1..127)";
        } else {
            return {};
        }
        signature.active = std::min(commas, signature.parameters.size() - 1);
        return {signature};
    }
    return {};
}

}  // namespace nplc::seqc::analysis
