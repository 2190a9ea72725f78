#include "emit_question.h"

#include "table/step.h"

namespace nplc::verify {
namespace {

Formula ended(const Condition& condition) {
    return {Formula::Kind::ended, &condition, {}};
}
Formula began(const Condition& condition) {
    return {Formula::Kind::began, &condition, {}};
}

void name_bits(const Property& property, Question& question) {
    for (const Condition* condition : {&property.condition, &property.then, &property.third}) {
        question.named |= image_bits_of(*condition);
        if (names_moving(*condition)) question.tells_motion = true;
    }
}

}  // namespace

Watch watch_of(const Property& property) {
    const Formula c = ended(property.condition);
    const Formula d = ended(property.then);
    const Formula e = ended(property.third);
    const Formula first{Formula::Kind::first, nullptr, {}};
    const Formula second{Formula::Kind::second, nullptr, {}};
    switch (property.form) {
        case Form::never:
        case Form::reachable:
        case Form::always_possible:
            return {.bad = c};
        case Form::after_possible:
            return {.bad = c};
        case Form::always:
            return {.bad = !c};
        case Form::whenever:
            return {.bad = c && !d};
        case Form::never_while:
            return {.bad = c && d && Formula{Formula::Kind::held, nullptr, {}}, .lasts = &property.then};
        case Form::only_after:
            return {.bad = c && !d && !first, .first = first || d, .second = second, .remembers = true};
        case Form::only_from: {
            const Formula from = began(property.then);
            return {.bad = c && !from && !first, .first = first || from, .second = second, .remembers = true};
        }
        case Form::only_after_both: {
            const Formula both = first || (second && e);
            return {.bad = c && !both, .first = both, .second = d, .remembers = true};
        }
        case Form::stays: {
            const Formula within = (first || c) && !d;
            return {.bad = within && !e, .first = within, .second = second, .remembers = true};
        }
        case Form::changes_only_in:
            return {.bad = (c ^ first) && !d && !second,
                    .first = c,
                    .second = d,
                    .remembers = true,
                    .first_at_power_up = holds(property.condition, 0, {}),
                    .second_at_power_up = holds(property.then, 0, {})};
        case Form::scan_ends:
            return {
                .bad = began(property.condition) && !d, .first = first, .second = second, .remembers = true};
        case Form::followed_by:
            return {.bad = first && d && !e, .first = c, .second = second, .remembers = true};
    }
    return {};
}

Question::Question(std::span<const std::uint8_t> table, const std::vector<Property>& asked,
                   const std::vector<Assumption>& assumed, bool with_holds)
    : properties(asked), assumptions(assumed) {
    for (const Property& property : properties) {
        const bool is_hold = property.form == Form::never_while;
        if (is_hold && !with_holds) continue;
        name_bits(property, *this);
        if (is_hold) longest_hold = std::max(longest_hold, property.within_ms);
    }
    used = named;
    for (const Assumption& assumption : assumptions) {
        used |= image_bits_of(assumption.never);
        if (assumption.move_ms != 0 && (move_ms == 0 || assumption.move_ms < move_ms))
            move_ms = assumption.move_ms;
    }
    if (move_ms != 0) tells_motion = true;
    if (tells_motion) used |= 0xC0U;
    for (const sequencer::TermView bytes : table::terms_of(table)) {
        QuestionTerm& one = terms.emplace_back();
        one.term = sequencer::decode(bytes);
        if (sequencer::has_order(bytes)) one.order = sequencer::order_of(bytes);
        used |= one.term.condition.care | unsigned{sequencer::kError};
        if (one.term.is_flex) continue;
        unsigned& greatest = one.term.fast.presets_counter ? greatest_counter : greatest_timer;
        greatest = std::max<unsigned>(greatest, one.term.fast.preset);
    }
}

}  // namespace nplc::verify
