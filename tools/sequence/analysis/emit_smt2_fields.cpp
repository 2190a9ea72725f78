#include "emit_smt2_fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>

namespace nplc::verify::smt2 {
namespace {

std::string listed(const Names& names) {
    return fmt::format("{}", fmt::join(names, " "));
}

std::string joined(const char* sign, const Names& parts) {
    std::string text = parts[0];
    for (std::size_t i = 1; i < parts.size(); ++i) text = fmt::format("({} {} {})", sign, text, parts[i]);
    return text;
}

/// Of an image and a state: that after a scan (`there`) or at its beginning.
class Conditions {
  public:
    Conditions(const Fields& fields, bool there) : fields_(fields), there_(there) {}

    std::string text(const Condition& condition) const {
        using Is = Condition::Kind;
        const unsigned number = condition.number;
        switch (condition.kind) {
            case Is::constant:
                return number != 0 ? "true" : "false";
            case Is::image:
                return fmt::format("(= ((_ extract {0} {0}) i) #b1)", number);
            case Is::output:
                return fmt::format("(= ((_ extract {0} {0}) {1}) #b1)", number, name(fields_.outputs));
            case Is::timer_q:
                return is_zero(fields_.timer);
            case Is::counter_q:
                return is_zero(fields_.counter);
            case Is::step:
                return fmt::format("(= {} {})", name(fields_.step), bits(number, 6));
            case Is::moving:
                return moves();
            case Is::negation:
                return fmt::format("(not {})", text(condition.operands[0]));
            case Is::all_of:
                return joined("and", texts(condition));
            case Is::any_of:
                return joined("or", texts(condition));
            case Is::odd_of:
                return joined("xor", texts(condition));
        }
        return {};
    }

  private:
    std::string name(const Field& field) const { return there_ ? field.there : field.here; }
    std::string is_zero(const Field& field) const {
        return fmt::format("(= {} {})", name(field), bits(0, field.width));
    }
    std::string moves() const {
        std::string text = "(or";
        for (std::uint8_t motion = 0; motion < kMotions; ++motion) {
            if (is_moving(static_cast<Motion>(motion)))
                text += fmt::format(" (= {} {})", name(fields_.motion), bits(motion, fields_.motion.width));
        }
        return text + ")";
    }
    Names texts(const Condition& condition) const {
        Names texts;
        for (const Condition& operand : condition.operands) texts.push_back(text(operand));
        return texts;
    }

    const Fields& fields_;
    bool there_;
};

}  // namespace

std::string bits(std::uint32_t value, unsigned width) {
    return fmt::format("#b{:0{}b}", value, width);
}

std::string bit(bool value) {
    return value ? "#b1" : "#b0";
}

Fields::Fields(const Question& question)
    : tells_motion(question.tells_motion), times_moves(question.move_ms != 0) {
    counter.width = std::max(1U, static_cast<unsigned>(std::bit_width(question.greatest_counter)));
    if (!times_moves) return;
    timer.width = std::max(1U, static_cast<unsigned>(std::bit_width(question.greatest_timer)));
    moved.width = static_cast<unsigned>(std::bit_width(question.move_ms + 1));
}

std::vector<Field> Fields::all() const {
    std::vector<Field> fields = {step, outputs, timer, counter};
    if (tells_motion) fields.push_back(motion);
    if (times_moves) fields.push_back(moved);
    return fields;
}

std::string Fields::sorts() const {
    Names sorts;
    for (const Field& field : all()) sorts.push_back(fmt::format("(_ BitVec {})", field.width));
    return listed(sorts);
}

std::string Fields::at_power_up() const {
    Names values;
    for (const Field& field : all()) values.push_back(field.at_power_up());
    return listed(values);
}

std::string Fields::here() const {
    Names names;
    for (const Field& field : all()) names.push_back(field.here);
    return listed(names);
}

std::string Fields::there() const {
    Names names;
    for (const Field& field : all()) names.push_back(field.there);
    return listed(names);
}

std::string condition_clause(const Condition& condition, const Fields& fields, bool there) {
    return Conditions(fields, there).text(condition);
}

std::string formula_clause(const Formula& formula, const Fields& fields) {
    using Of = Formula::Kind;
    Names parts;
    for (const Formula& part : formula.parts) parts.push_back(formula_clause(part, fields));
    switch (formula.kind) {
        case Of::ended:
            return condition_clause(*formula.condition, fields, true);
        case Of::began:
            return condition_clause(*formula.condition, fields, false);
        case Of::first:
            return "(= k #b1)";
        case Of::second:
            return "(= l #b1)";
        case Of::negation:
            return fmt::format("(not {})", parts[0]);
        case Of::all_of:
            return joined("and", parts);
        case Of::any_of:
            return joined("or", parts);
        case Of::odd_of:
            return joined("xor", parts);
        case Of::held:  // not used here
            break;
    }
    return {};
}

}  // namespace nplc::verify::smt2
