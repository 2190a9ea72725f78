#include "macreg/midi/why.h"

#include <fmt/format.h>

namespace nplc::macreg::midi {
namespace {

MidiState state_of(const Condition& condition) {
    const Readings& now = condition.now;
    const bool turns = condition.before.position() != now.position();
    return {.model = condition.scale.model,
            .status = now.status(),
            .turns = turns,
            .is_stuck = !turns && now.busy() && condition.before.busy(),
            .torque = now.raw("TORQUE"),
            .most_torque = condition.scale.imax,
            .period = now.raw("SPEED"),
            .readings = MidiReadings{.end_stops = static_cast<std::uint32_t>(now.raw("END_STOPS")),
                                     .terminals = now.measures(),
                                     .position = now.position(),
                                     .upper_stop = now.raw("UPPER_STOP"),
                                     .lower_stop = now.raw("LOWER_STOP"),
                                     .temperature = static_cast<std::uint8_t>(now.raw("TEMPERATURE"))}};
}

MidiTexts texts_of(const Condition& condition) {
    const std::int64_t way = std::int64_t{condition.now.position()} - condition.before.position();
    return {.distance = fmt::format(": {} in 200 ms", position_text(way, condition.scale)),
            .speed = speed_text(condition.now.raw("SPEED"), condition.scale)};
}

}  // namespace

Condition read_condition(Module& module) {
    Condition condition{.scale = module.scale()};
    condition.before = module.read_all();
    module.master().link().pause(base::Milliseconds{200});
    condition.now = module.read_all();
    return condition;
}

Finding same_address(std::uint8_t address, bool is_can) {
    return {"same_address",
            Severity::stops,
            fmt::format("More than one module answers to address {}: what moves one moves both, so that "
                        "commands that move are refused.",
                        address),
            {},
            fmt::format("Switch off all of them but one; `macreg midi {}address set NEW` gives that one an "
                        "address of its own; then switch on the others.",
                        is_can ? "" : fmt::format("--address {} ", address))};
}

std::vector<Finding> why(const Condition& condition) {
    return causes::why(state_of(condition), {}, texts_of(condition));
}

}  // namespace nplc::macreg::midi
