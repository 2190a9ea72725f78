#include "sequencer/state.h"

#include "base/bytes.h"

namespace nplc::sequencer {

MotorOrder order_of(TermView term) {
    if (!is_flex(term)) return {.command = static_cast<std::uint8_t>(term[4] & 0x7F)};
    const bool longword = (term[3] & 0x80) != 0;
    return {
        .is_register_write = true,
        .reg = static_cast<std::uint8_t>(term[3] & 0x7F),
        .longword = longword,
        .value = longword ? base::load_u32(&term[4]) : base::load_u16(&term[4]),
    };
}

}  // namespace nplc::sequencer
