#include "sequencer/term.h"

#include "base/bytes.h"

namespace nplc::sequencer {
namespace {

constexpr std::uint8_t bit(bool value, int position) {
    return static_cast<std::uint8_t>(value ? 1U << position : 0U);
}

constexpr std::uint8_t low_bits(std::uint8_t value, std::uint8_t mask) {
    return static_cast<std::uint8_t>(value & mask);
}

FastStatement decode_fast(TermView b) {
    return {
        .next_step = low_bits(b[3], 0x3F),
        .presets_counter = (b[3] & 0x40) != 0,
        .sends = (b[4] & 0x80) == 0,
        .command = low_bits(b[4], 0x7F),
        .outputs = low_bits(b[5], 0x0F),
        .clears_counter = (b[5] & 0x40) != 0,
        .counts_down = (b[5] & 0x80) != 0,
        .preset = base::load_u16(&b[6]),
        .available_next_bit7 = (b[3] & 0x80) != 0,
        .available_outputs = low_bits(static_cast<std::uint8_t>(b[5] >> 4), 0x03),
    };
}

FlexStatement decode_flex(TermView b) {
    return {
        .reg = low_bits(b[3], 0x7F),
        .longword = (b[3] & 0x80) != 0,
        .low_word = base::load_u16(&b[4]),
        .high_word = base::load_u16(&b[6]),
    };
}

void encode_fast(const FastStatement& s, TermBytes& b) {
    b[3] = static_cast<std::uint8_t>(low_bits(s.next_step, 0x3F) | bit(s.presets_counter, 6) |
                                     bit(s.available_next_bit7, 7));
    b[4] = static_cast<std::uint8_t>(low_bits(s.command, 0x7F) | bit(!s.sends, 7));
    b[5] = static_cast<std::uint8_t>(low_bits(s.outputs, 0x0F) | (low_bits(s.available_outputs, 0x03) << 4) |
                                     bit(s.clears_counter, 6) | bit(s.counts_down, 7));
    base::store_u16(&b[6], s.preset);
}

void encode_flex(const FlexStatement& s, TermBytes& b) {
    b[3] = static_cast<std::uint8_t>(low_bits(s.reg, 0x7F) | bit(s.longword, 7));
    base::store_u16(&b[4], s.low_word);
    base::store_u16(&b[6], s.high_word);
}

}  // namespace

Term decode(TermView bytes) {
    Term term;
    term.condition = {
        .step = low_bits(bytes[0], 0x3F),
        .needs_counter_zero = (bytes[0] & 0x40) == 0,
        .needs_timer_zero = (bytes[0] & 0x80) == 0,
        .input = bytes[1],
        .care = low_bits(bytes[2], 0x7F),
    };
    term.is_flex = (bytes[2] & 0x80) != 0;
    if (term.is_flex) {
        term.flex = decode_flex(bytes);
    } else {
        term.fast = decode_fast(bytes);
    }
    return term;
}

TermBytes encode(const Term& term) {
    const Condition& c = term.condition;
    TermBytes bytes{};
    bytes[0] = static_cast<std::uint8_t>(low_bits(c.step, 0x3F) | bit(!c.needs_counter_zero, 6) |
                                         bit(!c.needs_timer_zero, 7));
    bytes[1] = c.input;
    bytes[2] = static_cast<std::uint8_t>(low_bits(c.care, 0x7F) | bit(term.is_flex, 7));
    if (term.is_flex) {
        encode_flex(term.flex, bytes);
    } else {
        encode_fast(term.fast, bytes);
    }
    return bytes;
}

}  // namespace nplc::sequencer
