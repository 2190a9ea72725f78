// The journal's messages on a stop that the motor does not confirm.
#include "stop_messages.h"

#include <gtest/gtest.h>

#include <vector>

namespace nplc::boards {
namespace {

using namespace std::chrono_literals;
using registers::gateway::Command;

struct Stop {
    Stop() { look(); }  // the motor has answered

    void look() {
        if (const auto message = messages.look(state, now)) said.push_back(*message);
        state.is_logged = false;
    }
    /// Looks every 10 ms.
    void rest(base::Microseconds time) {
        for (const auto end = now + time; now < end; now += 10ms) look();
        look();
    }
    void stop() {
        state.is_unconfirmed = true;
        command(Command::stop);
    }
    void command(Command command) { state.last_command = static_cast<std::uint32_t>(command); }
    void confirm(bool in_log) {
        state.is_unconfirmed = false;
        look();
        state.is_logged = in_log;
        look();
    }
    void give_up() {
        state.is_unconfirmed = false;
        command(Command::give_up_stop);
    }

    StopMessages messages;
    StopMessages::Look state{
        .is_unconfirmed = false, .link_is_usable = true, .is_logged = false, .last_command = 0};
    base::Instant now{100s};
    std::vector<StopMessages::Message> said;
};

TEST(StopMessages, OneThatIsConfirmedInTimeHasNone) {
    Stop motor;
    for (const bool in_log : {false, true}) {
        motor.stop();
        motor.rest(900ms);
        motor.confirm(in_log);
        motor.rest(5s);
    }
    EXPECT_TRUE(motor.said.empty());
    EXPECT_EQ(motor.messages.next(), base::kNever);
}

TEST(StopMessages, AfterASecondThereIsOneWarning) {
    Stop motor;
    motor.stop();
    motor.look();
    EXPECT_EQ(motor.messages.next(), motor.now + 1s);
    motor.rest(990ms);
    EXPECT_TRUE(motor.said.empty());
    motor.rest(60s);
    ASSERT_EQ(motor.said.size(), 1U);
    EXPECT_EQ(motor.said[0].level, LogLevel::warning);
    EXPECT_EQ(motor.said[0].text.find("the motor has not confirmed the stop for 1 s: it may be moving"), 0U);
    EXPECT_EQ(motor.messages.next(), base::kNever);
}

TEST(StopMessages, ALateConfirmationIsToldOnce) {
    for (const bool in_log : {false, true}) {
        Stop motor;
        motor.stop();
        motor.rest(3s);
        motor.confirm(in_log);
        motor.rest(3s);
        ASSERT_EQ(motor.said.size(), in_log ? 1U : 2U) << "the log's entry is told by itself";
        if (!in_log) {
            EXPECT_EQ(motor.said[1].text, "the motor has confirmed the stop now");
        }
        motor.stop();
        motor.rest(3s);
        EXPECT_EQ(motor.said.size(), in_log ? 2U : 3U) << "another stop, another warning";
    }
}

TEST(StopMessages, OneThatIsGivenUpIsToldWithWho) {
    Stop motor;
    motor.state.link_is_usable = false;
    for (const char* name : {"nanoctl (process 12)", ""}) {
        motor.said.clear();
        motor.state.operator_name = name;
        motor.stop();
        motor.rest(2s);
        motor.give_up();
        motor.rest(2s);
        ASSERT_EQ(motor.said.size(), 2U);
        EXPECT_EQ(motor.said[1].level, LogLevel::notice);
        const std::string by = *name == '\0' ? "" : " by nanoctl (process 12)";
        EXPECT_EQ(motor.said[1].text.find("the stop is given up" + by + ": THE MOTOR MAY BE MOVING"), 0U);
    }
}

TEST(StopMessages, AStopAfterOneThatWasGivenUpIsConfirmedNevertheless) {
    Stop motor;
    motor.stop();
    motor.look();
    motor.give_up();
    motor.look();
    motor.said.clear();
    motor.state.is_unconfirmed = true;  // of a lost link: no command
    motor.rest(3s);
    motor.confirm(true);
    motor.state.is_unconfirmed = true;
    motor.rest(3s);
    motor.confirm(false);
    ASSERT_EQ(motor.said.size(), 3U);
    EXPECT_EQ(motor.said[2].text, "the motor has confirmed the stop now");
}

TEST(StopMessages, AMotorThatComesUpWithTheBoardHasTime) {
    Stop motor;
    motor.messages.restart();
    motor.state.link_is_usable = false;
    motor.state.is_unconfirmed = true;
    motor.rest(4'900ms);
    EXPECT_TRUE(motor.said.empty());
    motor.rest(200ms);
    EXPECT_EQ(motor.said.size(), 1U);
}

}  // namespace
}  // namespace nplc::boards
