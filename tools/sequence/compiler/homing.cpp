#include <fmt/format.h>

#include "compiler/checker.h"
#include "compiler/orders.h"
#include "registers/details.h"

namespace nplc::seqc {
namespace {

constexpr std::string_view kWhatToWrite =
    "write HOME_MODE := BY_COMMAND = HOME1_MODE; (against a stop; HOME2_MODE and HOME3_MODE use a sensor)";

bool is_home(const Send& send) {
    return send.reg == nullptr && kind_of(send) == OrderKind::home;
}

}  // namespace

/// Only if the program itself sets HOME_MODE, and none of its values selects a kind of homing for the
/// command.
void check_home_mode(const Plan& plan, registers::Model model, Report& report) {
    const registers::Field* field = registers::field_of(model, registers::HOME_MODE, "BY_COMMAND");
    if (field == nullptr) return;
    const Send* home = nullptr;
    const Send* written = nullptr;
    bool may_search = false;
    for_each_send(plan, [&](const Send& send) {
        if (is_home(send) && home == nullptr) home = &send;
        if (send.reg == nullptr || send.reg->number != registers::HOME_MODE) return;
        written = &send;
        const std::uint32_t kind = registers::value_in(*field, send.value);
        may_search = may_search || (kind != 0 && registers::named(*field, kind) != nullptr);
    });
    if (home == nullptr || written == nullptr || may_search) return;
    const bool is_low = written->value != 0 && registers::value_in(*field, written->value) == 0;
    Diagnostic& d = report.add("W032", home->span, "HOME has no effect: HOME_MODE selects no homing for it",
                               std::string(kWhatToWrite));
    d.notes.push_back(
        {written->span, is_low ? "the low byte, written here, is for power-up; HOME uses the high byte"
                               : "HOME_MODE is written here; HOME uses its high byte"});
}

}  // namespace nplc::seqc
