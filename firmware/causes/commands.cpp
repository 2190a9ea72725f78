#include "causes/commands.h"

#include <fmt/format.h>

#include "causes/texts.h"
#include "registers/details.h"
#include "registers/layout.h"

namespace nplc::causes {

using registers::Model;
using registers::Register;

namespace {

constexpr std::uint32_t kAll = ~std::uint32_t{0};

/// `small` is the bit's name in 001, `large` in 004.
std::int64_t control_bit(Model model, std::string_view small, std::string_view large) {
    return mask(model, registers::CNTRL_BITS, model == Model::mac800 ? large : small);
}

}  // namespace

std::int64_t mask(Model model, std::uint8_t number, std::string_view bit) {
    const registers::Field* field = registers::field_of(model, number, bit);
    return field != nullptr ? static_cast<std::int64_t>(registers::mask_of(*field)) : 0;
}

std::uint32_t setting_bits(Model model, const Register& reg) {
    const bool large = model == Model::mac800;
    if (reg.number == registers::ERR_STAT) return registers::settings_of_err_stat(model);
    if (reg.number == registers::CNTRL_BITS) return large ? kAll & ~0b100'0011U : 0b1'1011'0011'1111U;
    if (reg.number == registers::HOME_MODE && large) return 0xFFFF;
    return kAll;
}

std::string clear_errors_command(Model model, std::int64_t err_stat) {
    const Register& reg = *registers::find(model, registers::ERR_STAT);
    return "macreg set ERR_STAT " + bits_word(reg, model, err_stat & setting_bits(model, reg));
}

std::string control_command(Model model, std::int64_t now, std::int64_t set, std::int64_t clear) {
    const Register& reg = *registers::find(model, registers::CNTRL_BITS);
    const std::int64_t settings = now & setting_bits(model, reg);
    return "macreg set CNTRL_BITS " + bits_word(reg, model, (settings & ~clear) | set);
}

std::string resynchronise_command(Model model, std::int64_t control_bits, std::int64_t p_ist) {
    const std::string bits =
        control_command(model, control_bits, control_bit(model, "MAN_RESYNC", "SYNCPOSMAN"),
                        control_bit(model, "REL_RESYNC", "SYNCPOSREL"));
    return fmt::format("macreg set P_NEW {} {}", p_ist, bits.substr(std::string_view("macreg set ").size()));
}

std::uint32_t error_bits(Model model) {
    return model == Model::mac800 ? 0x2BB8F : 0x108F;
}

}  // namespace nplc::causes
