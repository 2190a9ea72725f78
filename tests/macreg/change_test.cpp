#include "macreg/change.h"

#include <gtest/gtest.h>

#include "bench.h"

namespace nplc::macreg {
namespace {

using namespace std::chrono_literals;

struct ChangeTest : testing::Test {
    Bench bench;
    Outcome set(std::string_view name, std::int64_t raw) { return change(bench.motor, bench.reg(name), raw); }
    void expect_refused(const Outcome& outcome, std::string_view part) const {
        EXPECT_FALSE(outcome.taken);
        EXPECT_NE(outcome.why.find(part), std::string::npos) << outcome.why;
    }
};

TEST_F(ChangeTest, TellsBeforeAndAfter) {
    const Outcome outcome = set("V_SOLL", 3146);
    EXPECT_TRUE(outcome.taken);
    EXPECT_EQ(outcome.before, 1600);
    EXPECT_EQ(outcome.after, 3146);
}

// 001 §3.2.43: the pointer becomes 0 when the copy is made.
TEST_F(ChangeTest, APointerThatWasServedIsTaken) {
    EXPECT_TRUE(set("P_REG_P", 1).taken);
    expect_refused(set("V_REG_P", 9), "no register");
}

// 001 §4.4.16
TEST_F(ChangeTest, ModeInSafeMode) {
    bench.sim.enter_safe_mode();
    expect_refused(set("MODE_REG", 2), "macreg safe exit");
    bench.sim.leave_safe_mode();
    expect_refused(set("MODE_REG", 15), "macreg safe enter");
    bench.sim.enter_safe_mode();
    bench.put("GEARF1", 77);
    expect_refused(set("MODE_REG", 256), "macreg flash defaults");
    EXPECT_EQ(bench.motor.read(bench.reg("GEARF1")), 77) << "it was not sent";
}

TEST_F(ChangeTest, ModeWithAnErrorIsRefusedWithTheError) {
    bench.sim.overload();
    bench.run(100ms);
    expect_refused(set("MODE_REG", 2), "I2T_ERR");
    EXPECT_TRUE(set("ERR_STAT", 0).taken);
    EXPECT_TRUE(set("MODE_REG", 2).taken);
}

TEST_F(ChangeTest, AnErrorWhoseCauseStaysCannotBeCleared) {
    bench.put("MAX_P_IST", -100);
    bench.put("MIN_P_IST", -200);
    bench.run(50ms);
    expect_refused(set("ERR_STAT", 0), "still there");
}

TEST_F(ChangeTest, ReadOnlyIsToldAsSuch) {
    bench.put("MODE_REG", 1);
    bench.run(500ms);
    expect_refused(set("V_IST", 0), "read only");
}

TEST_F(ChangeTest, ANewAddressIsReadUnderItself) {
    const Outcome outcome = set("MYADDR", 9);
    EXPECT_TRUE(outcome.taken);
    EXPECT_EQ(outcome.after, 9);
    EXPECT_NE(outcome.remark.find("--address 9"), std::string::npos);
}

TEST_F(ChangeTest, InputBitsAreToldToActAfterAReset) {
    EXPECT_NE(set("CNTRL_BITS", 0).remark.find("flash save"), std::string::npos);
    EXPECT_EQ(set("V_SOLL", 5).remark, "");
}

TEST_F(ChangeTest, WhatMovesByItselfIsTaken) {
    bench.put("MODE_REG", 1);
    bench.run(500ms);
    const Outcome outcome = set("P_IST", 0);
    EXPECT_TRUE(outcome.taken);
    EXPECT_NE(outcome.after, 0);
}

TEST_F(ChangeTest, AMotorThatDoesNotAnswerIsALineError) {
    bench.units.dead = true;
    EXPECT_THROW(set("V_SOLL", 5), mactalk_client::LineError);
}

}  // namespace
}  // namespace nplc::macreg
