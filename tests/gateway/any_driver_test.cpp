#include "motor/any_driver.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "port_bench.h"

namespace nplc::gateway {
namespace {

using motor::Order;
using store::Setting;

constexpr Order kHoming{.command = 0x70};  // 60h + 10h
constexpr Order kPositionP1{.command = 0x40};

store::SettingValues with(std::vector<std::pair<Setting, std::uint32_t>> settings) {
    store::SettingValues values;
    for (const auto& [setting, value] : settings) EXPECT_TRUE(values.set(setting, value).ok());
    return values;
}

struct Chosen {
    Chosen(ports::SerialPort& line, const store::SettingValues& values)
        : motor_(place_.start({.serial = &line}, driver_settings_of(values))) {}
    motor::Motor& motor() { return motor_; }

  private:
    motor::AnyDriver place_;
    motor::Motor& motor_;
};

TEST(AnyDriver, IsAJvlMotorAtFirst) {
    InstantLine line;
    Chosen chosen(line, store::SettingValues());
    EXPECT_TRUE(chosen.motor().can_execute(kHoming));
    EXPECT_FALSE(chosen.motor().longwords_only());
    Chosen large(line, with({{Setting::motor_is_mac800, 1}}));
    EXPECT_TRUE(large.motor().longwords_only());
}

TEST(AnyDriver, IsAMidiDriveIfTheSettingSaysSo) {
    for (const std::uint32_t kind : {1U, 2U, 3U}) {
        InstantLine line;
        Chosen chosen(line, with({{Setting::motor_kind, kind}}));
        EXPECT_FALSE(chosen.motor().can_execute(kHoming)) << kind;
        EXPECT_TRUE(chosen.motor().can_execute(kPositionP1)) << kind;
    }
}

/// INPOSWIN 200 is 488 increments of a MAC34 and 97 of a MAC23 (10000 and 2000 a revolution of 4096 counts).
TEST(AnyDriver, IsTheModelThatTheSettingNames) {
    constexpr Order kWindow{.is_register_write = true, .reg = 33, .value = 200};
    InstantLine line;
    Chosen small(line, with({{Setting::motor_kind, 1}}));
    Chosen large(line, with({{Setting::motor_kind, 2}}));
    EXPECT_TRUE(small.motor().can_execute(kWindow));
    EXPECT_FALSE(large.motor().can_execute(kWindow));
}

/// 000 §II: GET_STATUS is 21h; 30h + 35h + 32h + 31h and ten times 30h are 2A8h.
TEST(AnyDriver, AsksTheDriveOfTheAddressThatIsSet) {
    InstantLine line;
    Chosen chosen(
        line, with({{Setting::motor_kind, 2}, {Setting::midi_address, 5}, {Setting::motor_baud, 38'400}}));
    chosen.motor().poll(base::Instant{});
    EXPECT_EQ(std::string(line.sent.begin(), line.sent.end()),
              "\x02"
              "014"
              "0521"
              "0000000000"
              "A8\x03");
}

}  // namespace
}  // namespace nplc::gateway
