#include "macreg/change.h"

#include <gtest/gtest.h>

#include "bench.h"

namespace nplc::macreg {
namespace {

using namespace std::chrono_literals;

struct ChangeTest : testing::Test {
    Bench bench;
    ChangeResult set(std::string_view name, std::int64_t raw) {
        return change(bench.motor, bench.reg(name), raw);
    }
    void expect_refused(const ChangeResult& outcome, std::string_view part) const {
        EXPECT_FALSE(outcome.taken);
        EXPECT_NE(outcome.why.find(part), std::string::npos) << outcome.why;
    }
};

TEST_F(ChangeTest, TellsBeforeAndAfter) {
    const ChangeResult outcome = set("V_SOLL", 3146);
    EXPECT_TRUE(outcome.taken);
    EXPECT_EQ(outcome.before, 1600);
    EXPECT_EQ(outcome.after, 3146);
}

/// A line that is cut in a direction.
constexpr sim::LineFaults kCut{.drop = 1};

// 001 §5.1: 52h, the register, the length of a word, the value, each with its complement.
TEST_F(ChangeTest, AStopIsSentBeforeAnythingIsAsked) {
    bench.put("MODE_REG", 2);
    const ChangeResult outcome = set("MODE_REG", 0);
    EXPECT_TRUE(outcome.taken);
    EXPECT_FALSE(outcome.before.has_value());
    const std::vector<std::uint8_t> kWrite{0x52, 0x52, 0x52, 8, 0xF7, 2, 0xFD, 2, 0xFD, 0, 0xFF, 0, 0xFF};
    ASSERT_GE(bench.wire.sent().size(), kWrite.size());
    EXPECT_TRUE(std::equal(kWrite.begin(), kWrite.end(), bench.wire.sent().begin()));
}

TEST_F(ChangeTest, AMotorThatIsNotHeardIsStopped) {
    bench.put("MODE_REG", 2);
    bench.wire.from_unit().set_faults(kCut);
    try {
        set("MODE_REG", 0);
        FAIL() << "nothing confirmed it";
    } catch (const mactalk_client::LineError& error) {
        EXPECT_NE(std::string(error.what()).find(kMayMove), std::string::npos) << error.what();
    }
    EXPECT_EQ(bench.at("MODE_REG"), 0);
}

// R: a MAC800 takes longwords only; a longword on the others would change P_SOLL, too.
TEST(Change, AStopOfAnUnknownMotorChangesNoOtherRegister) {
    for (const auto model : {registers::Model::mac140, registers::Model::mac800}) {
        Bench bench(model);
        bench.put("V_SOLL", 0);  // it stands
        bench.put("P_SOLL", 0x12345678);
        bench.put("MODE_REG", 2);
        const bool is_large = model == registers::Model::mac800;
        EXPECT_EQ(stop_unasked(bench.master, kAddress, std::nullopt, 0, 2), !is_large);
        bench.run(1'000ms);
        EXPECT_EQ(bench.at("MODE_REG"), is_large ? 2 : 0);
        EXPECT_TRUE(stop_unasked(bench.master, kAddress, model, 0, 2));
        bench.run(1'000ms);
        EXPECT_EQ(bench.at("MODE_REG"), 0);
        EXPECT_EQ(bench.at("P_SOLL"), 0x12345678);
    }
}

TEST(Change, WhatIsAStop) {
    using registers::Model;
    const auto mode = [](Model model) { return *registers::find(model, registers::MODE_REG); };
    EXPECT_TRUE(is_stop(Model::mac140, mode(Model::mac140), 0));
    EXPECT_TRUE(is_stop(Model::mac140, mode(Model::mac140), 11));
    EXPECT_FALSE(is_stop(Model::mac140, mode(Model::mac140), 2));
    EXPECT_TRUE(is_stop(Model::mac800, mode(Model::mac800), 0));
    EXPECT_FALSE(is_stop(Model::mac800, mode(Model::mac800), 11)) << "004: reserved";
    EXPECT_FALSE(is_stop(Model::mac140, *registers::find(Model::mac140, registers::V_SOLL), 0));
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

// 001 §4.4.9 to §4.4.12: they end by themselves, TESTU after 11 samples of the inner loop.
TEST_F(ChangeTest, AModeThatEndsByItselfIsTaken) {
    for (const std::int64_t mode : {8, 9, 10, 22, 11}) {
        const ChangeResult outcome = set("MODE_REG", mode);
        EXPECT_TRUE(outcome.taken) << mode << ": " << outcome.why;
        EXPECT_EQ(outcome.remark.empty(), outcome.after == mode) << mode;
        bench.run(3000ms);
    }
    bench.sim.overload();
    bench.run(100ms);
    expect_refused(set("MODE_REG", 8), "I2T_ERR");
}

// 001 §3.2.160, §4.5.6
TEST(Change, ALowSupplyThatKeepsTheMotorPassiveIsNamed) {
    for (const auto model : {registers::Model::mac140, registers::Model::mac800}) {
        Bench bench(model);
        bench.put("UV_HANDLE", 2);
        if (model == registers::Model::mac140) bench.put("U_MIN_SUP", 400);  // 21 V
        bench.sim.supply().set_source(5);
        bench.run(3000ms);
        const ChangeResult outcome = change(bench.motor, bench.reg("MODE_REG"), 2);
        EXPECT_FALSE(outcome.taken);
        EXPECT_NE(outcome.why.find("UV_GO_PASSIVE"), std::string::npos) << outcome.why;
        EXPECT_EQ(outcome.why.find("no such mode"), std::string::npos) << outcome.why;
    }
}

TEST_F(ChangeTest, AnErrorWhoseCauseStaysCannotBeCleared) {
    bench.put("MAX_P_IST", -100);
    bench.put("MIN_P_IST", -200);
    bench.run(50ms);
    expect_refused(set("ERR_STAT", 0), "still there");
}

// 001 §3.2.35: RELPOSPFNC (10) and DIS_P_LIM (14) are settings among the errors; 7 is PLIM_ERR.
TEST_F(ChangeTest, ClearingErrorsKeepsTheSettingsBesideThem) {
    EXPECT_EQ(clear_errors_command(registers::Model::mac140, 1 << 14 | 1 << 10 | 1 << 7 | 1 << 4),
              "macreg set ERR_STAT RELPOSPFNC+DIS_P_LIM");
    EXPECT_EQ(clear_errors_command(registers::Model::mac140, 1 << 7), "macreg set ERR_STAT none");
    EXPECT_EQ(clear_errors_command(registers::Model::mac800, 1 << 14 | 1 << 13),
              "macreg set ERR_STAT DIS_P_LIM");
    bench.sim.overload();
    bench.run(100ms);
    bench.put("ERR_STAT", bench.at("ERR_STAT") | 1 << 10);
    expect_refused(set("MODE_REG", 2), "`macreg set ERR_STAT RELPOSPFNC`");
    const ChangeResult outcome = set("ERR_STAT", 0);
    EXPECT_TRUE(outcome.taken);
    EXPECT_NE(outcome.remark.find("RELPOSPFNC was a setting and is off now"), std::string::npos)
        << outcome.remark;
}

// 004: OLD_FILT_ERR is what the motor finds, and cannot be set.
TEST_F(ChangeTest, AnErrorThatTheMotorDoesNotFindCannotBeSet) {
    Bench large(registers::Model::mac800);
    const ChangeResult outcome = change(large.motor, large.reg("ERR_STAT"), 1 << 16);
    expect_refused(outcome, "cleared at once");
}

// 001 §3.2.163: of P_SOLL, P_IST and P_FNC only one is written, and P_MODE goes by the other two.
TEST_F(ChangeTest, APlaceWrittenAloneIsWarnedOf) {
    bench.put("CNTRL_BITS", 3);
    bench.put("P_SOLL", 122'000);
    bench.put("P_IST", 122'000);
    bench.put("P_FNC", 16 * 122'000);
    const ChangeResult outcome = set("P_IST", 0);
    EXPECT_TRUE(outcome.taken);
    EXPECT_NE(outcome.remark.find("`macreg set P_NEW 0 CNTRL_BITS USERINTF=COMMUNICATION+MAN_RESYNC`"),
              std::string::npos)
        << outcome.remark;
    EXPECT_NE(outcome.remark.find("AUTO_RESYNC"), std::string::npos);
    set("P_NEW", 0);
    EXPECT_TRUE(set("CNTRL_BITS", 3 | 1 << 10).taken);
    bench.run(50ms);
    EXPECT_EQ(bench.at("P_FNC"), 0);
    EXPECT_EQ(bench.at("P_SOLL"), 0);
    EXPECT_EQ(bench.at("CNTRL_BITS") & 0x1FFF, 3);
    EXPECT_EQ(set("P_IST", 0).remark, "");
    bench.put("CNTRL_BITS", 3 | 1 << 9);  // AUTO_RESYNC, 001 §3.2.36
    EXPECT_EQ(set("P_IST", 5000).remark, "");
}

// 001 §4.4.8 to §4.4.11, §3.2.22: modes for tests turn the shaft without regulation. 004: reserved.
TEST_F(ChangeTest, TestModesAreDangerous) {
    using registers::Model;
    for (const Model model : {Model::mac140, Model::mac800}) {
        const registers::Register& mode = *registers::find(model, registers::MODE_REG);
        const registers::Register& start = *registers::find(model, registers::STARTMODE);
        for (const int raw : {7, 8, 9, 10}) {
            EXPECT_NE(danger(model, mode, raw).find("tests"), std::string::npos) << raw;
            EXPECT_NE(danger(model, start, raw).find("after every reset"), std::string::npos) << raw;
        }
        for (const int raw : {0, 1, 2, 3, 11, 12, 21}) EXPECT_EQ(danger(model, mode, raw), "") << raw;
    }
    EXPECT_NE(danger(Model::mac140, bench.reg("MODE_REG"), 22), "");
    EXPECT_NE(danger(Model::mac140, bench.reg("MODE_REG"), 23), "");
    EXPECT_NE(danger(Model::mac140, bench.reg("U_MIN_SUP"), 1), "");
    EXPECT_EQ(danger(Model::mac140, bench.reg("V_SOLL"), 9), "");
}

TEST_F(ChangeTest, ReadOnlyIsToldAsSuch) {
    bench.put("MODE_REG", 1);
    bench.run(500ms);
    expect_refused(set("V_IST", 0), "read only");
}

TEST_F(ChangeTest, ANewAddressIsReadUnderItself) {
    const ChangeResult outcome = set("MYADDR", 9);
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
    const ChangeResult outcome = set("P_IST", 0);
    EXPECT_TRUE(outcome.taken);
    EXPECT_NE(outcome.after, 0);
}

TEST(Gateway, ItsSettingHasTheNumberThatIsStored) {
    EXPECT_EQ(registers::gateway::register_of(registers::gateway::Setting::motor_writes), 210);
}

TEST_F(ChangeTest, AMotorThatDoesNotAnswerIsALineError) {
    bench.units.dead = true;
    EXPECT_THROW(set("V_SOLL", 5), mactalk_client::LineError);
}

}  // namespace
}  // namespace nplc::macreg
