#include "compiler/drive.h"

#include <fmt/format.h>

namespace nplc::seqc {

registers::Refusal refusal_of(const registers::DriveModel& drive, const Send& send) {
    if (send.reg == nullptr) return drive.family->refuses_command(drive, send.command);
    return drive.family->refuses_write(drive, send.reg->number, registers::is_32_bit(send.reg->format),
                                       send.value);
}

registers::Refusal refusal_of(const registers::DriveModel& drive, const sequencer::Term& term) {
    if (term.is_flex)
        return drive.family->refuses_write(drive, term.flex.reg, term.flex.longword,
                                           std::uint32_t{term.flex.high_word} << 16 | term.flex.low_word);
    return term.fast.sends ? drive.family->refuses_command(drive, term.fast.command) : registers::Refusal();
}

std::string text_of(const registers::DriveValue& value) {
    return fmt::format("{}{}{}", value.before, value.number ? std::to_string(*value.number) : "",
                       value.after);
}

}  // namespace nplc::seqc
