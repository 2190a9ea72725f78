#include <fmt/format.h>

#include "compiler/checker.h"
#include "compiler/orders.h"
#include "registers/details.h"

namespace nplc::seqc {
namespace {

constexpr std::string_view kWhatToWrite =
    "write HOME_MODE := BY_COMMAND = HOME1_MODE; (against a stop; HOME2_MODE and HOME3_MODE use a sensor)";

constexpr std::uint32_t kAgainstStop = 12;  // HOME1_MODE

bool is_home(const Send& send) {
    return send.reg == nullptr && kind_of(send) == OrderKind::home;
}

/// The last of the values written to a register if all of them are 0; null otherwise.
const Send* only_zero(const Plan& plan, std::uint8_t number) {
    const Send* zero = nullptr;
    bool always = true;
    for_each_send(plan, [&](const Send& send) {
        if (send.reg == nullptr || send.reg->number != number) return;
        if (send.value == 0 && send.set_point == 0)
            zero = &send;
        else
            always = false;
    });
    return always ? zero : nullptr;
}

/// V_HOME, and against a stop T_HOME, must not be 0.
void check_home_moves(const Plan& plan, const Send& home, bool against_stop, Report& report) {
    if (const Send* zero = only_zero(plan, registers::V_HOME)) {
        report
            .add("W032", home.span, "HOME does not move the axis: V_HOME, the velocity of the search, is 0",
                 "give V_HOME a velocity; its sign is the direction of the search")
            .notes.push_back({zero->span, "it gets its value here"});
    } else if (const Send* none = against_stop ? only_zero(plan, registers::T_HOME) : nullptr) {
        report
            .add("W032", home.span,
                 "HOME does not move the axis: T_HOME, from which the search has its torque, is 0",
                 "give T_HOME the torque at which the stop counts as found, such as 20 %peak")
            .notes.push_back({none->span, "it gets its value here"});
    }
}

}  // namespace

/// Only by what the program itself writes: a HOME_MODE that selects no kind of homing for the command, or a
/// velocity or torque of 0.
void check_home_mode(const Plan& plan, registers::Model model, Report& report) {
    const registers::Field* field = registers::field_of(model, registers::HOME_MODE, "BY_COMMAND");
    if (field == nullptr) return;
    const Send* home = nullptr;
    const Send* written = nullptr;
    bool may_search = false;
    bool only_against_stop = true;
    for_each_send(plan, [&](const Send& send) {
        if (is_home(send) && home == nullptr) home = &send;
        if (send.reg == nullptr || send.reg->number != registers::HOME_MODE) return;
        written = &send;
        const std::uint32_t kind = registers::value_in(*field, send.value);
        may_search = may_search || (kind != 0 && registers::named(*field, kind) != nullptr);
        only_against_stop = only_against_stop && kind == kAgainstStop;
    });
    if (home == nullptr) return;
    if (written == nullptr || may_search)
        return check_home_moves(plan, *home, written != nullptr && only_against_stop, report);
    const bool is_low = written->value != 0 && registers::value_in(*field, written->value) == 0;
    Diagnostic& d = report.add("W032", home->span, "HOME has no effect: HOME_MODE selects no homing for it",
                               std::string(kWhatToWrite));
    d.notes.push_back(
        {written->span, is_low ? "the low byte, written here, is for power-up; HOME uses the high byte"
                               : "HOME_MODE is written here; HOME uses its high byte"});
}

}  // namespace nplc::seqc
