#include "store/settings.h"

#include <gtest/gtest.h>

#include <iostream>
#include <set>
#include <string_view>

#include "store/settings_store.h"
#include "store_bench.h"

namespace nplc::store {
namespace {

using registers::gateway::all_settings;
using registers::gateway::find_setting;
using registers::gateway::is_allowed;
using registers::gateway::kNone;
using registers::gateway::SettingInfo;

Phase save(SettingsStore& settings, const SettingValues& values) {
    if (!settings.save(values)) return Phase::failed;
    for (int i = 0; i < 100'000 && settings.phase() != Phase::done && settings.phase() != Phase::failed; ++i)
        settings.poll();
    return settings.phase();
}

TEST(Settings, AreListedByNumberWithInitialValuesThatAreAllowed) {
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < kSettings; ++i) {
        const SettingInfo& info = all_settings()[i];
        EXPECT_EQ(static_cast<std::size_t>(info.id), i + 1);
        EXPECT_EQ(find_setting(static_cast<std::uint8_t>(i + 1)), &info);
        EXPECT_TRUE(is_allowed(info.id, info.initial)) << info.name;
        EXPECT_FALSE(info.help.empty());
        EXPECT_TRUE(names.insert(info.name).second) << info.name;
        EXPECT_EQ(SettingValues().get(info.id), info.initial);
    }
    EXPECT_EQ(find_setting(0), nullptr);
    EXPECT_EQ(find_setting(kSettings + 1), nullptr);
}

TEST(Settings, TakeTheirValuesAndNoOthers) {
    for (const SettingInfo& info : all_settings()) {
        SettingValues values;
        EXPECT_TRUE(values.set(info.id, info.lowest).ok());
        EXPECT_TRUE(values.set(info.id, info.highest).ok());
        EXPECT_EQ(values.get(info.id), info.highest);
        if (info.lowest > 0) {
            EXPECT_EQ(values.set(info.id, info.lowest - 1).error(), base::Error::bad_setting);
        }
        if (info.highest + 1 != kNone) {
            EXPECT_EQ(values.set(info.id, info.highest + 1).error(), base::Error::bad_setting) << info.name;
        }
        const bool inside = info.lowest <= kNone && kNone <= info.highest;
        EXPECT_EQ(values.set(info.id, kNone).ok(), info.has_none || inside) << info.name;
    }
    EXPECT_EQ(SettingValues().set(static_cast<Setting>(kSettings + 1), 1).error(), base::Error::bad_setting);
    EXPECT_FALSE(is_setting(0)) << "that somebody has commanded run is not the user's to set";
    EXPECT_TRUE(SettingValues().set(Setting::waits_for_run, 6).ok());
    EXPECT_EQ(SettingValues().set(Setting::waits_for_run, 7).error(), base::Error::bad_setting);
}

TEST(Settings, OfSpeedsOnlyStandardOnes) {
    for (const Setting setting : {Setting::user_baud, Setting::motor_baud}) {
        SettingValues values;
        for (const std::uint32_t baud :
             {0U, 600U, 1'201U, 14'400U, 19'201U, 76'800U, 100'000U, 1'843'200U, 0xFFFF'FFFFU})
            EXPECT_EQ(values.set(setting, baud).error(), base::Error::bad_setting) << baud;
        for (const std::uint32_t baud : {1'200U, 2'400U, 4'800U, 9'600U, 19'200U, 38'400U, 57'600U, 115'200U,
                                         230'400U, 460'800U, 921'600U})
            EXPECT_TRUE(values.set(setting, baud).ok()) << baud;
    }
}

TEST(Settings, AreStoredAsNumberAndFourBytes) {
    SettingValues values;
    ASSERT_TRUE(values.set(Setting::gateway_address, 5).ok());
    ASSERT_TRUE(values.set(Setting::motor_baud, 115'200).ok());  // 0001C200h
    ASSERT_TRUE(values.set(Setting::waits_for_run, 6).ok());
    std::array<std::uint8_t, kMaxSettingsBytes> bytes{};
    encode(values, bytes);
    EXPECT_EQ(Bytes(bytes.begin(), bytes.begin() + 5), (Bytes{0, 6, 0, 0, 0}));
    EXPECT_EQ(Bytes(bytes.begin() + 5, bytes.begin() + 10), (Bytes{1, 5, 0, 0, 0}));
    EXPECT_EQ(Bytes(bytes.begin() + 15, bytes.begin() + 20), (Bytes{3, 0x00, 0xC2, 0x01, 0x00}));
    const auto back = decode_settings(bytes);
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(back.value(), values);
}

TEST(Settings, UnknownOnesAreLeftOutMissingOnesInitialWrongOnesRefused) {
    const Bytes some{200, 1, 2, 3, 4, 12, 0x10, 0x27, 0, 0};  // 2710h = 10000
    const auto values = decode_settings(some);
    ASSERT_TRUE(values.ok());
    EXPECT_EQ(values.value().get(Setting::force_timeout), 10'000U);
    EXPECT_EQ(values.value().get(Setting::debounce), 3'000U);
    EXPECT_EQ(decode_settings(Bytes{6, 16, 0, 0, 0}).error(), base::Error::bad_setting);
    EXPECT_EQ(decode_settings(Bytes{6, 15, 0, 0}).error(), base::Error::bad_setting);
}

struct SettingsStoreTest : testing::Test {
    const Shape shape = shapes(kMaxSettingsBytes).front();
    sim::SimStorage device{shape.geometry};
};

TEST_F(SettingsStoreTest, KeepsThem) {
    SettingsStore settings(device, shape.area);
    ASSERT_EQ(settings.mount().value(), SettingValues());
    SettingValues values;
    ASSERT_TRUE(values.set(Setting::safe_outputs, 5).ok());
    ASSERT_EQ(save(settings, values), Phase::done);
    EXPECT_EQ(SettingsStore(device, shape.area).mount().value(), values);
}

/// A later firmware has more settings.
TEST_F(SettingsStoreTest, TwiceAsManyAreRead) {
    const Shape large = shapes(4 * kMaxSettingsBytes).front();
    sim::SimStorage flash{large.geometry};
    Bytes bytes(2 * kMaxSettingsBytes, 0);
    for (std::size_t at = 0; at < bytes.size(); at += 5) bytes[at] = 200;
    bytes[bytes.size() - 5] = 7;  // debounce
    bytes[bytes.size() - 4] = 0xD0;
    bytes[bytes.size() - 3] = 0x07;  // 7D0h = 2000
    write_raw(flash, large.area, Kind::settings, bytes);
    const auto values = SettingsStore(flash, large.area).mount();
    ASSERT_TRUE(values.ok());
    EXPECT_EQ(values.value().get(Setting::debounce), 2'000U);
    bytes.insert(bytes.end(), {200, 0, 0, 0, 0});
    write_raw(flash, large.area, Kind::settings, bytes);
    EXPECT_EQ(SettingsStore(flash, large.area).mount().error(), base::Error::no_space);
}

TEST_F(SettingsStoreTest, PowerCutsLeaveOldOrNewOnes) {
    SettingValues old;
    SettingValues next;
    ASSERT_TRUE(old.set(Setting::safe_outputs, 5).ok());
    ASSERT_TRUE(next.set(Setting::safe_outputs, 10).ok());
    {
        SettingsStore settings(device, shape.area);
        ASSERT_TRUE(settings.mount().ok());
        ASSERT_EQ(save(settings, next), Phase::done);
        ASSERT_EQ(save(settings, old), Phase::done);
    }
    int cases = 0;
    device.watch([&](const sim::StorageOperation& operation) {
        for (const sim::Tear& tear : sim::tears_of(operation, shape.geometry)) {
            sim::SimStorage torn = device.torn(operation, tear);
            const auto found = SettingsStore(torn, shape.area).mount();
            ASSERT_TRUE(found.ok());
            EXPECT_TRUE(found.value() == old || found.value() == next);
            ++cases;
        }
    });
    SettingsStore settings(device, shape.area);
    ASSERT_TRUE(settings.mount().ok());
    ASSERT_EQ(save(settings, next), Phase::done);
    EXPECT_GT(cases, 100);
    std::cout << cases << " cases\n";
}

TEST_F(SettingsStoreTest, DamageIsSaid) {
    SettingsStore settings(device, shape.area);
    ASSERT_TRUE(settings.mount().ok());
    ASSERT_EQ(save(settings, SettingValues()), Phase::done);
    device.flip(Layout(shape.geometry, shape.area).content(0), 0);
    EXPECT_EQ(SettingsStore(device, shape.area).mount().error(), base::Error::damaged);
}

}  // namespace
}  // namespace nplc::store
