#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "macreg/motor.h"
#include "registers/gateway.h"

/// The change of one register, read back, and the reason if it was not accepted.
namespace nplc::macreg {

struct ChangeResult {
    std::optional<std::int64_t> before{};  ///< unknown for a stop, which is sent before anything is read
    std::int64_t after = 0;
    bool taken = true;
    std::string why{};     ///< a sentence with the remedy, if it was not accepted
    std::string remark{};  ///< a note for the user although it was accepted
};

/// Writes `raw` with the register's exact width and reads it back. A new address (MYADDR) is read back at the
/// new address. A write that a gateway refuses is a result too; a motor that does not answer is a LineError.
/// A stop is written before anything is read, and its LineError says so (kMayMove).
ChangeResult change(Motor& motor, const registers::Register& reg, std::int64_t raw);

/// Whether the value makes the motor passive: INIT_MODE in MODE_REG, on MAC50 to MAC141 STOP_MODE too.
bool is_stop(registers::Model model, const registers::Register& reg, std::int64_t raw);

/// The text in every message about a stop that the motor has not confirmed.
inline constexpr const char* kMayMove = "not confirmed: the motor may be moving";

/// Writes a stop to MODE_REG of a motor that was not read yet, at most `attempts` times; true: it was
/// accepted. Without `model` it is a word, which changes no other register of any model; a MAC800 accepts
/// longwords only and ignores it. Throws LineError if the port is gone.
bool stop_unasked(mactalk_client::Master& master, std::uint8_t address, std::optional<registers::Model> model,
                  std::int64_t raw, unsigned attempts);

/// Why `change` may not give this value to MODE_REG or STARTMODE, with what to do instead; empty: it may. 256
/// to 258 would act on a motor in SAFE_MODE, on its flash (001 §4.4.16).
std::string no_mode(registers::Model model, const registers::Register& reg, std::int64_t raw);

/// "ERR_STAT has FLW_ERR"; empty if none of the errors that keep the motor in INIT_MODE is set.
std::string errors_text(registers::Model model, std::int64_t err_stat);

/// The risk of this value, for a question; empty: none that `set` would ask about. Registers that are
/// dangerous, and the maker's test modes, which turn the shaft without regulating it (001 §4.4.8 to §4.4.11;
/// 004: "reserved").
std::string danger(registers::Model model, const registers::Register& reg, std::int64_t raw);

/// What a gateway refused to pass on.
enum class Asked : std::uint8_t {
    write,    ///< of a register
    service,  ///< SAFE_MODE, flash, reset
};

/// The reason that a gateway on the line gives for a message it refused; empty if there is no gateway.
std::string gateway_refusal(Motor& motor, Asked asked);

// MIN_P_IST and MAX_P_IST, which act together (001 §3.2.28, §4.5.3), when they are about to be written.

/// Raw values by register number.
using RawValues = std::map<std::uint8_t, std::int64_t>;

/// The values that decide whether the shaft is inside: both limits, P_IST and ERR_STAT. Empty if `wanted`
/// changes none of them.
RawValues read_limits(Motor& motor, const RawValues& wanted);
/// The problem with the limits as `wanted` leaves them, for a question: no position is inside any more, or
/// the shaft is outside. Empty: no new problem.
std::string limits_danger(const RawValues& now, const RawValues& wanted);
/// Whether the shaft would be outside after writing MIN_P_IST alone, but not after writing MAX_P_IST alone.
bool maximum_first(const RawValues& now, const RawValues& wanted);

/// Orders MAX_P_IST and MIN_P_IST so that the shaft is outside at no time.
template <class Write>
void order_limits(const RawValues& now, const RawValues& wanted, std::vector<Write>& all) {
    const auto at = [&](std::uint8_t number) {
        return std::find_if(all.begin(), all.end(),
                            [=](const Write& one) { return one.reg->number == number; });
    };
    const auto low = at(registers::MIN_P_IST), high = at(registers::MAX_P_IST);
    if (low == all.end() || high == all.end()) return;
    if ((high < low) != maximum_first(now, wanted)) std::iter_swap(low, high);
}

}  // namespace nplc::macreg
