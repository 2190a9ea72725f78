#include <fmt/format.h>

#include "cli/midi.h"
#include "host/endpoint.h"
#include "macreg/midi/raw.h"

namespace nplc::macreg::cli {

using midi_client::Answer;

namespace {

/// 000 §VI 00h: the module does not receive for two seconds.
constexpr base::Microseconds kDeaf{2'200'000};
constexpr const char* kBaudCodes = "9600, 19200 or 38400";

/// Checks whether the module answers again; returns its release.
std::string greet(MidiSession& session, std::uint8_t address) {
    session.master().pause(kDeaf, goes_on);
    return midi::release_text(session.master().query(address, midi::reg::GET_RELEASE));
}

void restart(MidiSession& session) {
    ask(session.common(), fmt::format("The module with address {} starts anew: the motor stops and holds "
                                      "nothing, what waits is dropped, faults are acknowledged",
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
            fmt::format("All parameters of the module with address {} are replaced by the factory's, its "
                        "address becomes {}{}; the motor stops and holds nothing",
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
    ask(session.common(), fmt::format("The one module on the bus gets the address {} (LMT, 003 §V.5); with "
                                      "several on the bus all would get it",
                                      address));
    using Programmed = midi_client::CanLink::Programmed;
    const Programmed done = session.can()->program_address(address);
    if (done == Programmed::refused) refuse(fmt::format("the module refuses address {}", address));
    if (done == Programmed::several)
        refuse(
            "several modules answered, so none has the new address: switch all off and on, and leave one on "
            "the bus");
    if (done == Programmed::silence)
        throw midi_client::Unconfirmed(fmt::format(
            "{}: the module did not say that it took the address; `macreg midi find` shows which it has",
            session.link().name()));
}

/// 000 §VI 08h goes to all modules; with --address, to that one only.
void program_line(MidiSession& session, std::uint8_t address, bool to_one) {
    const std::uint8_t to = to_one ? session.address() : session.link().everyone();
    if (to_one) session.master().expect_alone(to);
    if (to_one && to != address &&
        session.master().try_query(address, midi::reg::GET_RELEASE).kind != Answer::Kind::silence)
        refuse(fmt::format("address {} answers already: each module needs an address of its own", address));
    ask(session.common(), to_one ? fmt::format("The module with address {} gets the address {}", to, address)
                                 : fmt::format("Every module on the line gets the address {}: only one may "
                                               "be connected (000 §IV). --address names one of several",
                                               address));
    const Answer answer = session.master().try_command(to, midi::reg::ADDRESS, address);
    if (answer.kind == Answer::Kind::refused) refuse(fmt::format("the module refuses address {}", address));
}

void set_address(const MidiCommon& midi, const int& address) {
    look_at_address(midi, "address", address);
    const bool said = midi.address != MidiCommon::kNotSaid || midi.common.address != 0;
    if (is_can(midi) && said)
        throw UserError("--address: LMT addresses no module (003 §V.5); leave one on the bus, and omit this");
    MidiSession session(midi);
    const auto wanted = static_cast<std::uint8_t>(address);
    session.can() != nullptr ? program_can(session, wanted) : program_line(session, wanted, said);
    const std::string release = midi::release_text(session.master().expect_alone(wanted));
    session.tell(fmt::format("address {}: a module of release {} answers", address, release),
                 {{"address", address}});
}

void set_baud(const MidiCommon& midi, const std::uint32_t& baud) {
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

constexpr base::Microseconds kPatience{40'000};
constexpr std::uint32_t kSpeeds[] = {38'400, 19'200, 9'600};

class MidiSearch {
  public:
    MidiSearch(const MidiCommon& midi, const Search::Speeds& speeds)
        : midi_(midi),
          search_(midi.common,
                  {.only_this = host::Endpoint(midi.common.port).kind != host::Endpoint::Kind::device ||
                                speeds.only_this,
                   .every = speeds.every}) {}

    void run() {
        search_.run(midi_baud(midi_), kSpeeds, [this](std::uint32_t baud) { at(baud); });
        search_.tell(
            "modules",
            "bytes came, but no answer: is it another kind of device, or do several modules have the "
            "same address?",
            "nobody answers; is the module switched on, and are the wires the right way round?");
    }

  private:
    void at(std::uint32_t baud) {
        const base::Microseconds patience =
            midi_.common.patience_ms == 150 ? kPatience : base::Milliseconds{midi_.common.patience_ms};
        MidiSession session(midi_, baud, patience);
        for (unsigned address = is_can(midi_) ? 1 : 0; address <= 127; ++address) {
            look_for_interruption();
            progress(midi_.common, is_can(midi_) ? fmt::format("address {}", address)
                                                 : fmt::format("{} baud, address {}", baud, address));
            look(session, static_cast<std::uint8_t>(address), baud);
        }
        search_.hear(session.link().heard_anything());
    }

    /// A damaged answer counts as an answer: the request is repeated.
    void look(MidiSession& session, std::uint8_t address, std::uint32_t baud) {
        using Kind = midi_client::Answer::Kind;
        midi_client::Answer answer = session.master().try_query(address, midi::reg::GET_RELEASE);
        for (int i = 0; i < 3 && answer.kind != Kind::value && answer.kind != Kind::silence; ++i)
            answer = session.master().try_query(address, midi::reg::GET_RELEASE);
        if (is_shared(session, address, answer.kind == Kind::value))
            return add(address, baud, "MORE THAN ONE MODULE ANSWERS, and what moves one moves both",
                       {{"address", address}, {"several", true}});
        if (answer.kind != Kind::value) return note(address, answer.kind);
        const std::int32_t position = session.master().position(address);
        const std::string words = midi::status_words(session.master().status(address));
        const std::string release = midi::release_text(answer.value);
        add(address, baud,
            fmt::format("release {}, at {} inc{}", release, position, words.empty() ? "" : ", " + words),
            {{"address", address}, {"release", release}, {"position", position}});
    }

    static bool is_shared(MidiSession& session, std::uint8_t address, bool answers) {
        if (!answers) return session.link().answers(address).several();
        try {
            session.master().expect_alone(address);
            return false;
        } catch (const midi_client::SameAddress&) {
            return true;
        }
    }

    void add(std::uint8_t address, std::uint32_t baud, const std::string& what, Json one) {
        const std::string speed = is_can(midi_) ? "" : fmt::format(", {} baud", baud);
        if (!is_can(midi_)) one["baud"] = baud;
        search_.add(fmt::format("address {:>3}{}: {}", address, speed, what), std::move(one));
    }

    /// Devices that answer but do not seem to be modules.
    void note(std::uint8_t address, midi_client::Answer::Kind kind) {
        using Kind = midi_client::Answer::Kind;
        if (kind == Kind::refused)
            remark(midi_.common, fmt::format("address {}: something answers and refuses GET_RELEASE, which "
                                             "no MIDI module does; is it another kind of device?",
                                             address));
        if (kind == Kind::unclear)
            remark(midi_.common, fmt::format("address {}: each answer came damaged; do several modules have "
                                             "this address, or has the line noise?",
                                             address));
    }

    const MidiCommon& midi_;
    Search search_;
};

struct MidiRawArguments {
    std::string frame;
    bool force = false;
};

void raw(const MidiCommon& midi, const MidiRawArguments& options) {
    const auto [request, error] = midi::read_raw(options.frame, is_can(midi));
    if (!error.empty()) throw UserError(error);
    const midi::Scale scale{.model = midi_model(midi)};
    const std::string what = midi::describe_request(request, scale, is_can(midi));
    if (const std::string danger = midi::danger_of(request); !danger.empty()) {
        if (!options.force) throw UserError(fmt::format("{}: {}; --force if you mean it", what, danger));
        ask(midi.common, fmt::format("{}: {}", what, danger));
    }
    MidiSession session(midi);
    const bool moves = !request.query && !midi_client::is_stop(request.number) &&
                       request.number >= midi::reg::WAIT_SYNC && request.number <= midi::reg::PAUSE;
    if (moves && request.address != session.link().everyone()) session.master().expect_alone(request.address);
    const midi_client::Answer answer = session.master().try_request(request);
    const std::string told = midi::describe_answer(request, answer, scale);
    const std::string heard = session.link().last_heard();
    const std::string text = fmt::format("sent   {}\n       {}\nanswer {}\n       {}",
                                         session.link().last_sent(), what, heard.empty() ? "-" : heard, told);
    const Json document{
        {"request", what}, {"sent", session.link().last_sent()}, {"received", heard}, {"answer", told}};
    using Kind = midi_client::Answer::Kind;
    if (answer.kind == Kind::accepted || answer.kind == Kind::value) return session.tell(text, document);
    if (!session.common().json) fmt::print("{}\n", text);
    if (answer.kind == Kind::refused) refuse(fmt::format("refused: {}", what), document);
    throw command_line::Failure(command_line::kNoAnswer, fmt::format("{}: {}", told, what), document);
}

void find_modules(const MidiCommon& midi, const Search::Speeds& speeds) {
    MidiSearch(midi, speeds).run();
}

}  // namespace

void add_midi_service(arguments::App& app, MidiCommon& midi) {
    arguments::App& address_command = add_command(app, "address", "Give a module its address");
    address_command.require_subcommand(1);
    auto [set_command, address] = add_command(
        address_command, midi, "set",
        "08h, on CAN the LMT procedure; asks first, and looks whether it answers there", set_address);
    set_command.add_option("new_address", address, "0 to 127, on CAN 1 to 127")->required();

    auto [baud_command, baud] =
        add_command(app, midi, "baud",
                    "Set the speed of the serial line in a module, which starts anew; asks first", set_baud);
    baud_command.add_option("new_baud", baud, kBaudCodes)->required();

    add_command(app, midi, "reset", "Start a module anew, which acknowledges its faults; asks first",
                restart);
    add_command(app, midi, "factory", "All parameters as from the factory, the address too; asks first",
                factory);
}

void add_midi_find(arguments::App& app, MidiCommon& midi) {
    auto [command, speeds] = add_command(
        app, midi, "find",
        "Which modules are on the line or bus, by address and speed. Only reads; some 7 s a speed",
        find_modules);
    add_speed_options(command, speeds);
}

void add_midi_raw(arguments::App& app, MidiCommon& midi) {
    auto [command, options] = add_command(
        app, midi, "raw",
        "Send a frame of the expert mode as the maker's tool takes it, and show bytes and meaning both ways: "
        "00150000000320 is address 00, index 15, sub-index 00, parameters 00000320",
        raw);
    command.add_option("frame", options.frame, "14 hexadecimal digits")->required();
    command.add_flag("--force", options.force, "Also what moves, restarts or renames the module; asks first");
}

}  // namespace nplc::macreg::cli
