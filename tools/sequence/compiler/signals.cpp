#include "compiler/signals.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "language/names.h"

namespace nplc::seqc {
namespace {

constexpr std::size_t kInputs = 6;
constexpr std::size_t kOutputs = 4;

/// I1, DI1, X1, O1, DO1: names of terminals on other controllers.
bool is_terminal_elsewhere(std::string_view name) {
    constexpr auto kTerminals = std::to_array<std::string_view>(
        {"I", "DI", "X", "E", "INPUT", "IN_", "O", "DO", "Q", "Y", "A", "OUTPUT", "OUT_"});
    const std::size_t letters = std::min(name.find_first_of("0123456789"), name.size());
    const bool has_digits_only = name.find_first_not_of("0123456789", letters) == name.npos;
    const std::string word = upper(name.substr(0, letters));
    const bool is_word_alone = letters == name.size();
    return has_digits_only && std::find(kTerminals.begin(), kTerminals.end(), word) != kTerminals.end() &&
           (!is_word_alone || word == "INPUT" || word == "OUTPUT");
}

std::string addresses(char direction, std::size_t count) {
    const std::string_view plain = direction == 'I' ? "IN" : "OUT";
    return fmt::format("%{}X0.0..%{}X0.{} ({}0..{}{})", direction, direction, count - 1, plain, plain,
                       count - 1);
}

std::string how_to_declare(std::string_view name, const std::vector<DeclaredName>& variables, char direction,
                           std::size_t count) {
    const char* block = direction == 'I' ? "VAR_INPUT" : "VAR_OUTPUT";
    for (std::size_t bit = 0; bit < count; ++bit) {
        const bool taken = std::any_of(variables.begin(), variables.end(),
                                       [&](const DeclaredName& v) { return v.bit == bit; });
        if (!taken)
            return fmt::format("declare it under {}: {} AT %{}X0.{} : BOOL;", block, name, direction, bit);
    }
    return fmt::format("name one of those under {}: all {} addresses have a name", block, count);
}

bool is_of_a_motor(std::string_view name) {
    return registers::find(registers::Model::mac140, name) != nullptr ||
           registers::find(registers::Model::mac800, name) != nullptr;
}

/// What a word that other languages have as a condition is here; empty: the word means nothing.
std::string_view help_of_condition(std::string_view name) {
    struct Word {
        std::string_view word;
        std::string_view help;
    };
    constexpr std::string_view kArrived = "INPOS is true when the motor has arrived";
    constexpr std::string_view kTime =
        "TIMER.Q is true when the timer has run out, COUNTER.Q when the counter is 0";
    constexpr std::string_view kNoError =
        "write NOT ERROR, or nothing: a condition without the word ERROR holds without an error alone";
    constexpr std::string_view kStart =
        "what is done once at the beginning stands in POWER_UP .. END_POWER_UP";
    constexpr auto kWords = std::to_array<Word>({
        {"ANY_ERROR", "write ANY ERROR, in two words"},
        {"ANYERROR", "write ANY ERROR, in two words"},
        {"NO_ERROR", kNoError},
        {"NOERROR", kNoError},
        {"NOT_ERROR", kNoError},
        {"FAULT", "write ERROR: it is true while the motor has an error"},
        {"R_TRIG", "write R_TRIG(Start), with the name of the input"},
        {"F_TRIG", "write F_TRIG(Start), with the name of the input"},
        {"DONE", kArrived},
        {"IN_POSITION", kArrived},
        {"INPOSITION", kArrived},
        {"TARGET_REACHED", kArrived},
        {"TIMEOUT", kTime},
        {"TIME_OUT", kTime},
        {"ELAPSED", kTime},
        {"FIRST_SCAN", kStart},
        {"FIRSTSCAN", kStart},
    });
    const auto* const found = std::find_if(kWords.begin(), kWords.end(),
                                           [&](const Word& row) { return same_name(row.word, name); });
    return found == kWords.end() ? std::string_view() : found->help;
}

}  // namespace

void Signals::declare(const ast::Program& program, Symbols& symbols) {
    for (std::size_t i = 0; i < kInputs; ++i) symbols.inputs[i] = fmt::format("IN{}", i);
    for (std::size_t i = 0; i < kOutputs; ++i) symbols.outputs[i] = fmt::format("OUT{}", i);
    declare_all(program.inputs, names_.inputs(), 'I', kInputs);
    declare_all(program.outputs, names_.outputs(), 'Q', kOutputs);
    for (const DeclaredName& v : names_.inputs()) {
        symbols.inputs[v.bit] = v.name;
        if (v.is_inverted) symbols.inverted_inputs |= static_cast<std::uint8_t>(1U << v.bit);
    }
    for (const DeclaredName& v : names_.outputs()) symbols.outputs[v.bit] = v.name;
}

std::optional<InputTest> Signals::input(const ast::Name& name) {
    const auto bit = find(name, names_.inputs(), 'I', kInputs);
    if (!bit) return std::nullopt;
    const DeclaredName* variable = find_name(names_.inputs(), name.text);
    return InputTest{*bit, variable == nullptr || !variable->is_inverted};
}

std::optional<std::size_t> Signals::output(const ast::Name& name) {
    return find(name, names_.outputs(), 'Q', kOutputs);
}

void Signals::declare_all(const std::vector<ast::Variable>& declared, std::vector<DeclaredName>& variables,
                          char direction, std::size_t count) {
    for (const ast::Variable& variable : declared) {
        const auto number = address_number(variable.address.text, direction);
        if (!number || *number >= count) {
            report_.add("E022", variable.address.span,
                        fmt::format("'{}' is not an {}", variable.address.text,
                                    direction == 'I' ? "input" : "output"),
                        fmt::format("there are {}", addresses(direction, count)));
            names_.add_faulty(variable.name.text);
            continue;
        }
        const auto earlier = std::find_if(variables.begin(), variables.end(),
                                          [&](const DeclaredName& v) { return v.bit == *number; });
        if (earlier != variables.end()) {
            report_
                .add("E022", variable.address.span,
                     fmt::format("'{}' has a name already", variable.address.text),
                     fmt::format("use '{}', or another {}", earlier->name,
                                 direction == 'I' ? "input" : "output"))
                .notes.push_back({earlier->span, "declared here"});
            names_.add_faulty(variable.name.text);
        } else if (names_.is_new(variable.name)) {
            const bool is_inverted = variable.inverted.length != 0;
            if (is_inverted && direction == 'Q') {
                report_.add("E022", variable.inverted, "an output is never inverted: it is off at power-up",
                            fmt::format("write {} AT {}, and name it after what it does when it is on",
                                        variable.name.text, variable.address.text));
            }
            variables.push_back(
                {variable.name.text, variable.name.span, *number, nullptr, is_inverted && direction == 'I'});
        }
    }
}

std::optional<std::size_t> Signals::find(const ast::Name& name, const std::vector<DeclaredName>& variables,
                                         char direction, std::size_t count) {
    if (const DeclaredName* variable = find_name(variables, name.text)) return variable->bit;
    const auto number = address_number(name.text, direction);
    if (number && *number < count) return number;
    const bool input = direction == 'I';
    if (number) {
        report_.add("E022", name.span,
                    fmt::format("there is no {} '{}'", input ? "input" : "output", name.text),
                    fmt::format("there are {}", addresses(direction, count)));
        return std::nullopt;
    }
    if (names_.is_faulty(name.text)) return std::nullopt;
    const bool other = input ? names_.is_output(name.text) || address_number(name.text, 'Q').has_value()
                             : names_.is_input(name.text) || address_number(name.text, 'I').has_value();
    std::vector<std::string_view> names;
    names.reserve(variables.size() + 2);
    for (const DeclaredName& variable : variables) names.push_back(variable.name);
    if (input) names.insert(names.end(), {"INPOS", "ERROR", "TRUE", "FALSE"});
    std::string help = suggestion(name.text, names);
    if (help.empty()) help = how_to_declare(name.text, variables, direction, count);
    if (!input && (same_name(name.text, "NONE") || same_name(name.text, "NOTHING")))
        help = "leave OUT out: what no OUT of the step names is off";
    if (const std::string_view known = help_of_condition(name.text); input && !known.empty()) help = known;
    if (input && (names_.find_register(name.text) != nullptr || is_of_a_motor(name.text)))
        help =
            "registers cannot be tested: a move has arrived when INPOS is true; conditions are of inputs, "
            "INPOS, "
            "ERROR, TIMER.Q and COUNTER.Q";
    if (name.text.starts_with('%')) help = fmt::format("there are {}", addresses(direction, count));
    if (input && is_terminal_elsewhere(name.text)) help = "inputs are IN0 to IN5, and the names of VAR_INPUT";
    if (!input && is_terminal_elsewhere(name.text))
        help = "outputs are OUT0 to OUT3, and the names of VAR_OUTPUT";
    if (other) {
        Diagnostic& d = report_.add(
            "E023", name.span, fmt::format("'{}' is an {}", name.text, input ? "output" : "input"),
            input ? "a condition can test inputs, INPOS, ERROR, TIMER.Q and COUNTER.Q" : "OUT takes outputs");
        const DeclaredName* declared = find_name(input ? names_.outputs() : names_.inputs(), name.text);
        if (declared != nullptr) d.notes.push_back({declared->span, "declared here"});
    } else {
        report_.add("E021", name.span,
                    fmt::format("there is no {} '{}'", input ? "input" : "output", name.text), help);
    }
    return std::nullopt;
}

}  // namespace nplc::seqc
