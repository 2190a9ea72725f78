#include "table/terms.h"

#include <fmt/format.h>

#include <algorithm>

#include "sequencer/state.h"

namespace nplc::table {

using sequencer::Term;
using sequencer::TermView;

std::vector<Compared> compared_by(TermView term) {
    const sequencer::Condition condition = sequencer::decode(term).condition;
    const auto level = [&](unsigned bit) { return ((condition.input >> bit) & 1U) != 0; };
    std::vector<Compared> compared;
    for (unsigned bit = 0; bit <= kInPosBit; ++bit) {
        if (((condition.care >> bit) & 1U) != 0) compared.push_back({bit, level(bit)});
    }
    if (condition.needs_timer_zero) compared.push_back({kTimerZero, true});
    if (condition.needs_counter_zero) compared.push_back({kCounterZero, true});
    compared.push_back({kErrorBit, level(kErrorBit)});
    return compared;
}

TermFault fault_of(TermView bytes) {
    const Term term = sequencer::decode(bytes);
    if (term.is_flex) return term.flex.reg == 0 ? TermFault::register_0 : TermFault::none;
    return term.fast.next_step == sequencer::kEndOfTable ? TermFault::next_is_63 : TermFault::none;
}

Oddity oddity_of(TermView bytes) {
    const Term term = sequencer::decode(bytes);
    const unsigned wanted = term.condition.input & ~unsigned{sequencer::kError};
    if (term.condition.step >= sequencer::kLastStep) return Oddity::of_step_62;
    if ((wanted & ~unsigned{term.condition.care}) != 0) return Oddity::level_without_care;
    if (term.is_flex) {
        if (fault_of(bytes) == TermFault::register_0) return Oddity::register_0;
        return !term.flex.longword && term.flex.high_word != 0 ? Oddity::upper_word_not_sent : Oddity::none;
    }
    if (fault_of(bytes) == TermFault::next_is_63) return Oddity::next_is_63;
    if (term.fast.available_next_bit7 || term.fast.available_outputs != 0) return Oddity::unused_bits;
    if (!term.fast.sends && term.fast.command != 0) return Oddity::command_not_sent;
    return term.fast.presets_counter && term.fast.preset == 0 ? Oddity::counter_preset_of_0 : Oddity::none;
}

ValuePlace value_place(TermView bytes) {
    const Term term = sequencer::decode(bytes);
    if (term.is_flex) return {ValuePlace::Kind::reg, term.flex.reg};
    return {term.fast.presets_counter ? ValuePlace::Kind::counter : ValuePlace::Kind::timer};
}

std::uint32_t value_of(TermView bytes) {
    return sequencer::is_flex(bytes) ? sequencer::order_of(bytes).value
                                     : sequencer::decode(bytes).fast.preset;
}

void set_value(std::span<std::uint8_t, sequencer::kTermBytes> bytes, std::uint32_t value) {
    Term term = sequencer::decode(bytes);
    if (term.is_flex) {
        term.flex.low_word = static_cast<std::uint16_t>(value);
        if (term.flex.longword) term.flex.high_word = static_cast<std::uint16_t>(value >> 16U);
    } else {
        term.fast.preset = static_cast<std::uint16_t>(value);
    }
    const sequencer::TermBytes encoded = sequencer::encode(term);
    std::copy(encoded.begin(), encoded.end(), bytes.begin());
}

std::string hex(TermView term) {
    std::string text;
    for (const std::uint8_t byte : term) text += fmt::format("{:02X} ", byte);
    return text;
}

}  // namespace nplc::table
