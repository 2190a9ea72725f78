#include "macreg/midi/raw.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/midi.h"

namespace nplc::macreg::cli {
namespace {

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

}  // namespace

void add_midi_raw(arguments::App& app, MidiCommon& midi) {
    const auto options = std::make_shared<MidiRawArguments>();
    arguments::App& command = command_line::add_command(
        app, "raw",
        "Send a frame of the expert mode as the maker's tool takes it, and show bytes and meaning both ways: "
        "00150000000320 is address 00, index 15, sub-index 00, parameters 00000320");
    command.add_option("frame", options->frame, "14 hexadecimal digits")->required();
    command.add_flag("--force", options->force,
                     "Also what moves, restarts or renames the module; asks first");
    command.callback([options, &midi] { midi_guard(midi, [&] { raw(midi, *options); }); });
}

}  // namespace nplc::macreg::cli
