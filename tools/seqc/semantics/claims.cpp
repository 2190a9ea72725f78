#include "semantics/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>
#include <vector>

#include "syntax/names.h"

namespace nplc::seqc {
namespace {

using ast::Claim;
using ast::Expression;
using TestKind = ast::Expression::Kind;

enum class Signal : std::uint8_t { none, input, output, moving };

constexpr std::string_view kWhatIsTested =
    "a property tests inputs, outputs, INPOS, ERROR, TIMER.Q, COUNTER.Q, moving and STEP = Name";

/// IN0, %QX0.1 and the like.
bool is_address(std::string_view text, std::string_view prefix, char last) {
    return text.size() == prefix.size() + 1 && same_name(text.substr(0, prefix.size()), prefix) &&
           text.back() >= '0' && text.back() <= last;
}

template <class Names>
bool has_name(const Names& names, std::string_view text) {
    return std::any_of(names.begin(), names.end(),
                       [&](const auto& name) { return !name.empty() && same_name(name, text); });
}

template <class List>
bool declares(const List& list, std::string_view text) {
    return std::any_of(list.begin(), list.end(),
                       [&](const auto& item) { return same_name(item.name.text, text); });
}

class ClaimCheck {
  public:
    ClaimCheck(const ast::Program& program, Scope& scope, bool is_whole, Report& report)
        : program_(program), scope_(scope), symbols_(scope.symbols()), is_whole_(is_whole), report_(report) {}

    void run() {
        for (const Claim& claim : program_.claims) {
            if (claim.kind == Claim::Kind::property) check_name(claim.name);
            for (const Expression& condition : claim.conditions) check_names(condition);
            for (const ast::Value& time : claim.times) {
                if (const auto value = scope_.worked_out(time)) check_time(*value, claim);
            }
            check_assumed(claim);
        }
    }

  private:
    void check_name(const ast::Name& name) {
        const auto [earlier, is_new] = names_.try_emplace(upper(name.text), name.span);
        if (is_new) return;
        report_
            .add("E020", name.span, fmt::format("property '{}' stands twice", name.text),
                 "give one of them another name")
            .notes.push_back({earlier->second, "the first one is here"});
    }

    void check_names(const Expression& part) {
        if (part.kind == TestKind::name) check_signal(part.name);
        if (part.kind == TestKind::step && part.value) check_group(part.name);
        if (part.kind == TestKind::step && !part.value) check_step(part.name);
        for (const Expression& operand : part.operands) check_names(operand);
    }

    Signal signal_of(std::string_view text) const {
        if (same_name(text, "moving")) return Signal::moving;
        if (has_name(symbols_.inputs, text) || is_address(text, "IN", '5') || is_address(text, "%IX0.", '5'))
            return Signal::input;
        if (has_name(symbols_.outputs, text) || is_address(text, "OUT", '3') ||
            is_address(text, "%QX0.", '3'))
            return Signal::output;
        return Signal::none;
    }

    void check_signal(const ast::Name& name) {
        if (signal_of(name.text) != Signal::none || program_.names_missing) return;
        const bool is_told = declares(program_.inputs, name.text) || declares(program_.outputs, name.text);
        if (is_told || has_name(program_.faulty_names, name.text)) return;
        report_.add("E021", name.span, fmt::format("there is no input or output '{}'", name.text),
                    help_for_signal(name.text));
    }

    std::string help_for_signal(std::string_view text) const {
        if (has_name(symbols_.steps, text)) return fmt::format("it is a step: write STEP = {}", text);
        std::vector<std::string_view> names = {"moving", "INPOS", "ERROR", "TRUE", "FALSE"};
        for (const std::string& name : symbols_.inputs) names.push_back(name);
        for (const std::string& name : symbols_.outputs) names.push_back(name);
        const std::string guess = suggestion(text, names);
        return guess.empty() ? std::string(kWhatIsTested) : guess;
    }

    void check_group(const ast::Name& name) {
        if (declares(program_.groups, name.text) || declares(program_.sequences, name.text) ||
            has_name(symbols_.steps, name.text) || program_.steps_missing)
            return;
        std::vector<std::string_view> names;
        for (const ast::Group& group : program_.groups) names.push_back(group.name.text);
        const std::string guess = suggestion(name.text, names);
        report_.add("E021", name.span, fmt::format("there is no group '{}'", name.text),
                    guess.empty() ? fmt::format("write GROUP {}: steps; or STEP = Name", name.text) : guess);
    }

