#include "macreg/why.h"

#include "base/bytes.h"

namespace nplc::macreg {

namespace gw = registers::gateway;

namespace {

constexpr base::Milliseconds kBetween{200};

/// For a drive of another kind the gateway has substitute registers only, and few of them.
void expect_jvl_motor(Motor& motor) {
    const std::uint32_t kind =
        motor.master().read(gw::kDefaultAddress, gw::register_of(gw::Setting::motor_kind));
    if (kind != 0)
        throw WrongUnit(
            motor.master().wire().name() +
            ": behind this gateway is a MIDI drive, which has no such registers; `nanoctl status --why` "
            "tells why it does not move, and on its own line `macreg midi why`");
}

}  // namespace

Condition read_condition(Motor& motor, bool look_for_gateway) {
    const bool has_gateway = look_for_gateway && motor.is_behind_gateway();
    if (has_gateway) expect_jvl_motor(motor);
    Condition condition{.model = motor.model()};
    const auto wanted = judged(motor.model());
    condition.before = motor.read_block(wanted);
    motor.master().pause(kBetween);
    condition.now = motor.read_block(wanted);
    if (!has_gateway) return condition;
    const auto block = motor.master().read_block(gw::kDefaultAddress, gw::STATUS);
    condition.gateway = {.status = base::load_u32(block.data()), .safe_reason = base::load_u32(&block[4])};
    return condition;
}

}  // namespace nplc::macreg
