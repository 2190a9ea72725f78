#include <chrono>

#include "macsim.h"

int main(int argc, char** argv) {
    using namespace nplc;
    sim::end_on_signals();
    const auto wall = [] { return sim::Time(std::chrono::steady_clock::now().time_since_epoch()); };
    return sim::serve_devices("macsim", sim::parse_macsim(argc, argv), sim::open_rack, wall);
}
