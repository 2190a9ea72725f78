#include <chrono>

#include "midisim.h"

int main(int argc, char** argv) {
    using namespace nplc;
    sim::end_on_signals();
    const auto wall = [] { return sim::Time(std::chrono::steady_clock::now().time_since_epoch()); };
    return sim::serve_devices("midisim", sim::parse_midisim(argc, argv), sim::open_modules, wall);
}
