#include "compiler/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "language/names.h"
#include "language/parser.h"
#include "seqc/properties.h"

namespace nplc::seqc {
namespace {

using ast::Claim;
using ast::Expression;
using verify::Condition;
using Kind = verify::Condition::Kind;
using TestKind = ast::Expression::Kind;

constexpr std::string_view kWhatIsTested =
    "a property tests inputs, outputs, INPOS, ERROR, TIMER.Q, COUNTER.Q, moving and STEP = Name";
constexpr std::size_t kInputs = 6;
constexpr std::size_t kOutputs = 4;
constexpr std::size_t kInPosBit = 6;
constexpr std::size_t kErrorBit = 7;

Condition leaf(Kind kind, std::size_t number = 0) {
    return {.kind = kind, .number = static_cast<std::uint8_t>(number), .operands = {}};
}

Condition joined(Kind kind, std::vector<Condition> operands) {
    return {.kind = kind, .number = 0, .operands = std::move(operands)};
}

Condition negated(Condition operand) {
    return joined(Kind::negation, {std::move(operand)});
}

template <class Names>
std::optional<std::size_t> place_of(const Names& names, std::string_view text) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (!names[i].empty() && same_name(names[i], text)) return i;
    }
    return std::nullopt;
}

/// IN0, %QX0.1 and the like.
std::optional<std::size_t> numbered(std::string_view text, std::string_view prefix, std::size_t count) {
    if (text.size() != prefix.size() + 1 || !same_name(text.substr(0, prefix.size()), prefix))
        return std::nullopt;
    const auto number = static_cast<std::size_t>(text.back() - '0');
    return number < count ? std::optional(number) : std::nullopt;
}

template <class List>
bool declares(const List& list, std::string_view text) {
    return std::any_of(list.begin(), list.end(),
                       [&](const auto& item) { return same_name(item.name.text, text); });
}

verify::Form form_of(Claim::Form form) {
    switch (form) {
        case Claim::Form::always:
            return verify::Form::always;
        case Claim::Form::always_possible:
            return verify::Form::always_possible;
        case Claim::Form::after_possible:
            return verify::Form::after_possible;
        case Claim::Form::whenever:
            return verify::Form::whenever;
        case Claim::Form::never_while:
        case Claim::Form::whenever_for:
            return verify::Form::never_while;
        case Claim::Form::followed_by:
            return verify::Form::followed_by;
        case Claim::Form::stays_on:
        case Claim::Form::stays_off:
            return verify::Form::stays;
        case Claim::Form::scan_ends:
            return verify::Form::scan_ends;
        case Claim::Form::only_from:
            return verify::Form::only_from;
        case Claim::Form::only_after:
            return verify::Form::only_after;
        case Claim::Form::only_after_both:
            return verify::Form::only_after_both;
        case Claim::Form::changes_only_in:
            return verify::Form::changes_only_in;
        case Claim::Form::reachable:
            return verify::Form::reachable;
        case Claim::Form::never:
        case Claim::Form::assume_never:
        case Claim::Form::assume_stable:
        case Claim::Form::assume_move_ends:
            break;
    }
    return verify::Form::never;
}

class ClaimResolver {
  public:
    /// Without a scope the names of a table are all that is known.
    ClaimResolver(const ast::Program& program, const Symbols& symbols, Scope* scope, bool is_whole,
                  Report& report)
        : program_(program), symbols_(symbols), scope_(scope), is_whole_(is_whole), report_(report) {
        for (const StepGroup& group : symbols.groups) groups_.try_emplace(upper(group.name), &group);
    }

