#include <chrono>

#include "command_line.h"
#include "service.h"

int main(int argc, char** argv) {
    using namespace nplc;
    sim::end_on_signals();
    const sim::MacsimCommandLine command = sim::parse_macsim(argc, argv);
    if (!command.error.empty()) return sim::trouble("macsim", command.error);
    if (!command.options) return 0;
    std::string error;
    sim::Service service(*command.options, error);
    if (!error.empty()) return sim::trouble("macsim", error);
    const auto wall = [] { return sim::Time(std::chrono::steady_clock::now().time_since_epoch()); };
    return sim::serve(service, {.program = "macsim", .speed = command.options->speed, .wall_clock = wall});
}
