#include "macreg/midi/module.h"

#include <fmt/format.h>

namespace nplc::macreg::midi {

using Kind = midi_client::Answer::Kind;

namespace {

constexpr base::Microseconds kBetweenLooks{100'000};
constexpr unsigned kWrites = 4;

}  // namespace

const Scale& Module::scale() {
    if (!scale_read_) {
        // One without it would have no torque at all.
        const std::int64_t imax = ask_imax() >> 24;
        scale_.imax = imax == 0 ? std::int64_t{reg::kMostTorque} : imax;
        scale_read_ = true;
    }
    scale_.period = read(*find_parameter("SPEED"));
    return scale_;
}

/// A module that refuses reads of its RAM is assumed to have the usual one (000 §VI 26h).
std::uint32_t Module::ask_imax() {
    try {
        return master_.query(address_, reg::GET_RAM, reg::kImaxAddress);
    } catch (const midi_client::Refused&) {
        return std::uint32_t{reg::kMostTorque} << 24;
    }
}

std::int64_t Module::read(const Parameter& parameter) {
    return raw_in(parameter, master_.query(address_, *parameter.query, parameter.sub_index));
}

Readings Module::read_all() {
    Readings all;
    for (const reg::Query query :
         {reg::GET_POSITION, reg::GET_STATUS, reg::GET_MEASURES, reg::GET_SETTINGS, reg::GET_SPEEDS,
          reg::GET_UPPER_STOP, reg::GET_LOWER_STOP, reg::GET_RELEASE})
        all.replies[query] = master_.query(address_, query);
    all.replies[reg::GET_RAM] = ask_imax();
    return all;
}

ChangeResult Module::change(const Parameter& parameter, std::int64_t raw) {
    const std::uint32_t data = data_for(parameter, raw);
    ChangeResult outcome;
    if (!parameter.query) {
        order(*parameter.command, data);
        outcome.taken = true;
        return outcome;
    }
    outcome.before = read(parameter);
    for (unsigned i = 0; i < kWrites && !outcome.taken; ++i) {
        const Kind kind = master_.try_command(address_, *parameter.command, data).kind;
        outcome.after = read(parameter);
        outcome.taken = outcome.after == raw;
        if (kind == Kind::refused && !outcome.taken) {
            outcome.why = refusal(*parameter.command, data);
            return outcome;
        }
        if (kind == Kind::accepted) break;
    }
    if (!outcome.taken)
        outcome.why = "no clear answer came, and it reads back otherwise: has the line noise?";
    return outcome;
}

bool Module::moves() {
    const std::int32_t before = master_.position(address_);
    master_.link().pause(kBetweenLooks);
    return master_.position(address_) != before || master_.busy(address_);
}

std::string Module::refusal(std::uint8_t command, std::uint32_t data) {
    const reg::CommandRow* row = reg::find_command(command);
    if (row == nullptr) return "no manual has a command of that number";
    if (master_.link().is_can() && !row->on_can) return "this command is for the serial line only (000 §V.1)";
    const std::uint32_t trips = master_.status(address_) & reg::kTrips;
    if (!row->with_fault && trips != 0)
        return fmt::format("the module has a fault ({}); mend its cause, then `macreg midi reset`",
                           status_words(trips));
    if (command == reg::STOP)
        return "segments (16h, 1Eh) are not stopped by a ramp (000 §VI 17h); `macreg midi stop --emergency` "
               "stops anything";
    if (!row->while_moving && moves())
        return "it is refused while the axis moves; `macreg midi stop` stops it";
    const std::uint32_t imax = ask_imax() >> 24;
    if (command == reg::TORQUE && (data & 0xFF) > imax) return fmt::format("the most is {} (IMAX)", imax);
    if (!reg::is_legal(*row, data)) return "its parameters are out of range";
    if (row->kind == reg::Kind::motion && moves())
        return "another kind of motion is under way; `macreg midi stop` stops it";
    return "neither a fault nor a motion explains it; `macreg midi why` tells more";
}

void Module::order(reg::Command command, std::uint32_t data) {
    try {
        master_.command(address_, command, data);
    } catch (const midi_client::Refused& error) {
        throw midi_client::Refused(fmt::format("{}: {}", error.what(), refusal(command, data)),
                                   error.by_18h());
    }
}

}  // namespace nplc::macreg::midi
