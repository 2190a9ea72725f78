#include "nanoctl/why.h"

#include <cstdlib>

#include "causes/midi_why.h"
#include "causes/why.h"
#include "registers/convert.h"
#include "registers/layout.h"

namespace nplc::nanoctl {
namespace {

using mactalk_client::LineError;
using registers::Model;

/// The motor's registers, read through the gateway.
class MotorReader {
  public:
    explicit MotorReader(GatewayClient& gateway)
        : gateway_(gateway),
          address_(static_cast<std::uint8_t>(setting(gw::Setting::motor_address))),
          is_midi_(setting(gw::Setting::motor_kind) != 0),
          model_(setting(gw::Setting::motor_is_mac800) != 0 ? Model::mac800 : Model::mac140) {}

    bool is_midi() const { return is_midi_; }
    Model model() const { return model_; }
    std::int64_t read(const registers::Register& reg) {
        gateway_.look_for_interruption();
        return registers::value_of(registers::format_on_line(model_, reg),
                                   gateway_.master().read(address_, reg.number));
    }
    std::int64_t read(std::uint8_t number) { return read(*registers::find(model_, number)); }
    causes::Snapshot read(const std::vector<const registers::Register*>& wanted) {
        causes::Snapshot all;
        for (const registers::Register* reg : wanted) all.set(reg->number, read(*reg), {});
        return all;
    }
    void pause(base::Microseconds time) { gateway_.master().pause(time); }

  private:
    std::uint32_t setting(gw::Setting which) { return gateway_.read(gw::register_of(which)); }

    GatewayClient& gateway_;
    std::uint8_t address_;
    bool is_midi_;
    Model model_;
};

causes::GatewayState state_of(const Status& status) {
    return {.status = status.bits, .safe_reason = static_cast<std::uint32_t>(status.safe_reason)};
}

/// The log's last entry of the error, while there is one.
gw::DriveFault fault_of(GatewayClient& gateway, const Status& status) {
    gw::DriveFault fault = gw::DriveFault::none;
    if (!status.has(gw::kMotorError)) return fault;
    for (const LogEntry& entry : read_log(gateway)) {
        if (entry.event == static_cast<std::uint8_t>(gw::Event::motor_fault))
            fault = static_cast<gw::DriveFault>(entry.detail);
    }
    return fault;
}

causes::MidiState midi_state(GatewayClient& gateway, const Status& status) {
    causes::MidiState drive;
    drive.driver = causes::MidiDriver{.fault = fault_of(gateway, status)};
    return drive;
}

/// ERR_STAT's bits as firmware/motor/MIDI.md has them, in the place of the module's own status.
void take_errors(std::int64_t err_stat, causes::MidiState& drive) {
    constexpr std::int64_t kTrip = 1 << 0;
    constexpr std::int64_t kSupply = 1 << 3;
    if ((err_stat & kTrip) != 0) drive.status |= registers::midi::kThermalTrip23;
    if ((err_stat & kSupply) != 0) drive.status |= registers::midi::kSupplyTrip;
}

void ask_midi(MotorReader& motor, const Status& status, causes::MidiState& drive) {
    constexpr base::Milliseconds kStuck{1'200};
    constexpr std::int64_t kStandby = 20;  // counts; more than the oscillation of a shaft
    const std::int64_t place = motor.read(registers::P_IST);
    const std::int64_t mode = motor.read(registers::MODE_REG);
    take_errors(motor.read(registers::ERR_STAT), drive);
    drive.driver->has_no_speed = mode != 0 && motor.read(registers::V_SOLL) == 0;
    drive.driver->is_at_target = mode == 2 && status.has(gw::kInPosition);
    const bool is_to_move = mode != 0 && !status.has(gw::kInPosition) && !status.has(gw::kMotorError) &&
                            !drive.driver->has_no_speed;
    if (is_to_move) motor.pause(kStuck);
    drive.turns = std::abs(motor.read(registers::P_IST) - place) > kStandby;
    drive.is_stuck = is_to_move && !drive.turns;
}

}  // namespace

Why why_of_gateway(GatewayClient& gateway, const Status& status) {
    if (gateway.read(gw::register_of(gw::Setting::motor_kind)) == 0) return {causes::why(state_of(status))};
    return {causes::why(midi_state(gateway, status), state_of(status))};
}

Why ask_why(GatewayClient& gateway, const Status& status) {
    if (!status.has(gw::kLinkDelivers)) return why_of_gateway(gateway, status);
    try {
        MotorReader motor(gateway);
        if (motor.is_midi()) {
            causes::MidiState drive = midi_state(gateway, status);
            ask_midi(motor, status, drive);
            return {causes::why(drive, state_of(status)), true};
        }
        causes::Condition condition{.model = motor.model(), .gateway = state_of(status)};
        condition.before = motor.read(causes::judged_before(motor.model()));
        condition.now = motor.read(causes::judged(motor.model()));
        return {causes::why(condition), true};
    } catch (const LineError& error) {
        if (error.kind() != LineError::Kind::no_answer) throw;
    }
    Why why = why_of_gateway(gateway, status);
    why.motor_is_silent = true;
    return why;
}

}  // namespace nplc::nanoctl