    void check_step(const ast::Name& name) {
        const std::string_view text = name.text;
        if (text.find_first_not_of("0123456789") == text.npos) return check_step_number(name);
        if (same_name(text, "POWER_UP") || has_name(symbols_.steps, text)) return;
        if (program_.steps_missing || declares(program_.steps, text) || (!is_whole_ && may_be_made(text)))
            return;
        report_.add("E021", name.span, fmt::format("there is no step '{}'", text), help_for_step(text));
    }

    void check_step_number(const ast::Name& name) {
        const bool fits = name.text.size() <= 2 && std::stoi(std::string(name.text)) < 63;
        if (!fits)
            report_.add("E021", name.span, fmt::format("there is no step {}", name.text),
                        "steps are named, or have the numbers 0 to 62");
    }

    /// The compiler names its own steps after the steps they belong to.
    bool may_be_made(std::string_view text) const {
        return std::any_of(program_.steps.begin(), program_.steps.end(), [&](const ast::Step& step) {
            return upper(text).starts_with(upper(step.name.text) + "_");
        });
    }

    std::string help_for_step(std::string_view text) const {
        if (declares(program_.groups, text) || declares(program_.sequences, text))
            return fmt::format("it is the name of several steps: write STEP IN {}", text);
        if (signal_of(text) != Signal::none) return fmt::format("it is no step: write {} alone", text);
        std::vector<std::string_view> names = {"POWER_UP"};
        for (const std::string& name : symbols_.steps) names.push_back(name);
        const std::string guess = suggestion(text, names);
        return guess.empty() ? "name one of the steps there are" : guess;
    }

    void check_time(const ast::Value& time, const Claim& claim) {
        const bool has_unit = time.is_time || same_name(time.unit.text, "ms") ||
                              same_name(time.unit.text, "s") || same_name(time.unit.text, "min");
        const double unit = time.is_time || same_name(time.unit.text, "ms") ? 1
                            : same_name(time.unit.text, "s")                ? 1'000
                                                                            : 60'000;
        constexpr double kLongestTime = 3'600'000;
        const double milliseconds = time.number * unit;
        const char* wrong = nullptr;
        if (!has_unit)
            wrong = "a property's time has a unit: ms, s or min";
        else if (time.is_raw || milliseconds < 0 || milliseconds > kLongestTime ||
                 milliseconds != std::floor(milliseconds))
            wrong = "a property's time is whole milliseconds up to an hour";
        else if (milliseconds == 0 && !claim.time_may_be_zero)
            wrong = "a property's time is 1 ms at the least";
        if (wrong != nullptr) report_.add("E062", time.span, wrong, "write 20 ms, 1.5 s or T#1s500ms");
    }

    void check_assumed(const Claim& claim) {
        if (claim.kind == Claim::Kind::property || claim.conditions.empty()) return;
        const Expression& condition = claim.conditions.front();
        if (claim.kind == Claim::Kind::never) return check_never(condition);
        const bool is_name = condition.kind == TestKind::name;
        const Signal signal = is_name ? signal_of(condition.name.text) : Signal::none;
        if (is_name && signal == Signal::none) return;  // already reported
        if (claim.kind == Claim::Kind::ends && signal != Signal::moving)
            report_.add("E023", condition.span, "it can be assumed of moving alone that it ENDS",
                        "write ASSUME moving ENDS WITHIN 2 s;");
        if (claim.kind == Claim::Kind::stable && signal != Signal::input)
            report_.add("E023", condition.span, "it can be assumed of an input alone that it is STABLE",
                        "write ASSUME Start STABLE FOR 50 ms;");
    }

    void check_never(const Expression& part) {
        const bool is_own = part.kind == TestKind::step || part.kind == TestKind::timer_q ||
                            part.kind == TestKind::counter_q ||
                            (part.kind == TestKind::name && (signal_of(part.name.text) == Signal::output ||
                                                             signal_of(part.name.text) == Signal::moving));
        if (is_own)
            report_.add("E023", part.span, "what the table does itself cannot be assumed",
                        "name inputs, INPOS and ERROR; of what the table does make a PROPERTY");
        for (const Expression& operand : part.operands) check_never(operand);
    }

    const ast::Program& program_;
    Scope& scope_;
    const Symbols& symbols_;
    bool is_whole_;
    Report& report_;
    std::unordered_map<std::string, Span> names_;
};

}  // namespace

void check_claims(const ast::Program& program, Scope& scope, bool is_whole, Report& report) {
    ClaimCheck(program, scope, is_whole, report).run();
}

}  // namespace nplc::seqc
