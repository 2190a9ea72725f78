#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/midi.h"

namespace nplc::macreg::cli {
namespace {

struct MidiFindArguments {
    bool this_speed = false;
    bool every_speed = false;
};

constexpr base::Microseconds kPatience{40'000};
constexpr std::uint32_t kSpeeds[] = {38'400, 19'200, 9'600};

class MidiSearch {
  public:
    MidiSearch(const MidiCommon& midi, const MidiFindArguments& options) : midi_(midi), options_(options) {}

    void run() {
        const std::string& port = midi_.common.port;
        const bool one = is_can(midi_) || port.starts_with("unix:") || port.starts_with("tcp:") ||
                         port.starts_with("pty:") || options_.this_speed;
        if (one) {
            at(midi_baud(midi_));
        } else {
            for (const std::uint32_t baud : kSpeeds) {
                if (modules_.empty() || options_.every_speed) at(baud);
            }
        }
        progress(midi_.common, "");
        if (modules_.empty())
            throw command_line::Failure(
                command_line::kNoAnswer,
                heard_ ? "bytes came, but no answer: is it another kind of device, or do several modules "
                         "have the "
                         "same address?"
                       : "nobody answers; is the module switched on, and are the wires the right way round?");
        command_line::tell(midi_.common, text_, {{"modules", modules_}});
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
        heard_ = heard_ || session.link().heard_anything();
    }

    /// A damaged answer is one: it is asked for again.
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
        text_ += fmt::format("{}address {:>3}{}: {}", text_.empty() ? "" : "\n", address, speed, what);
        if (!is_can(midi_)) one["baud"] = baud;
        modules_.push_back(std::move(one));
    }

    /// Who answers and is no module, as far as one can tell.
    void note(std::uint8_t address, midi_client::Answer::Kind kind) {
        using Kind = midi_client::Answer::Kind;
        if (kind == Kind::refused)
            remark(midi_.common,
                   fmt::format("address {}: something answers and refuses GET_RELEASE, which no "
                               "MIDI module does; is it another kind of device?",
                               address));
        if (kind == Kind::unclear)
            remark(midi_.common, fmt::format("address {}: each answer came damaged; do several modules have "
                                             "this address, or has the line noise?",
                                             address));
    }

    const MidiCommon& midi_;
    const MidiFindArguments& options_;
    std::string text_;
    Json modules_ = Json::array();
    bool heard_ = false;
};

}  // namespace

void add_midi_find(arguments::App& app, MidiCommon& midi) {
    const auto options = std::make_shared<MidiFindArguments>();
    arguments::App& command = command_line::add_command(
        app, "find",
        "Which modules are on the line or bus, by address and speed. Only reads; some 7 s a speed");
    command.add_flag("--every-speed", options->every_speed,
                     "Go on with the other speeds when one has been answered at");
    command.add_flag("--this-speed", options->this_speed, "Only the speed of --baud");
    command.callback([options, &midi] { midi_guard(midi, [&] { MidiSearch(midi, *options).run(); }); });
}

}  // namespace nplc::macreg::cli
