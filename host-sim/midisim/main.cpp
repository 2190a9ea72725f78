#include <chrono>
#include <memory>

#include "command_line.h"
#include "midi_service.h"

int main(int argc, char** argv) {
    using namespace nplc;
    sim::end_on_signals();
    const sim::MidisimCommandLine command = sim::parse_midisim(argc, argv);
    if (!command.error.empty()) return sim::trouble("midisim", command.error);
    if (!command.options) return 0;
    const bool on_can = !command.options->can.empty();
    std::string error;
    std::unique_ptr<sim::Served> service;
    if (on_can)
        service = std::make_unique<sim::MidiCanService>(*command.options, error);
    else
        service = std::make_unique<sim::MidiService>(*command.options, error);
    if (!error.empty()) return sim::trouble("midisim", error);
    const auto wall = [] { return sim::Time(std::chrono::steady_clock::now().time_since_epoch()); };
    return sim::serve(*service, {.program = "midisim", .speed = command.options->speed, .wall_clock = wall});
}
