#include <fmt/format.h>

#include "cli/midi.h"
#include "host/terminal.h"
#include "macreg/midi/values.h"

namespace nplc::macreg::cli {
namespace {

using midi::Scale;

std::uint32_t data_of(midi::reg::Command command, std::int64_t first, std::int64_t second = 0) {
    const auto data = midi::reg::pack(*midi::reg::find_command(command), static_cast<std::int32_t>(first),
                                      static_cast<std::int32_t>(second));
    if (!data)
        throw UserError(fmt::format("{} is out of range: {} to {} inc (003 §IV)", first,
                                    midi::reg::kMinPosition, midi::reg::kMaxPosition));
    return *data;
}

std::string seconds_text(base::Microseconds time) {
    return fmt::format("{:.2f} s", static_cast<double>(time.count()) / 1e6);
}

struct MoveOptions {
    std::string target;
    std::string by;
    bool no_wait = false;
};

/// One damaged bit can turn an acceptance into a refusal; the module then moves although it seemed to refuse.
[[noreturn]] void end_refused(MidiSession& session, const midi_client::Refused& error) {
    if (!error.by_18h() || !session.module().moves()) throw error;
    throw midi_client::Refused(
        fmt::format("{}; it moved all the same and was stopped at {}: has the line noise?", error.what(),
                    midi::position_text(bring_to_rest(session), session.module().known_scale())));
}

/// A second command to the same position is refused while the first is in progress, so an uncertain result is
/// resolved by asking twice.
void start_move(MidiSession& session, std::int32_t target) {
    const std::uint32_t data = data_of(midi::reg::GO_TO, target);
    try {
        session.module().order(midi::reg::GO_TO, data);
    } catch (const midi_client::Unconfirmed&) {
        if (!session.module().moves()) session.module().order(midi::reg::GO_TO, data);
    }
}

void wait_for(MidiSession& session, std::int32_t target) {
    const Scale scale = session.module().known_scale();
    try {
        midi_client::await_arrival(
            session.master(), {session.address(), target}, goes_on,
            [&](std::int32_t position) { progress(session.common(), midi::position_text(position, scale)); });
        progress(session.common(), "");
    } catch (const midi_client::Interrupted&) {
        progress(session.common(), "");
        const std::int32_t position = bring_to_rest(session);
        throw midi_client::Interrupted(
            fmt::format("interrupted; stopped at {}", midi::position_text(position, scale)));
    } catch (const std::runtime_error& error) {
        stop_and_rethrow(session, error);
    }
}

void move(const MidiCommon& midi, const MoveOptions& options) {
    if (options.target.empty() == options.by.empty())
        throw UserError("move: say either a position, or --by and a distance");
    const std::int64_t typed =
        number_of(midi::typed_position(options.by.empty() ? options.target : options.by, midi_model(midi)));
    if (options.by.empty()) data_of(midi::reg::GO_TO, typed);
    MidiSession session(midi);
    session.master().expect_alone(session.address());
    const Scale scale = session.module().known_scale();
    const std::int64_t from = session.master().position(session.address());
    const std::int64_t target = options.by.empty() ? typed : from + typed;
    data_of(midi::reg::GO_TO, target);
    hold_signals();
    const base::Instant begun = session.link().now();
    try {
        start_move(session, static_cast<std::int32_t>(target));
    } catch (const midi_client::Refused& error) {
        end_refused(session, error);
    } catch (const std::runtime_error& error) {
        stop_and_rethrow(session, error);
    }
    if (options.no_wait)
        return session.tell(fmt::format("moves to {}", midi::position_text(target, scale)),
                            {{"target", target}});
    wait_for(session, static_cast<std::int32_t>(target));
    const std::int32_t at = session.master().position(session.address());
    session.tell(fmt::format("at {}, after {}", midi::position_text(at, scale),
                             seconds_text(session.link().now() - begun)),
                 {{"position", at}, {"target", target}, {"from", from}});
}

struct JogOptions {
    std::string speed;
    std::string time;
};

/// True when the motion is to end: its time is over, or Enter was pressed.
bool jog_is_over(MidiSession& session, base::Instant end, bool keys) {
    if (session.link().now() >= end) return true;
    return keys && host::input_within(base::Milliseconds{0});
}

std::string turn(MidiSession& session, base::Microseconds time, bool keys) {
    const Scale scale = session.module().known_scale();
    const base::Instant end =
        time.count() > 0 ? session.link().now() + time : base::Instant(base::Microseconds::max());
    while (!jog_is_over(session, end, keys)) {
        look_for_interruption();
        const std::int32_t position = session.master().position(session.address());
        if (session.link().take_boot(session.address())) return "it started anew by itself";
        const std::string why = midi_client::obstacles(session.master().status(session.address()));
        if (!why.empty()) return why;
        progress(session.common(), fmt::format("{}, {} stops", midi::position_text(position, scale),
                                               keys ? "Enter" : "Ctrl-C"));
        session.link().pause(
            std::min<base::Microseconds>(base::Microseconds{50'000}, end - session.link().now()));
    }
    look_for_interruption();  // a terminal that hangs up reads like Enter
    return {};
}

/// On every path the module is stopped at the end, or a warning says that it may not be.
void jog(const MidiCommon& midi, const JogOptions& options) {
    const std::int64_t period = number_of(midi::typed_period(options.speed, midi_model(midi)));
    const base::Microseconds time{
        number_of(midi::typed_time(options.time.empty() ? "0" : options.time), "--for ")};
    const bool keys = host::is_terminal(stdin) && !midi.common.json;
    if (!keys && time.count() == 0)
        throw UserError("jog: without a terminal no key can end it; say --for, as --for 2s");
    MidiSession session(midi);
    session.master().expect_alone(session.address());
    const Scale scale = session.module().known_scale();
    const std::int32_t from = session.master().position(session.address());
    hold_signals();
    std::string why;
    try {
        const std::int64_t direction = period < 0 ? midi::reg::kTurnsLeft : 0;
        session.module().order(midi::reg::RUN, data_of(midi::reg::RUN, direction, std::abs(period)));
        why = turn(session, time, keys);
    } catch (const midi_client::Refused& error) {
        end_refused(session, error);
    } catch (const midi_client::Interrupted&) {
        progress(session.common(), "");
        throw midi_client::Interrupted(
            fmt::format("interrupted; stopped at {}", midi::position_text(bring_to_rest(session), scale)));
    } catch (const std::runtime_error& error) {
        stop_and_rethrow(session, error);
    }
    progress(session.common(), "");
    const std::int32_t at = bring_to_rest(session);
    if (!why.empty()) refuse(fmt::format("it was stopped at {}: {}", midi::position_text(at, scale), why));
    session.tell(
        fmt::format("turned by {}, stands at {}", midi::position_text(std::int64_t{at} - from, scale),
                    midi::position_text(at, scale)),
        {{"position", at}, {"from", from}});
}

struct StopOptions {
    bool emergency = false;
    bool all = false;
};

/// A general message is executed by all modules, and one answers.
void stop_all(MidiSession& session, midi::reg::Command command) {
    const auto answer = session.master().try_command(session.link().everyone(), command);
    using Kind = midi_client::Answer::Kind;
    if (answer.kind == Kind::accepted)
        return session.tell("stopped: all modules, as the one that answers for them says", {{"all", true}});
    const bool is_can = session.link().is_can();
    if (answer.kind == Kind::refused)
        throw midi_client::Refused(
            "the module that answers for all refuses it; `macreg midi stop --all --emergency` stops "
            "anything");
    throw midi_client::Unconfirmed(fmt::format(
        "{}: told to all modules, and no clear answer came for them (address {} would give it, {}): WHETHER "
        "THEY STOPPED IS NOT KNOWN; stop each with --address",
        session.link().name(), is_can ? 1 : 0, is_can ? "003 §V.8" : "000 §IV"));
}

void stop(MidiSession& session, const StopOptions& options) {
    const midi::reg::Command command = options.emergency ? midi::reg::EMERGENCY_STOP : midi::reg::STOP;
    if (options.all) return stop_all(session, command);
    session.module().order(command);
    const Scale scale = session.module().known_scale();
    hold_signals();
    const std::int32_t at =
        options.emergency ? session.master().position(session.address()) : bring_to_rest(session);
    session.tell(fmt::format("stopped at {}", midi::position_text(at, scale)), {{"position", at}});
}

struct SwitchOptions {
    std::string what;  ///< on or off
    bool force = false;
};

void power(MidiSession& session, const SwitchOptions& options) {
    const bool on = options.what == "on";
    // 000 §VI 1Ah
    if (!on && !options.force && session.module().moves())
        refuse(
            "it turns, and to switch it off now can damage the supply; `macreg midi stop` stops it, --force "
            "switches it off all the same");
    if (on) session.master().expect_alone(session.address());
    session.module().order(on ? midi::reg::POWER_ON : midi::reg::POWER_OFF);
    session.tell(on ? "the motor is on and holds" : "the motor is off and holds nothing",
                 {{"power", options.what}});
}

void zero(MidiSession& session, const SwitchOptions& options) {
    const std::int32_t before = session.master().position(session.address());
    if (!options.force && session.module().moves())
        refuse("it turns; `macreg midi stop` stops it, --force makes its position 0 all the same");
    session.module().order(midi::reg::ZERO_POSITION);
    session.tell(
        fmt::format("here is 0; it was {}", midi::position_text(before, session.module().known_scale())),
        {{"before", before}});
}

void reference(MidiSession& session, const SwitchOptions& options) {
    const bool on = options.what == "on";
    session.module().order(midi::reg::REFERENCE, on ? 1 : 0);
    session.tell(on ? "the reference input sets the position to 0, turning clockwise, until the next start"
                    : "the reference input does nothing",
                 {{"reference", options.what}});
}

}  // namespace

void add_midi_motion(arguments::App& app, MidiCommon& midi) {
    auto [move_command, move_options] = add_command(
        app, midi, "move",
        "Go to a position with SPEED and RAMP, and wait until it is there; Ctrl-C stops it", move);
    move_command.add_option("position", move_options.target, "20480, 2.5rev");
    move_command.add_option("--by", move_options.by, "Instead: how far from here, as -1rev");
    move_command.add_flag("--no-wait", move_options.no_wait, "Do not wait; nothing here stops it then");

    auto [jog_command, jog_options] = add_command(
        app, midi, "jog", "Turn at a speed until Enter or for a time; every end stops it, signals too", jog);
    jog_command
        .add_option("speed", jog_options.speed, "300rpm, -2rev/s, 5000inc/s; negative is counter-clockwise")
        ->required();
    jog_command.add_option("--for", jog_options.time, "How long, as 2s or 500ms");

    auto [stop_command, stop_options] =
        add_command(app, midi, "stop", "Stop with the ramp; a second one does no harm", stop);
    stop_command.add_flag("--emergency", stop_options.emergency,
                          "At once, with all torque, whatever moves; the position loop ends too");
    stop_command.add_flag("--all", stop_options.all, "All modules on the line or bus");

    auto [power_command, power_options] =
        add_command(app, midi, "power", "The motor's power on or off", power);
    power_command.add_option("what", power_options.what, "on or off")->required()->one_of({"on", "off"});
    power_command.add_flag("--force", power_options.force, "Also while it turns");

    auto [zero_command, zero_options] = add_command(app, midi, "zero", "Make this place position 0", zero);
    zero_command.add_flag("--force", zero_options.force, "Also while it turns");

    auto [reference_command, reference_options] =
        add_command(app, midi, "reference", "Whether the reference input sets the position to 0", reference);
    reference_command.add_option("what", reference_options.what, "on or off")
        ->required()
        ->one_of({"on", "off"});
}

}  // namespace nplc::macreg::cli
