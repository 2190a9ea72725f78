#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/midi.h"

namespace nplc::macreg::cli {
namespace {

using midi_client::Answer;

/// 000 §VI 00h: it hears nothing for two seconds.
constexpr base::Microseconds kDeaf{2'200'000};
constexpr const char* kBaudCodes = "9600, 19200 or 38400";

/// Looks whether it answers again; its release.
std::string greet(MidiSession& session, std::uint8_t address) {
    session.master().pause(kDeaf, goes_on);
    return midi::release_text(session.master().query(address, midi::reg::GET_RELEASE));
}

void reset(MidiSession& session) {
    ask(session.common(),
        fmt::format(
            "The module with address {} starts anew: the motor stops and holds nothing, what waits is "
            "dropped, faults are acknowledged",
            session.address()));
    session.module().order(midi::reg::RESET);
    greet(session, session.address());
    const std::uint32_t status = session.master().status(session.address());
    const std::string words = midi::status_words(status);
    session.tell(fmt::format("started anew: {}", words.empty() ? "no fault, no warning" : words),
                 {{"status", status}, {"faults", midi::status_words(status & midi::reg::kTrips)}});
}

void factory(const MidiCommon& midi) {
    {
        MidiSession session(midi);
        ask(session.common(),
            fmt::format(
                "All parameters of the module with address {} are replaced by the factory's, its address "
                "becomes {}{}; the motor stops and holds nothing",
                session.address(), session.link().usual_address(),
                is_can(midi) ? "" : " and its speed 38400 baud"));
        session.module().order(midi::reg::FACTORY);
        session.master().pause(kDeaf, goes_on);
    }
    MidiSession session(midi, midi::reg::kFactoryBaud);
    const std::uint8_t usual = session.link().usual_address();
    session.master().query(usual, midi::reg::GET_RELEASE);
    session.tell(fmt::format("it has the factory's parameters, and answers at address {}", usual),
                 {{"address", usual}});
}

void program_can(MidiSession& session, std::uint8_t address) {
    ask(session.common(),
        fmt::format("The one module on the bus gets the address {} (LMT, 003 §V.5); with several on "
                    "the bus all would get it",
                    address));
    using Programmed = midi_client::CanLink::Programmed;
    const Programmed done = session.can()->program_address(address);
    if (done == Programmed::refused) refuse(fmt::format("the module refuses address {}", address));
    if (done == Programmed::several)
        refuse(
            "several modules answered, so none has the new address: switch all off and on, and leave one on "
            "the "
            "bus");
    if (done == Programmed::silence)
        throw midi_client::Doubtful(fmt::format(
            "{}: the module did not say that it took the address; `macreg midi find` shows which it has",
            session.link().name()));
}

/// 000 §VI 08h goes to all; said with --address, to that one only.
void program_line(MidiSession& session, std::uint8_t address, bool to_one) {
    const std::uint8_t to = to_one ? session.address() : session.link().everyone();
    if (to_one) session.master().expect_alone(to);
    if (to_one && to != address &&
        session.master().try_query(address, midi::reg::GET_RELEASE).kind != Answer::Kind::silence)
        refuse(fmt::format("address {} answers already: each module needs an address of its own", address));
    ask(session.common(),
        to_one ? fmt::format("The module with address {} gets the address {}", to, address)
               : fmt::format(
                     "Every module on the line gets the address {}: only one may be connected (000 §IV). "
                     "--address names one of several",
                     address));
    const Answer answer = session.master().try_command(to, midi::reg::ADDRESS, address);
    if (answer.kind == Answer::Kind::refused) refuse(fmt::format("the module refuses address {}", address));
}

void set_address(const MidiCommon& midi, int address) {
    look_at_address(midi, "address", address);
    const bool said = midi.address != MidiCommon::kNotSaid || midi.common.address != 0;
    if (is_can(midi) && said)
        throw UserError("--address: LMT names nobody (003 §V.5); leave one module on the bus, and this out");
    MidiSession session(midi);
    const auto wanted = static_cast<std::uint8_t>(address);
    session.can() != nullptr ? program_can(session, wanted) : program_line(session, wanted, said);
    const std::string release = midi::release_text(session.master().expect_alone(wanted));
    session.tell(fmt::format("address {}: a module of release {} answers", address, release),
                 {{"address", address}});
}

void set_baud(const MidiCommon& midi, std::uint32_t baud) {
    std::uint32_t code = 0;
    for (std::uint32_t one = 1; one <= 3; ++one) {
        if (midi::reg::baud_of(static_cast<std::int32_t>(one)) == baud) code = one;
    }
    if (code == 0) throw UserError(fmt::format("baud {}: a module has {}", baud, kBaudCodes));
    if (is_can(midi)) throw UserError("baud: modules on CAN have a bit rate, which no command sets");
    std::uint8_t address = 0;
    {
        MidiSession session(midi);
        address = session.address();
        ask(session.common(),
            fmt::format("The module with address {} starts anew at {} baud: the motor stops and holds "
                        "nothing; what else is on the line at another speed hears noise",
                        address, baud));
        session.module().order(midi::reg::BAUD, code);
        session.master().pause(kDeaf, goes_on);
    }
    MidiSession session(midi, baud);
    session.master().query(address, midi::reg::GET_RELEASE);
    session.tell(fmt::format("address {} answers at {} baud; say --baud {} from now on", address, baud, baud),
                 {{"address", address}, {"baud", baud}});
}

}  // namespace

void add_midi_service(arguments::App& app, MidiCommon& midi) {
    arguments::App& address_command = command_line::add_command(app, "address", "Give a module its address");
    address_command.require_subcommand(1);
    const auto address = std::make_shared<int>(0);
    arguments::App& set_command = command_line::add_command(
        address_command, "set",
        "08h, on CAN the LMT procedure; asks first, and looks whether it answers there");
    set_command.add_option("new_address", *address, "0 to 127, on CAN 1 to 127")->required();
    set_command.callback([address, &midi] { midi_guard(midi, [&] { set_address(midi, *address); }); });

    const auto baud = std::make_shared<std::uint32_t>(0);
    arguments::App& baud_command = command_line::add_command(
        app, "baud", "Set the speed of the serial line in a module, which starts anew; asks first");
    baud_command.add_option("new_baud", *baud, kBaudCodes)->required();
    baud_command.callback([baud, &midi] { midi_guard(midi, [&] { set_baud(midi, *baud); }); });

    command_line::add_command(app, "reset", "Start a module anew, which acknowledges its faults; asks first")
        .callback([&midi] { midi_work(midi, reset); });
    command_line::add_command(app, "factory",
                              "All parameters as from the factory, the address too; asks first")
        .callback([&midi] { midi_guard(midi, [&] { factory(midi); }); });
}

}  // namespace nplc::macreg::cli
