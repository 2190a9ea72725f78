#include "macreg/service.h"

#include <gtest/gtest.h>

#include "bench.h"

namespace nplc::macreg {
namespace {

using namespace std::chrono_literals;
using mactalk_client::Interrupted;

struct ServiceTest : testing::Test {
    Bench bench;
    int looks = 1000;  ///< until the user has had enough
    Service service{bench.motor, [this] { return --looks > 0; }};

    std::int64_t mode() const { return bench.at("MODE_REG"); }
};

// 001 §4.4.16, §5.1
TEST_F(ServiceTest, SafeModeIsEnteredFromInitAndLeftToInit) {
    service.enter_safe();
    EXPECT_EQ(mode(), 15);
    service.enter_safe();
    EXPECT_EQ(mode(), 15);
    service.exit_safe();
    EXPECT_EQ(mode(), 0);
    EXPECT_THROW(service.exit_safe(), NotDone);
}

TEST_F(ServiceTest, AMotorThatRunsIsNotStoppedUnlessAllowed) {
    bench.put("MODE_REG", 1);
    bench.run(500ms);
    EXPECT_THROW(service.enter_safe(), NotDone);
    EXPECT_EQ(mode(), 1);
    service.allow_stop();
    service.enter_safe();
    EXPECT_EQ(mode(), 15);
}

TEST_F(ServiceTest, SaveKeepsWhatIsInMemoryAndResets) {
    bench.put("V_SOLL", 777);
    EXPECT_TRUE(service.save().empty());
    EXPECT_EQ(bench.sim.flash_writes(), 1U);
    EXPECT_EQ(mode(), 0);
    bench.put("V_SOLL", 5);
    bench.sim.power_cycle();
    EXPECT_EQ(bench.at("V_SOLL"), 777);
}

TEST_F(ServiceTest, ResetForgetsWhatWasNotSaved) {
    bench.put("V_SOLL", 777);
    service.reset();
    EXPECT_EQ(bench.at("V_SOLL"), 1600);
    EXPECT_EQ(mode(), 0);
    EXPECT_EQ(bench.sim.flash_writes(), 0U);
}

TEST_F(ServiceTest, DefaultsAndReload) {
    bench.put("V_SOLL", 777);
    static_cast<void>(service.save());
    bench.put("V_SOLL", 5);
    service.reload();
    EXPECT_EQ(bench.at("V_SOLL"), 777);
    EXPECT_EQ(mode(), 0);
    service.defaults(false);
    EXPECT_EQ(bench.at("V_SOLL"), 1600);
    EXPECT_EQ(bench.sim.flash_writes(), 1U);
    service.defaults(true);
    EXPECT_EQ(bench.sim.flash_writes(), 2U);
    EXPECT_EQ(bench.at("V_SOLL"), 1600);
}

TEST_F(ServiceTest, AnInterruptionLeavesTheMotorAsItWasFound) {
    looks = 1;
    EXPECT_THROW(static_cast<void>(service.save()), Interrupted);
    EXPECT_EQ(mode(), 0);
    EXPECT_EQ(bench.sim.flash_writes(), 0U);
    bench.sim.enter_safe_mode();
    looks = 1;
    EXPECT_THROW(service.reset(), Interrupted);
    EXPECT_EQ(mode(), 15);
}

TEST_F(ServiceTest, NoiseDoesNotLoseAnOrder) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        Bench noisy(registers::Model::mac140, seed);
        noisy.put("V_SOLL", 777);
        noisy.wire.set_faults({.drop = 0.002, .damage = 0.002});
        Service(noisy.motor, {}).reset();
        EXPECT_EQ(noisy.at("V_SOLL"), 1600) << "seed " << seed;
        EXPECT_NE(noisy.at("MODE_REG"), 15) << "seed " << seed;
    }
}

TEST_F(ServiceTest, AMotorThatVanishesIsALineError) {
    bench.units.bytes_to_live = 100;
    EXPECT_THROW(static_cast<void>(service.save()), mactalk_client::LineError);
}

// Wherever the line breaks, what is said of the flash is true.
TEST_F(ServiceTest, ABrokenSaveTellsWhatBecameOfTheFlash) {
    int none = 0;
    int unknown = 0;
    int written = 0;
    for (std::size_t bytes = 1;; ++bytes) {
        Bench broken;
        broken.put("V_SOLL", 777);
        broken.units.bytes_to_live = bytes;
        Service saving(broken.motor, {});
        try {
            static_cast<void>(saving.save());
            break;
        } catch (const mactalk_client::LineError&) {
        }
        const std::string text = saving.left_behind();
        if (text.starts_with("the flash was not written")) {
            EXPECT_EQ(broken.sim.flash_writes(), 0U) << bytes;
            ++none;
        } else if (text.starts_with("the flash was written")) {
            EXPECT_EQ(broken.sim.flash_writes(), 1U) << bytes;
            ++written;
        } else {
            EXPECT_NE(text.find("not known"), std::string::npos) << text;
            ++unknown;
        }
        if (broken.at("MODE_REG") == 15) {
            EXPECT_NE(text.find("SAFE_MODE"), std::string::npos) << text;
        }
    }
    EXPECT_GT(none, 0);
    EXPECT_GT(unknown, 0);
    EXPECT_GT(written, 0);
}

TEST_F(ServiceTest, AMotorThatDoesNotStopIsNotCalledStopped) {
    bench.sim.plant().load().inertia_256 = 256 * 200;
    bench.put("A_SOLL", 2);
    bench.put("V_SOLL", 4000);
    bench.put("MODE_REG", 1);
    bench.run(3000ms);
    bench.sim.plant().load().torque = 1023;  // drives on
    service.allow_stop();
    EXPECT_THROW(service.reset(), NotDone);
    const std::string text = service.left_behind();
    EXPECT_NE(text.find("HAS NOT STOPPED"), std::string::npos) << text;
    EXPECT_NE(text.find("V_IST "), std::string::npos) << text;
    EXPECT_EQ(text.find("starts again"), std::string::npos) << text;
}

TEST_F(ServiceTest, AnInterruptionAfterTheStopSaysSo) {
    bench.put("MODE_REG", 1);
    bench.run(500ms);
    service.allow_stop();
    looks = 1;  // the first look is while it stops
    EXPECT_THROW(service.reset(), Interrupted);
    EXPECT_NE(service.left_behind().find("the motor was not reset"), std::string::npos);
    EXPECT_NE(service.left_behind().find("HAS NOT STOPPED"), std::string::npos) << service.left_behind();
}

}  // namespace
}  // namespace nplc::macreg
