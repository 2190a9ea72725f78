#pragma once

#include <cstdint>
#include <span>
#include <vector>

/// The bytes of a table's terms, field by field as 001 §6.1.5 to §6.1.7 name them.
namespace nplc::verify {

struct ManualTerm {
    std::uint8_t state = 0;
    bool timer_must_be_zero = false;
    bool counter_must_be_zero = false;
    std::uint8_t input = 0;
    std::uint8_t compared = 0;  ///< bits of HW_INP: CARE's, and ERROR always
    bool is_flexmac = false;    ///< the rest is of FastMAC format
    std::uint8_t next_state = 0;
    bool names_next = false;
    bool word_is_counter = false;
    std::uint8_t output_byte = 0;
    std::uint16_t word = 0;
};

/// Up to the term whose STATE is 63.
inline std::vector<ManualTerm> manual_terms(std::span<const std::uint8_t> table) {
    std::vector<ManualTerm> terms;
    for (std::size_t at = 0; at + 8 <= table.size() && (table[at] & 0x3FU) != 0x3F; at += 8) {
        const auto b = table.subspan(at, 8);
        ManualTerm& term = terms.emplace_back();
        term.state = b[0] & 0x3F;
        term.counter_must_be_zero = (b[0] & 0x40U) == 0;
        term.timer_must_be_zero = (b[0] & 0x80U) == 0;
        term.compared = static_cast<std::uint8_t>((b[2] & 0x7FU) | 0x80U);
        term.input = b[1] & term.compared;
        term.is_flexmac = (b[2] & 0x80U) != 0;
        term.next_state = b[3] & 0x3F;
        term.names_next = term.next_state != 0x3E;
        term.word_is_counter = (b[3] & 0x40U) != 0;
        term.output_byte = b[5];
        term.word = static_cast<std::uint16_t>(b[6] | (b[7] << 8U));
    }
    return terms;
}

}  // namespace nplc::verify
