#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/midi.h"

namespace nplc::macreg::cli {
namespace {

struct Options {
    bool this_speed = false;
    bool every_speed = false;
};

constexpr base::Microseconds kPatience{40'000};
constexpr std::uint32_t kSpeeds[] = {38'400, 19'200, 9'600};

class Search {
  public:
    Search(const MidiCommon& midi, const Options& options) : midi_(midi), options_(options) {}

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
        if (answer.kind != Kind::value) return;
        const std::int32_t position = session.master().position(address);
        const std::string words = midi::status_words(session.master().status(address));
        const std::string speed = is_can(midi_) ? "" : fmt::format(", {} baud", baud);
        text_ +=
            fmt::format("{}address {:>3}{}: release {}, at {} inc{}", text_.empty() ? "" : "\n", address,
                        speed, midi::release_text(answer.value), position, words.empty() ? "" : ", " + words);
        Json one{{"address", address}, {"release", midi::release_text(answer.value)}, {"position", position}};
        if (!is_can(midi_)) one["baud"] = baud;
        modules_.push_back(std::move(one));
    }

    const MidiCommon& midi_;
    const Options& options_;
    std::string text_;
    Json modules_ = Json::array();
    bool heard_ = false;
};

}  // namespace

void add_midi_find(arguments::App& app, MidiCommon& midi) {
    const auto options = std::make_shared<Options>();
    arguments::App& command = command_line::add_command(
        app, "find",
        "Which modules are on the line or bus, by address and speed. Only reads; some 7 s a speed");
    command.add_flag("--every-speed", options->every_speed,
                     "Go on with the other speeds when one has been answered at");
    command.add_flag("--this-speed", options->this_speed, "Only the speed of --baud");
    command.callback([options, &midi] { midi_guard(midi, [&] { Search(midi, *options).run(); }); });
}

}  // namespace nplc::macreg::cli
