#include "cli/midi.h"

#include <fmt/format.h>

#include "host/endpoint.h"
#include "host/interruption.h"

namespace nplc::macreg::cli {

using midi_client::LineError;

namespace {

constexpr unsigned kAttempts = 6;
constexpr base::Microseconds kLook{100'000};
constexpr base::Microseconds kLongestRamp{10'000'000};

std::uint8_t address_of(const MidiCommon& options) {
    const int said = options.address != MidiCommon::kNotSaid ? options.address
                     : options.common.address != 0           ? static_cast<int>(options.common.address)
                     : is_can(options)                       ? 1
                                                             : 0;
    look_at_address(options, "--address", said);
    return static_cast<std::uint8_t>(said);
}

/// The warning after a stop that was not confirmed.
std::string unstopped(MidiSession& session) {
    try {
        if (!session.module().moves())
            return fmt::format("address {} does not answer to a stop; it stood when looked at",
                               session.address());
    } catch (const std::runtime_error&) {  // the state is unknown
    }
    return fmt::format("STILL TURNING, perhaps: address {} does not answer to a stop", session.address());
}

}  // namespace

std::optional<midi::reg::Model> midi_model(const MidiCommon& midi) {
    const std::string& said = midi.model.empty() ? midi.common.model : midi.model;
    if (said.empty()) return std::nullopt;
    const auto model = midi::reg::model_of(said);
    if (!model) throw UserError(fmt::format("--model {}: write MAC23, MAC34-1 or MAC34-2", said));
    if (is_can(midi) && !midi::reg::facts_of(*model).has_can)
        throw UserError(fmt::format("--model {}: it has no CAN", said));
    return model;
}

bool is_can(const MidiCommon& midi) {
    return host::Endpoint(midi.common.port).kind == host::Endpoint::Kind::can;
}

void look_at_address(const MidiCommon& midi, const char* what, int address) {
    const int least = is_can(midi) ? 1 : 0;
    if (address < least || address > 127)
        throw UserError(fmt::format("{} {}: modules on {} have the addresses {} to 127", what, address,
                                    is_can(midi) ? "CAN" : "a serial line", least));
}

std::uint32_t midi_baud(const MidiCommon& midi) {
    return midi.baud != 0 ? midi.baud : midi.common.baud_or(midi::reg::kFactoryBaud);
}

MidiSession::MidiSession(const MidiCommon& options, std::uint32_t baud, base::Microseconds patience)
    : common_(options.common) {
    const auto model = midi_model(options);
    const std::uint8_t address = address_of(options);
    if (patience.count() == 0) patience = base::Milliseconds{common_.patience_ms};
    if (is_can(options)) {
        open_can(options, patience);
    } else {
        command_line::Common line = common_;
        line.baud = baud != 0 ? baud : midi_baud(options);
        wire_ = command_line::open_port(line);
        link_ = std::make_unique<midi_client::V24Link>(
            *wire_, midi_client::V24Options{.baud = line.baud, .patience = patience});
    }
    master_ = std::make_unique<midi_client::Master>(*link_, kAttempts);
    module_ = std::make_unique<midi::Module>(*master_, address, model);
}

void MidiSession::open_can(const MidiCommon& options, base::Microseconds patience) {
    const std::string interface = host::Endpoint(options.common.port).place;
    if (interface.empty()) throw UserError("--port can: write the interface's name too: can:can0");
    auto opened = host::CanClient::open(interface);
    if (opened.never) throw UserError(opened.error);
    if (opened.client == nullptr) throw LineError(LineError::Kind::port_gone, opened.error);
    can_ = std::move(opened.client);
    auto link = std::make_unique<midi_client::CanLink>(*can_, midi_client::CanOptions{.patience = patience});
    can_link_ = link.get();
    link_ = std::move(link);
}

std::int64_t number_of(const midi::TypedNumber& number, const char* what) {
    if (!number.error.empty()) throw UserError(what + number.error);
    return number.value;
}

Json midi_document(const midi::Parameter& parameter, std::int64_t raw, const midi::Scale& scale) {
    return {{"name", parameter.name}, {"raw", raw}, {"value", midi::value_text(parameter, raw, scale)}};
}

void hold_signals() {
    host::hold_interruptions();
}

namespace {

std::int32_t come_to_rest(MidiSession& session) {
    using Kind = midi_client::Answer::Kind;
    midi_client::Master& master = session.master();
    const std::uint8_t address = session.address();
    const auto stop_hard = [&] {
        if (master.stop_hard(std::span(&address, 1)).empty()) return;
        throw LineError(LineError::Kind::no_answer,
                        fmt::format("{}: {}", session.link().name(), unstopped(session)));
    };
    Kind kind = Kind::silence;
    try {
        kind = master.try_command(address, midi::reg::STOP).kind;
    } catch (const LineError&) {  // reported by the next request
    }
    if (kind != Kind::accepted) stop_hard();
    const base::Instant end = session.link().now() + kLongestRamp;
    std::int32_t before = master.position(address);
    for (;;) {
        session.link().pause(kLook);
        const std::int32_t position = master.position(address);
        if (position == before) return position;
        before = position;
        if (session.link().now() > end) stop_hard();
    }
}

}  // namespace

std::int32_t bring_to_rest(MidiSession& session) {
    try {
        return come_to_rest(session);
    } catch (const midi_client::SameAddress& error) {
        const std::uint8_t address = session.address();
        const bool told = session.master().stop_hard(std::span(&address, 1)).empty();
        throw midi_client::SameAddress(
            fmt::format("{}; told to stop at once (18h){}: LOOK WHETHER EACH STANDS", error.what(),
                        told ? ", and one has confirmed" : ", and none has confirmed"));
    }
}

void stop_and_rethrow(MidiSession& session, const std::runtime_error& error) {
    progress(session.common(), "");
    try {
        bring_to_rest(session);
    } catch (const LineError& stop) {
        throw LineError(stop.kind(), fmt::format("{}; {}", error.what(), stop.what()));
    }
    throw;
}

void add_midi(arguments::App& app, Common& common) {
    const auto midi = std::make_shared<MidiCommon>(common);
    arguments::App& command = command_line::add_command(
        app, "midi", "MIDI Ingenierie MAC23 and MAC34 modules, on a serial line or on CAN (--port can:can0)");
    command.require_subcommand(1);
    command.add_option("--address", midi->address,
                       "Address of the module: 0 to 127 on a serial line, 1 to 127 on CAN; if not said, what "
                       "a new module has: 0, and 1 on CAN");
    command.add_option("--model", midi->model, "MAC23, MAC34-1 or MAC34-2: for turns, volts and degrees")
        ->envname("MACREG_MIDI_MODEL");
    command
        .add_option("--baud", midi->baud, "Speed of the serial line, 38400 if not said: 9600, 19200, 38400")
        ->in_range(1U, 921'600U);
    // The callback keeps the options alive as long as the command line.
    command.callback([midi] {});
    add_midi_status(command, *midi);
    add_midi_values(command, *midi);
    add_midi_motion(command, *midi);
    add_midi_path(command, *midi);
    add_midi_service(command, *midi);
    add_midi_find(command, *midi);
    add_midi_raw(command, *midi);
}

}  // namespace nplc::macreg::cli
