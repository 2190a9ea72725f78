// A MIDI drive that refuses its stop, or does not answer it: its shaft may be moving until it was read at
// rest.

#include <algorithm>
#include <string>

#include "midi_can_fixture.h"
#include "motor/midi_motor.h"

namespace nplc::motor {
namespace {

/// A module on CAN that moves by `step` between two positions, and answers commands as the test determines.
struct UnwillingModule : MidiCanLineTest {
    MidiMotor driver{link, {.model = midi::Model::mac34_1}};
    enum class Does : std::uint8_t { carries_out, refuses, is_mute };
    Does does = Does::carries_out;
    std::uint32_t step = 0;
    std::uint32_t position = 1'000;
    Frames commands;

    std::string answer_to(const std::string& frame) {
        const std::string about = frame.substr(7, 8);
        const std::string number = frame.substr(7, 2);
        if (frame.substr(4, 2) == "23") {
            commands.push_back(number);
            if (does == Does::is_mute) return {};
            return std::string("585 ") + (does == Does::refuses ? "80 " : "60 ") + about + " 00 00 00 00";
        }
        if (number == "05") return "585 42 " + about + " 05 00 00 A0";
        if (number == "06") return "585 42 " + about + " 10 80 10 00";
        if (number == "07") return "585 42 " + about + " 50 78 00 00";
        if (number == "08") return "585 42 " + about + " 80 00 00 00";
        if (number != "00") return "585 42 " + about + " 00 00 00 00";
        position += step;
        constexpr char kHex[] = "0123456789ABCDEF";
        const auto digit = [&](unsigned shift) { return kHex[position >> shift & 15]; };
        return "585 42 " + about + " 00 00 " + digit(12) + digit(8) + " " + digit(4) + digit(0);
    }
    void pass(base::Microseconds time) {
        for (const base::Instant end = now + time; now < end; now += base::Microseconds{500}) {
            driver.poll(now);
            for (const std::string& frame : bus.take())
                if (const std::string answer = answer_to(frame); !answer.empty()) hear(answer);
        }
    }
};

TEST_F(UnwillingModule, IsStoppedWhenItsShaftWasReadAtRest) {
    for (const Does what : {Does::refuses, Does::is_mute}) {
        SCOPED_TRACE(static_cast<int>(what));
        does = Does::carries_out;
        step = 0;
        driver.stop();
        pass(base::Milliseconds{500});
        ASSERT_TRUE(driver.stop_confirmed());
        does = what;
        step = 20;
        commands.clear();
        driver.stop();
        pass(base::Milliseconds{3'000});
        EXPECT_FALSE(driver.stop_confirmed()) << "its shaft turns";
        EXPECT_GT(std::count(commands.begin(), commands.end(), "18"), 2);
        EXPECT_EQ(driver.link(), Link::up);
        step = 0;
        pass(base::Milliseconds{3'000});
        EXPECT_TRUE(driver.stop_confirmed());
        commands.clear();
        pass(base::Milliseconds{1'000});
        EXPECT_EQ(commands, Frames{});
    }
}

TEST_F(UnwillingModule, IsToldAgainUntilItAcceptsOrAnOperatorEndsIt) {
    for (const bool accepts : {true, false}) {
        SCOPED_TRACE(accepts);
        does = Does::refuses;
        step = 20;
        commands.clear();
        driver.stop();
        pass(base::Milliseconds{950});
        EXPECT_FALSE(driver.stop_confirmed());
        const auto told = std::count(commands.begin(), commands.end(), "18");
        EXPECT_GE(told, 15);
        EXPECT_LE(told, 20) << "every 50 ms, with queries between";
        if (accepts) {
            does = Does::carries_out;
            pass(base::Milliseconds{600});
        } else {
            driver.give_up_stop();
        }
        EXPECT_TRUE(driver.stop_confirmed());
        does = Does::carries_out;
        step = 0;
        pass(base::Milliseconds{500});
    }
}

}  // namespace
}  // namespace nplc::motor
