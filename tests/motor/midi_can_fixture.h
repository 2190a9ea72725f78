#pragma once

#include <string>
#include <vector>

#include "midi_bench.h"
#include "scripted_can.h"

namespace nplc::motor {

using Kind = MidiOutcome::Kind;
using Frames = std::vector<std::string>;

inline const std::string kAskStatus = "605 40 01 20 00 00 00 00 00";
inline const std::string kRun = "605 23 15 20 00 00 F6 03 20";
inline const std::string kRunTaken = "585 60 15 20 00 00 00 00 00";
inline const std::string kBoot = "705 00";

/// The link to module 5 on a bus whose frames are the test's.
struct MidiCanLineTest : testing::Test {
    ScriptedCan bus;
    MidiCanLink link{bus, {.address = 5}};
    base::Instant now{1s};

    void hear(const std::string& text) { bus.received.push_back(can_frame(text)); }
    MidiOutcome heard(const std::string& text) {
        hear(text);
        now += base::Microseconds(1'000);
        return link.poll(now);
    }
    void run() { link.begin({.number = midi::RUN, .data = 0x00F6'0320}, now); }
    void ask() { link.begin({.is_query = true, .number = midi::GET_STATUS}, now); }
    Kind at_the_deadline() {
        now = link.next_poll(now);
        return link.poll(now).kind;
    }
};

}  // namespace nplc::motor