    Claims resolve() {
        Claims result;
        for (const Claim& claim : program_.claims) {
            if (claim.is_assumed()) {
                result.assumptions.push_back(assumption_of(claim));
            } else {
                check_name(claim.name);
                result.properties.push_back(property_of(claim));
            }
        }
        return result;
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

    verify::Property property_of(const Claim& claim) {
        verify::Property property;
        property.name = claim.name.text;
        property.form = form_of(claim.form);
        if (claim.time)
            property.within_ms = time_of(*claim.time, claim.form == Claim::Form::whenever ? 0 : 1);
        property.text = text_of(claim, property.within_ms);
        std::vector<Condition> parts;
        for (const Expression& condition : claim.conditions) parts.push_back(condition_of(condition));
        parts.resize(3);
        if (claim.form == Claim::Form::after_possible) std::swap(parts[0], parts[1]);
        if (claim.form == Claim::Form::stays_off) parts[2] = negated(std::move(parts[2]));
        if (claim.form == Claim::Form::whenever_for)
            parts = {negated(std::move(parts[1])), std::move(parts[0]), {}};
        if (claim.form == Claim::Form::whenever && !claim.time) {
            property.form = verify::Form::never;
            property.is_implied = true;
            parts[0] = joined(Kind::all_of, {std::move(parts[0]), negated(std::move(parts[1]))});
            parts[1] = {};
        }
        property.condition = std::move(parts[0]);
        property.then = std::move(parts[1]);
        property.third = std::move(parts[2]);
        return property;
    }

    verify::Assumption assumption_of(const Claim& claim) {
        verify::Assumption assumption;
        const std::uint32_t time = claim.time ? time_of(*claim.time, 1) : 0;
        assumption.text = text_of(claim, time);
        const Expression& written = claim.conditions.front();
        const Condition condition = condition_of(written);
        if (claim.form == Claim::Form::assume_never) {
            check_never(written);
            assumption.never = condition;
            return assumption;
        }
        const bool is_known = written.kind != TestKind::name || signal_of(written.name.text).has_value();
        if (claim.form == Claim::Form::assume_move_ends) {
            if (is_known && condition.kind != Kind::moving)
                report_.add("E023", written.span, "it can be assumed of moving alone that it ENDS",
                            "write ASSUME moving ENDS WITHIN 2 s;");
            assumption.move_ms = time;
            return assumption;
        }
        const Condition& wire = wire_of(condition);
        const bool is_input =
            written.kind == TestKind::name && wire.kind == Kind::image && wire.number < kInputs;
        if (is_known && !is_input)
            report_.add("E023", written.span, "it can be assumed of an input alone that it is STABLE",
                        "write ASSUME Start STABLE FOR 50 ms;");
        assumption.input = wire.number;
        assumption.stable_ms = time;
        return assumption;
    }

    /// What a name's condition reads: of an inverted input its wire.
    static const Condition& wire_of(const Condition& named) {
        return named.kind == Kind::negation ? named.operands.front() : named;
    }

    /// Blanks made single, a named time as its value.
    static std::string text_of(const Claim& claim, std::uint32_t milliseconds) {
        const bool is_named = claim.time && claim.time->kind == ast::Value::Kind::name;
        std::string text;
        std::string_view before = "(";
        for (const std::string_view word : claim.words) {
            const bool is_glued = word == ")" || word == "." || before == "(" || before == ".";
            if (!is_glued) text += ' ';
            if (is_named && word.data() == claim.time->name.text.data()) {
                text += fmt::format("{} ms", milliseconds);
            } else {
                text += word;
            }
            before = word;
        }
        return text;
    }

    Condition condition_of(const Expression& part) {
        switch (part.kind) {
            case TestKind::constant:
                return leaf(Kind::constant, part.value ? 1 : 0);
            case TestKind::any_error:
                return leaf(Kind::constant, 1);
            case TestKind::name:
                return signal(part.name);
            case TestKind::in_pos:
                return leaf(Kind::image, kInPosBit);
            case TestKind::error:
                return leaf(Kind::image, kErrorBit);
            case TestKind::timer_q:
                return leaf(Kind::timer_q);
            case TestKind::counter_q:
                return leaf(Kind::counter_q);
            case TestKind::step:
                return part.value ? group(part.name) : step(part.name);
            case TestKind::negation:
                return negated(condition_of(part.operands.front()));
            case TestKind::all_of:
                return joined(Kind::all_of, conditions_of(part.operands));
            case TestKind::any_of:
                return joined(Kind::any_of, conditions_of(part.operands));
            case TestKind::odd_of:
                return joined(Kind::odd_of, conditions_of(part.operands));
            case TestKind::rising:
            case TestKind::falling:
                break;
        }
        return {};
    }

    std::vector<Condition> conditions_of(const std::vector<Expression>& operands) {
        std::vector<Condition> result;
        for (const Expression& operand : operands) result.push_back(condition_of(operand));
        return result;
    }

    std::optional<Condition> signal_of(std::string_view text) const {
        if (same_name(text, "moving")) return leaf(Kind::moving);
        if (const auto input = place_of(symbols_.inputs, text)) {
            const Condition wire = leaf(Kind::image, *input);
            return is_inverted(symbols_, *input) ? negated(wire) : wire;
        }
        if (const auto output = place_of(symbols_.outputs, text)) return leaf(Kind::output, *output);
        for (const std::string_view prefix : {"IN", "%IX0."}) {
            if (const auto input = numbered(text, prefix, kInputs)) return leaf(Kind::image, *input);
        }
        for (const std::string_view prefix : {"OUT", "%QX0."}) {
            if (const auto output = numbered(text, prefix, kOutputs)) return leaf(Kind::output, *output);
        }
        return std::nullopt;
    }

    /// An input or output with the name `moving`: the property would mean the motor, unnoticed.
    void refuse_signal_named_moving(const ast::Name& name) {
        const bool is_output = place_of(symbols_.outputs, name.text).has_value();
        if (moving_is_told_ || (!is_output && !place_of(symbols_.inputs, name.text))) return;
        moving_is_told_ = true;
        Span span = name.span;
        for (const auto* variables : {&program_.inputs, &program_.outputs}) {
            for (const ast::Variable& variable : *variables) {
                if (same_name(variable.name.text, name.text)) span = variable.name.span;
            }
        }
        report_.add(
            "E011", span,
            fmt::format(
                "in a property '{}' holds while the motor moves: {} of that name cannot be named there",
                name.text, is_output ? "an output" : "an input"),
            "choose another name for it, such as Is_Moving");
    }

    Condition signal(const ast::Name& name) {
        if (same_name(name.text, "moving")) refuse_signal_named_moving(name);
        if (const auto known = signal_of(name.text)) return *known;
        if (report_.full_of_errors()) return {};  // a guess among many names would take long
        const bool is_told = program_.names_missing || declares(program_.inputs, name.text) ||
                             declares(program_.outputs, name.text) ||
                             place_of(program_.faulty_names, name.text);
        if (!is_told)
            report_.add("E021", name.span, fmt::format("there is no input or output '{}'", name.text),
                        help_for_signal(name.text));
        return {};
    }

    std::string help_for_signal(std::string_view text) const {
        if (place_of(symbols_.steps, text)) return fmt::format("it is a step: write STEP = {}", text);
        if (is_group(text)) return fmt::format("it is the name of several steps: write STEP IN {}", text);
        std::vector<std::string_view> names = {"moving", "INPOS", "ERROR", "TRUE", "FALSE"};
        for (const std::string& name : symbols_.inputs) names.push_back(name);
        for (const std::string& name : symbols_.outputs) names.push_back(name);
        const std::string guess = suggestion(text, names);
        return guess.empty() ? std::string(kWhatIsTested) : guess;
    }

    const StepGroup* group_named(std::string_view text) const {
        const auto found = groups_.find(upper(text));
        return found == groups_.end() ? nullptr : found->second;
    }

    bool is_group(std::string_view text) const {
        return group_named(text) != nullptr || declares(program_.groups, text) ||
               declares(program_.sequences, text);
    }

    /// A group or one step.
    Condition group(const ast::Name& name) {
        const StepGroup* known = group_named(name.text);
        if (known == nullptr && place_of(symbols_.steps, name.text)) return step(name);
        if (known == nullptr && report_.full_of_errors()) return {};
        if (known == nullptr) {
            if (!is_group(name.text) && !program_.steps_missing) refuse_group(name);
            return {};
        }
        return any_of_steps(known->steps);
    }

    static Condition any_of_steps(std::uint64_t steps) {
        std::vector<Condition> one_of;
        for (std::size_t step = 0; step < 63; ++step) {
            if (((steps >> step) & 1U) != 0) one_of.push_back(leaf(Kind::step, step));
        }
        if (one_of.empty()) return leaf(Kind::constant);
        return one_of.size() == 1 ? one_of.front() : joined(Kind::any_of, std::move(one_of));
    }

    void refuse_group(const ast::Name& name) {
        std::vector<std::string_view> names;
        for (const ast::Group& group : program_.groups) names.push_back(group.name.text);
        for (const StepGroup& group : symbols_.groups) names.push_back(group.name);
        const std::string guess = suggestion(name.text, names);
        report_.add("E021", name.span, fmt::format("there is no group '{}'", name.text),
                    guess.empty() ? fmt::format("write GROUP {}: steps; or STEP = Name", name.text) : guess);
    }

    Condition step(const ast::Name& name) {
        const std::string_view text = name.text;
        if (text.find_first_not_of("0123456789") == text.npos) return numbered_step(name);
        if (const auto number = place_of(symbols_.steps, text))
            return any_of_steps(with_copies(symbols_, static_cast<std::uint8_t>(*number)));
        if (report_.full_of_errors()) return leaf(Kind::step);
        const bool is_told = same_name(text, "POWER_UP") || program_.steps_missing ||
                             declares(program_.steps, text) ||
                             (scope_ != nullptr && !is_whole_ && may_be_made(text));
        if (!is_told)
            report_.add("E021", name.span, fmt::format("there is no step '{}'", text), help_for_step(text));
        return leaf(Kind::step);
    }

    Condition numbered_step(const ast::Name& name) {
        const int number = name.text.size() <= 2 ? std::stoi(std::string(name.text)) : 63;
        if (number >= 63)
            report_.add("E021", name.span, fmt::format("there is no step {}", name.text),
                        "steps are named, or have the numbers 0 to 62");
        return leaf(Kind::step, static_cast<std::size_t>(number));
    }

    /// The compiler names its own steps after the steps they belong to.
    bool may_be_made(std::string_view text) const {
        return std::any_of(program_.steps.begin(), program_.steps.end(), [&](const ast::Step& step) {
            return upper(text).starts_with(upper(step.name.text) + "_");
        });
    }

    std::string help_for_step(std::string_view text) const {
        if (is_group(text)) return fmt::format("it is the name of several steps: write STEP IN {}", text);
        if (signal_of(text)) return fmt::format("it is no step: write {} alone", text);
        std::vector<std::string_view> names = {"POWER_UP"};
        for (const std::string& name : symbols_.steps) names.push_back(name);
        const std::string guess = suggestion(text, names);
        return guess.empty() ? "name one of the steps there are" : guess;
    }

    /// The constant that a time's name stands for; reports an unknown one.
    std::optional<ast::Value> worked_out(const ast::Value& time) {
        if (scope_ != nullptr) return scope_->worked_out(time);
        if (time.kind == ast::Value::Kind::literal) return time;
        ast::Value value = time;
        value.kind = ast::Value::Kind::literal;
        value.is_time = true;
        for (const NamedTime& known : symbols_.times) {
            if (!same_name(known.name, time.name.text)) continue;
            value.number = known.milliseconds;
            return value;
        }
        std::vector<std::string_view> names;
        for (const NamedTime& known : symbols_.times) names.push_back(known.name);
        const std::string guess = suggestion(time.name.text, names);
        report_.add("E021", time.span, fmt::format("there is no time '{}'", time.name.text),
                    guess.empty() ? "write 20 ms, 1.5 s or T#1s500ms" : guess);
        return std::nullopt;
    }

    std::uint32_t time_of(const ast::Value& written, double least) {
        const auto time = worked_out(written);
        if (!time) return 0;
        const bool is_ms = time->is_time || same_name(time->unit.text, "ms");
        const bool is_s = same_name(time->unit.text, "s");
        const bool has_unit = is_ms || is_s || same_name(time->unit.text, "min");
        constexpr double kLongestTime = 3'600'000;
        const double milliseconds = time->number * (is_ms ? 1 : is_s ? 1'000 : 60'000);
        const char* wrong = nullptr;
        if (!has_unit)
            wrong = "a property's time has a unit: ms, s or min";
        else if (time->is_raw || milliseconds < 0 || milliseconds > kLongestTime ||
                 milliseconds != std::floor(milliseconds))
            wrong = "a property's time is whole milliseconds up to an hour";
        else if (milliseconds < least)
            wrong = "a property's time is at least 1 ms";
        if (wrong == nullptr) return static_cast<std::uint32_t>(milliseconds);
        report_.add("E062", time->span, wrong, "write 20 ms, 1.5 s or T#1s500ms");
        return 0;
    }

    void check_never(const Expression& part) {
        const auto signal = part.kind == TestKind::name ? signal_of(part.name.text) : std::nullopt;
        const bool is_own = part.kind == TestKind::step || part.kind == TestKind::timer_q ||
                            part.kind == TestKind::counter_q ||
                            (signal && wire_of(*signal).kind != Kind::image);
        if (is_own)
            report_.add("E023", part.span, "what the table does itself cannot be assumed",
                        "name inputs, INPOS and ERROR; of what the table does make a PROPERTY");
        for (const Expression& operand : part.operands) check_never(operand);
    }

    const ast::Program& program_;
    const Symbols& symbols_;
    std::unordered_map<std::string, const StepGroup*> groups_;  ///< by upper-case name
    Scope* scope_;
    bool is_whole_;
    Report& report_;
    std::unordered_map<std::string, Span> names_;
    bool moving_is_told_ = false;
};

PropertyReading reading_of(const ast::Program& tree, const Symbols& symbols, Report& report) {
    PropertyReading reading;
    Claims claims;
    if (!report.has_errors()) claims = resolve_claims(tree, symbols, report);
    const bool is_sound = !report.has_errors();
    reading.diagnostics = report.take();
    if (!is_sound) return reading;
    reading.properties = std::move(claims.properties);
    reading.assumptions = std::move(claims.assumptions);
    for (const Claim& claim : tree.claims) {
        if (!claim.is_assumed()) reading.names.push_back(claim.name.span);
    }
    return reading;
}

}  // namespace

Claims resolve_claims(const ast::Program& program, Scope& scope, bool is_whole, Report& report) {
    return ClaimResolver(program, scope.symbols(), &scope, is_whole, report).resolve();
}

Claims resolve_claims(const ast::Program& claims, const Symbols& symbols, Report& report) {
    return ClaimResolver(claims, symbols, nullptr, true, report).resolve();
}

PropertyReading properties_of(const Sources& program, const Symbols& symbols) {
    Report report;
    const ast::Program tree = Parser(program, report).parse();
    return reading_of(tree, symbols, report);
}

PropertyReading read_properties(std::string_view text, const Symbols& symbols) {
    Report report;
    Parser parser(text, tokens_of(text, report), report);
    const ast::Program tree = parser.parse_claims();
    return reading_of(tree, symbols, report);
}

}  // namespace nplc::seqc
