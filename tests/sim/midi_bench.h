#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "registers/midi.h"
#include "sim/midi_module.h"

namespace nplc::sim {

namespace midi = registers::midi;
using Input = MidiModule::Input;

constexpr Time kTick{125};

/// A module and its time.
class MidiBench {
  public:
    explicit MidiBench(midi::Model model = midi::Model::mac34_1, const MidiOptions& options = {})
        : module_(model, options) {}

    MidiModule& operator*() { return module_; }
    MidiModule* operator->() { return &module_; }
    Time now() const { return now_; }

    void pass(Time time) {
        now_ += time;
        module_.advance(now_);
    }
    bool order(std::uint8_t number, std::int32_t first = 0, std::int32_t second = 0) {
        const auto data = midi::pack(*midi::find_command(number), first, second);
        EXPECT_TRUE(data) << "no such parameter";
        return data && module_.execute(number, 0, *data);
    }
    std::uint32_t ask(std::uint8_t query, std::uint8_t sub_index = 0) {
        return module_.answer(query, sub_index).value_or(0xDEADDEAD);
    }
    /// Until it stands, a tick of 0.125 us at a time at the end only; at most a minute. When that was, to 10
    /// us.
    Time run_out() {
        const Time limit = now_ + std::chrono::minutes{1};
        while (module_.moving() && now_ < limit) pass(std::chrono::microseconds{10});
        EXPECT_FALSE(module_.moving());
        return now_;
    }
    void restart() {
        module_.restart();
        pass(std::chrono::seconds{2});
    }

  private:
    MidiModule module_;
    Time now_{0};
};

}  // namespace nplc::sim
