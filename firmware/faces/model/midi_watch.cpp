#include "faces/midi_watch.h"

#include <cstdlib>
#include <utility>

#include "motor/midi_motor.h"

namespace nplc::faces {
namespace {

constexpr std::int64_t kStandby = 5;  ///< increments by which a shaft may oscillate (003 §VII 02h)
constexpr base::Milliseconds kTurning{500};
constexpr base::Milliseconds kStuck{1'000};

}  // namespace

std::optional<causes::MidiState> MidiWatch::look(const motor::AnyDriver& driver, base::Instant wall) {
    const auto* motor = driver.get<motor::MidiMotor>();
    if (motor == nullptr) return std::nullopt;
    const motor::MidiDrive& drive = motor->drive();
    const bool is_new = wall - std::exchange(looked_, wall) > kTurning;  // no request for a while
    if (is_new || std::abs(std::int64_t{drive.position()} - place_) > kStandby) {
        place_ = drive.position();
        moved_ = is_new ? wall - kTurning : wall;
    }
    if (is_new || !drive.is_busy()) idle_ = wall;
    return causes::MidiState{.model = drive.model(),
                             .status = drive.status(),
                             .turns = wall - moved_ < kTurning,
                             .is_stuck = wall - moved_ >= kStuck && wall - idle_ >= kStuck,
                             .torque = drive.torque(),
                             .most_torque = drive.most_torque(),
                             .period = drive.period(),
                             .driver = causes::MidiDriver{.fault = motor->fault(),
                                                          .limitation = motor->limitation(),
                                                          .is_at_target = motor->is_at_target(),
                                                          .has_no_speed = motor->has_no_speed()}};
}

}  // namespace nplc::faces
