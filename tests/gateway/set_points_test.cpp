// Set-points and recipes as firmware/gateway/SET_POINTS.md has them.
#include "set_points_bench.h"

#include <gtest/gtest.h>

namespace nplc::gateway {
namespace {

using reg::Command;
using reg::Event;
using reg::Result;
using Three = SetPointBench::Three;

struct SetPointsTest : testing::Test, SetPointBench {};

TEST_F(SetPointsTest, TheTableAndItsCheckSumsStayThoseThatWereUploaded) {
    const Uploaded bytes = content();
    ASSERT_TRUE(upload_and_activate(bytes));
    EXPECT_EQ(in_force(), kDefaults);
    ASSERT_TRUE(change({{0, 70000}, {2, 20}}));
    EXPECT_EQ(in_force(), (Three{70000, 1000, 20}));
    EXPECT_EQ(read(reg::TABLE_CRC), base::crc32(table()));
    EXPECT_EQ(read(reg::TABLE_BYTES), table().size());
    EXPECT_EQ(read(reg::STORED_CRC), base::crc32(bytes));
    EXPECT_EQ(status() & reg::kStoredDiffers, 0U);
    for (std::uint32_t at : {0U, 4U, 30U}) {
        ASSERT_TRUE(write(reg::TABLE_POINTER, at));
        const auto back = block(reg::TABLE_DATA);
        ASSERT_TRUE(back);
        for (std::size_t i = 0; i < 64; ++i)
            EXPECT_EQ(back->data[i], at + i < table().size() ? table()[at + i] : 0) << at << '+' << i;
    }
}

TEST_F(SetPointsTest, TheRecordIsReadBackAsItWasUploaded) {
    ASSERT_TRUE(upload_and_activate(content()));
    const auto bytes = set_points::encode(record());
    EXPECT_EQ(read(reg::SET_POINT_BYTES), bytes.size());
    EXPECT_EQ(read(reg::SET_POINT_RECORD), base::crc32(bytes));
    EXPECT_EQ(read(reg::SET_POINT_COUNT), 3U | 16U << 8 | 8U << 16);
    for (std::size_t at = 0; at < bytes.size(); at += 60) {
        ASSERT_TRUE(write(reg::SET_POINT_POINTER, static_cast<std::uint32_t>(at)));
        const auto back = block(reg::SET_POINT_POINTER);
        ASSERT_TRUE(back);
        EXPECT_EQ(base::load_u32(back->data.data()), at);
        for (std::size_t i = 0; i < 60; ++i)
            EXPECT_EQ(back->data[4 + i], at + i < bytes.size() ? bytes[at + i] : 0);
    }
}

TEST_F(SetPointsTest, WhatIsRefusedChangesNothing) {
    ASSERT_TRUE(upload_and_activate(content()));
    const auto refused = [&](const Uploaded& bytes, Result why, std::uint32_t detail = 0) {
        EXPECT_FALSE(ask_for(bytes));
        EXPECT_EQ(result(), result_of(why, reg::SET_POINT_WRITE, detail));
        EXPECT_EQ(wanted(), kDefaults);
    };
    refused(request(record(), Request::change, {{0, 1}, {2, 0}}), Result::out_of_range, 2);
    refused(request(record(), Request::change, {{0, 1}, {2, 5001}}), Result::out_of_range, 2);
    refused(request(record(), Request::change, {{0, -4097}}), Result::out_of_range, 0);
    Uploaded other_unit = request(record(), Request::change, {{0, 1}, {1, 200}});
    other_unit[21] = 2;
    refused(other_unit, Result::wrong_unit, 1);
    Uploaded other_table = request(record(), Request::change, {{0, 1}});
    other_table[0] ^= 1;
    refused(other_table, Result::other_table);
    refused(request(record(), Request::change, {}), Result::bad_value);
    refused(request(record(), Request::change, {{0, 1}}, 1), Result::no_recipe);
    refused(request(record(), Request::load_recipe, {}, 1), Result::no_recipe);
    refused(request(record(), Request::load_recipe, {}, 9), Result::no_recipe);
    refused(request(record(), Request::load_recipe, {}, 0), Result::no_recipe);
    refused(request(record(), Request::save_recipe, {}, 1, "One"), Result::no_recipe);
    refused(request(record(), Request::save_recipe, {}), Result::bad_value);
    refused(request(record(), Request::save_recipe, {}, 0, "sixteen letters."), Result::bad_value);
    Uploaded too_many = request(record(), Request::change, {{0, 1}});
    too_many[6] = 9;
    refused(too_many, Result::bad_value);
    Uploaded longer = request(record(), Request::change, {{0, 1}});
    longer.resize(longer.size() + 4);
    refused(longer, Result::bad_length);
    board.missing_register = 65;
    refused(request(record(), Request::change, {{0, 1}, {1, 200}}), Result::not_for_motor, 1);
}

/// Step 1 takes changes; step 2 does not.
TEST_F(SetPointsTest, ARunningSequenceTakesThemOnlyWhereItSays) {
    ASSERT_TRUE(upload_and_activate(content()));
    ASSERT_TRUE(command(Command::run));
    run(20ms);
    ASSERT_EQ(gateway->state().step, 1);
    board.in = 1;
    run(20ms);
    ASSERT_EQ(gateway->state().step, 2);
    board.sent.clear();
    board.room = 8;
    ASSERT_TRUE(change({{0, 70000}, {1, 2000}, {2, 20}}));
    run(50ms);
    EXPECT_EQ(in_force(), kDefaults);
    EXPECT_TRUE(change_waits());
    EXPECT_TRUE(board.sent.empty());
    board.in = 2;
    run(20ms);
    EXPECT_EQ(gateway->state().step, 1);
    EXPECT_EQ(in_force(), (Three{70000, 2000, 20}));
    EXPECT_FALSE(change_waits());
    ASSERT_EQ(board.sent.size(), 2U);  // the timer's needs no order
    EXPECT_EQ(board.sent[0],
              (motor::Order{.is_register_write = true, .reg = 51, .longword = true, .value = 70000}));
    EXPECT_EQ(board.sent[1],
              (motor::Order{.is_register_write = true, .reg = 65, .longword = false, .value = 2000}));
    board.in = 1;
    run(8ms);
    EXPECT_EQ(gateway->state().step, 2);
    EXPECT_LE(gateway->state().timer, 20);
}

/// Values go to the motor before the step's first order, and while it has no room nothing is half done.
TEST_F(SetPointsTest, NothingIsTakenWhileTheMotorIsBusyOrItsLinkIsDown) {
    ASSERT_TRUE(upload_and_activate(content()));
    ASSERT_TRUE(command(Command::run));
    run(20ms);
    board.link_state = motor::Link::down;
    run(10ms);
    ASSERT_TRUE(change({{0, 70000}}));
    run(20ms);
    EXPECT_EQ(in_force(), kDefaults);
    board.link_state = motor::Link::up;
    board.err = true;
    run(20ms);
    EXPECT_EQ(in_force(), kDefaults);
    board.err = false;
    board.sent.clear();
    run(20ms);
    EXPECT_EQ(in_force(), (Three{70000, 1000, 500}));
    ASSERT_EQ(board.sent.size(), 1U);
}

TEST_F(SetPointsTest, AMoveIsNotDisturbed) {
    // Step 1 selects P2 in position mode (40h + 1) whenever IN0 is on, and stays.
    Uploaded bytes = table();
    bytes[24 + 3] = 0x3E;
    bytes[24 + 4] = 0x41;
    const auto behind = set_points::encode(record());
    bytes.insert(bytes.end(), behind.begin(), behind.end());
    ASSERT_TRUE(upload_and_activate(bytes));
    board.room = 100;
    ASSERT_TRUE(command(Command::run));
    run(20ms);
    board.in = 1;
    run(10ms);
    board.in = 0;
    board.in_pos = false;
    run(10ms);
    ASSERT_TRUE(change({{0, 70000}}));
    run(50ms);
    EXPECT_EQ(in_force(), kDefaults) << "the move has not ended";
    board.in_pos = true;
    run(10ms);
    EXPECT_EQ(in_force(), (Three{70000, 1000, 500}));
}

TEST_F(SetPointsTest, ARestartKeepsThem) {
    ASSERT_TRUE(upload_and_activate(content()));
    ASSERT_TRUE(change({{0, 70000}}));
    ASSERT_TRUE(command(Command::run));
    run(20ms);
    start({.autostart = false});
    EXPECT_EQ(in_force(), (Three{70000, 1000, 500}));
    board.sent.clear();
    board.room = 100;
    ASSERT_TRUE(command(Command::run));
    run(20ms);
    ASSERT_GE(board.sent.size(), 2U);
    EXPECT_EQ(board.sent[0].value, 70000U) << "POWER_UP writes it";
}

/// A new version of the program: Speed has another range, Dwell another unit, Length is as it was.
TEST_F(SetPointsTest, ANewUploadKeepsWhatStillFits) {
    ASSERT_TRUE(upload_and_activate(content()));
    ASSERT_TRUE(change({{0, 70000}, {1, 2500}, {2, 20}}));
    set_points::Record next = record();
    next.values[1].highest = 2000;
    next.values[2].unit_code = registers::set_points::kCount;
    ASSERT_TRUE(upload_and_activate(content(next)));
    EXPECT_EQ(in_force(), (Three{70000, 1000, 500}));
    EXPECT_EQ(logged(Event::set_points_dropped), 1U);
    EXPECT_EQ(last_detail(Event::set_points_dropped), 0b110U);
    ASSERT_TRUE(upload_and_activate(content()));
    EXPECT_EQ(in_force(), (Three{70000, 2500, 20}))
        << "nothing was changed meanwhile: the first program's are there";
}

TEST_F(SetPointsTest, RecipesAreSavedLoadedAndDeleted) {
    ASSERT_TRUE(upload_and_activate(content()));
    ASSERT_TRUE(save("Default"));
    ASSERT_TRUE(change({{0, 70000}, {2, 20}}));
    ASSERT_TRUE(save("Long"));
    ASSERT_TRUE(ask_for(request(record(), Request::put_recipe, {{0, 5}, {1, 200}, {2, 9}}, 0, "Short")));
    EXPECT_EQ(in_force(), (Three{70000, 1000, 20})) << "putting one changes nothing";
    EXPECT_EQ(active_recipe(), 0U);
    ASSERT_TRUE(recipe(Request::load_recipe, 3));
    EXPECT_EQ(in_force(), (Three{5, 200, 9}));
    EXPECT_EQ(active_recipe(), 3U);
    ASSERT_TRUE(change({{0, 6}}));
    EXPECT_NE(read(reg::SET_POINT_STATE).value_or(0) & reg::kRecipeDiffers, 0U);
    start({.autostart = false});
    EXPECT_EQ(in_force(), (Three{6, 200, 9}));
    EXPECT_EQ(active_recipe(), 3U);
    ASSERT_TRUE(recipe(Request::load_recipe, 1));
    EXPECT_EQ(in_force(), kDefaults);
    ASSERT_TRUE(recipe(Request::delete_recipe, 1));
    EXPECT_EQ(active_recipe(), 0U);
    EXPECT_FALSE(recipe(Request::load_recipe, 1));
    ASSERT_TRUE(write(reg::SET_POINT_POINTER, 2U << 16));
    const auto shown = block(reg::SET_POINT_POINTER);
    ASSERT_TRUE(shown);
    EXPECT_EQ(std::string(shown->data.begin() + 4, shown->data.begin() + 8), "Long");
}

/// Its recipes were made for another program: they stay, and what does not fit has its default.
TEST_F(SetPointsTest, ATableIsExchangedUnderActiveRecipes) {
    ASSERT_TRUE(upload_and_activate(content()));
    ASSERT_TRUE(ask_for(request(record(), Request::put_recipe, {{0, 5}, {1, 2500}, {2, 9}}, 0, "Short")));
    ASSERT_TRUE(recipe(Request::load_recipe, 1));
    set_points::Record next = record();
    next.values[1].highest = 2000;
    next.values[0].name = "Width";
    ASSERT_TRUE(upload_and_activate(content(next)));
    EXPECT_EQ(in_force(), (Three{65536, 1000, 9}));
    EXPECT_FALSE(recipe(Request::load_recipe, 1)) << "asked with the old record";
    EXPECT_EQ(result() & 0xFF, static_cast<std::uint32_t>(Result::other_table));
    ASSERT_TRUE(ask_for(request(next, Request::load_recipe, {}, 1)));
    EXPECT_EQ(in_force(), (Three{65536, 1000, 9}));
    EXPECT_GE(logged(Event::set_points_dropped), 1U);
    EXPECT_EQ(last_detail(Event::set_points_dropped), 0b011U);
    ASSERT_TRUE(upload_and_activate(content()));
    ASSERT_TRUE(recipe(Request::load_recipe, 1));
    EXPECT_EQ(in_force(), (Three{5, 2500, 9}));
}

TEST_F(SetPointsTest, TheLogSaysWhoWhenAndWhat) {
    ASSERT_TRUE(upload_and_activate(content()));
    ASSERT_TRUE(change({{0, 70000}, {2, 20}}));
    EXPECT_EQ(read(reg::SET_POINT_CHANGES), 2U);
    EXPECT_EQ(logged(Event::set_points_changed), 1U);
    ASSERT_TRUE(write(reg::SET_POINT_POINTER, 255U << 16));
    const auto shown = block(reg::SET_POINT_POINTER);
    ASSERT_TRUE(shown);
    const std::vector<std::uint8_t> data(shown->data.begin() + 4, shown->data.end());
    EXPECT_EQ(data[4], 2);  // Dwell came last
    EXPECT_EQ(data[5], static_cast<std::uint8_t>(reg::Origin::user_port));
    EXPECT_EQ(base::load_u32(&data[8]), 500U);
    EXPECT_EQ(base::load_u32(&data[12]), 20U);
    EXPECT_EQ(data[16 + 4], 0);
    EXPECT_EQ(base::load_u32(&data[16 + 8]), 65536U);
    EXPECT_EQ(base::load_u32(&data[16 + 12]), 70000U);
    EXPECT_NE(base::load_u32(data.data()), 0U);
}

/// A client may read the view in parts of any length.
TEST_F(SetPointsTest, ChangesAreOneViewOfBytes) {
    ASSERT_TRUE(upload_and_activate(content()));
    for (std::int32_t i = 0; i < 9; ++i) ASSERT_TRUE(change({{0, 70000 + i}, {2, 20 + i}}));
    std::vector<std::uint8_t> bytes;
    for (std::uint32_t at = 0; at < 16 * reg::kChangeBytes; at += reg::kSetPointDataBytes) {
        ASSERT_TRUE(write(reg::SET_POINT_POINTER, 255U << 16 | at));
        const auto shown = block(reg::SET_POINT_POINTER);
        ASSERT_TRUE(shown);
        bytes.insert(bytes.end(), shown->data.begin() + 4, shown->data.begin() + 4 + reg::kSetPointDataBytes);
    }
    for (std::size_t age = 0; age < 16; ++age) {
        const std::uint8_t* one = &bytes[age * reg::kChangeBytes];
        const auto order = static_cast<std::uint32_t>(8 - age / 2);
        EXPECT_EQ(one[4], age % 2 == 0 ? 2 : 0) << age;
        EXPECT_EQ(one[5], static_cast<std::uint8_t>(reg::Origin::user_port)) << age;
        EXPECT_EQ(base::load_u32(one + 12), (age % 2 == 0 ? 20 : 70000) + order) << age;
    }
    for (std::size_t i = 16 * reg::kChangeBytes; i < bytes.size(); ++i) EXPECT_EQ(bytes[i], 0) << i;
}

/// Their numbers would be those of other values.
TEST_F(SetPointsTest, ChangesOfAnotherTableAreNotShown) {
    ASSERT_TRUE(upload_and_activate(content()));
    ASSERT_TRUE(change({{0, 70000}, {2, 20}}));
    ASSERT_TRUE(upload_and_activate(content()));
    EXPECT_EQ(controller->set_points().shown_changes(), 2U) << "the same table once more";
    set_points::Record next = record();
    next.values[1].name = "Pace";
    ASSERT_TRUE(upload_and_activate(content(next)));
    EXPECT_EQ(controller->set_points().shown_changes(), 0U);
    ASSERT_TRUE(write(reg::SET_POINT_POINTER, 255U << 16));
    const auto shown = block(reg::SET_POINT_POINTER);
    ASSERT_TRUE(shown);
    EXPECT_EQ(shown->data[4 + 5], 0) << "nobody";
    ASSERT_TRUE(ask_for(request(next, Request::change, {{0, 5}})));
    EXPECT_EQ(controller->set_points().shown_changes(), 1U);
    EXPECT_EQ(read(reg::SET_POINT_CHANGES), 3U) << "since the start";
}

TEST_F(SetPointsTest, ATableWithoutAnyWorksAsBefore) {
    ASSERT_TRUE(upload_and_activate(table()));
    EXPECT_EQ(read(reg::SET_POINT_COUNT), 0U | 16U << 8 | 8U << 16);
    EXPECT_EQ(read(reg::SET_POINT_RECORD), 0U);
    EXPECT_FALSE(change({{0, 5}}));
    EXPECT_EQ(status() & reg::kStoredDiffers, 0U);
    EXPECT_TRUE(command(Command::run));
}

TEST_F(SetPointsTest, ARecordThatDoesNotFitItsTableIsRefusedWithIt) {
    Uploaded bytes = content();
    bytes[24 + 6] ^= 1;  // Dwell's default
    ASSERT_TRUE(upload(bytes));
    EXPECT_FALSE(command(Command::activate));
    EXPECT_EQ(result() & 0xFF, static_cast<std::uint32_t>(Result::bad_set_points));
    EXPECT_FALSE(command(Command::run));
}

TEST_F(SetPointsTest, ACertificateStandsBehindTheRecord) {
    Uploaded bytes = content();
    for (const char sign : std::string_view("NPLPROOF")) bytes.push_back(static_cast<std::uint8_t>(sign));
    for (unsigned i = 0; i < 32; ++i) bytes.push_back(static_cast<std::uint8_t>(0x10 + i));
    ASSERT_TRUE(upload_and_activate(bytes));
    EXPECT_EQ(read(63), 0x13121110U);
    EXPECT_EQ(in_force(), kDefaults);
    ASSERT_TRUE(change({{2, 20}}));
    EXPECT_EQ(read(63), 0x13121110U);
}

/// SAFETY: damaged values start nothing by themselves, older ones or defaults stand in, and the reason is
/// shown.
TEST_F(SetPointsTest, DamagedValuesStartNothingByThemselves) {
    ASSERT_TRUE(upload_and_activate(content()));
    ASSERT_TRUE(change({{0, 70000}}));
    flash.flip(kSetPoints.begin + 200, 4);
    flash.flip(kSetPoints.begin + kSetPoints.slot_bytes + 200, 4);
    start({.autostart = true});
    EXPECT_EQ(state(), reg::RunState::stopped);
    EXPECT_EQ(read(reg::SAFE_REASON), static_cast<std::uint32_t>(reg::SafeReason::bad_set_points));
    EXPECT_NE(read(reg::STORE_FLAGS).value_or(0) & 4U, 0U);
    EXPECT_EQ(in_force(), kDefaults);
    ASSERT_TRUE(change({{0, 70000}}));
    EXPECT_EQ(read(reg::STORE_FLAGS).value_or(4) & 4U, 0U);
    EXPECT_TRUE(command(Command::run));
}

TEST_F(SetPointsTest, ARefusingStoreLeavesTheOldValues) {
    ASSERT_TRUE(upload_and_activate(content()));
    ASSERT_TRUE(change({{0, 70000}}));
    flash.fail_operation(1);
    EXPECT_FALSE(change({{0, 80000}}));
    EXPECT_EQ(result() & 0xFF, static_cast<std::uint32_t>(Result::storage_failed));
    EXPECT_EQ(wanted(), (Three{70000, 1000, 500}));
    EXPECT_TRUE(change({{0, 80000}}));
    EXPECT_EQ(in_force(), (Three{80000, 1000, 500}));
}

/// Two ports of one gateway; each gets the real result of its request.
struct TwoWriters : SetPointsTest {
    struct Ended {
        PendingResult one;
        PendingResult two;
    };
    SetPoints::Writer writer(reg::Origin origin) const { return {.origin = origin, .since = board.now}; }
    /// The second one comes `delay` polls after the first.
    Ended ask_both(const Uploaded& first, const Uploaded& second, int delay) {
        SetPoints& kept = controller->set_points();
        SetPoints::Writer one = writer(reg::Origin::user_port);
        Ended ended{.one = kept.serve(one, first, board.now), .two = {}};
        const auto go_on = [&] {
            poll();
            if (!ended.one) ended.one = kept.serve(one, first, board.now);
        };
        for (int i = 0; i < delay; ++i) go_on();
        SetPoints::Writer two = writer(reg::Origin::modbus);
        for (int i = 0; i < 4000 && !(ended.one && ended.two); ++i) {
            if (!ended.two) ended.two = kept.serve(two, second, board.now);
            go_on();
        }
        return ended;
    }
    std::string name_of_recipe(std::uint32_t number) {
        std::array<std::uint8_t, 16> bytes{};
        controller->set_points().read(number << 16, bytes);
        return reinterpret_cast<const char*>(bytes.data());
    }
};

/// Each change is whole, the later one holds, and both are in the log.
TEST_F(TwoWriters, NeverMix) {
    ASSERT_TRUE(upload_and_activate(content()));
    for (int delay = 0; delay < 40; ++delay) {
        const Ended ended = ask_both(request(record(), Request::change, {{0, 1}, {1, 101}, {2, 11}}),
                                     request(record(), Request::change, {{0, 2}, {1, 102}, {2, 12}}), delay);
        EXPECT_TRUE(ended.one.is_done() && ended.two.is_done()) << delay;
        EXPECT_EQ(wanted(), (Three{2, 102, 12})) << delay;
        EXPECT_EQ(in_force(), wanted());
        EXPECT_EQ(controller->set_points().change(0).origin, reg::Origin::modbus);
        EXPECT_EQ(controller->set_points().change(3).origin, reg::Origin::user_port);
    }
}

/// Each name has a number of its own, whenever the second one comes.
TEST_F(TwoWriters, SaveNewRecipesBesideEachOther) {
    for (int delay = 0; delay < 40; ++delay) {
        ASSERT_TRUE(upload_and_activate(content()));
        const Ended ended = ask_both(request(record(), Request::save_recipe, {}, 0, "Long"),
                                     request(record(), Request::put_recipe, {{0, 7}}, 0, "Short"), delay);
        EXPECT_TRUE(ended.one.is_done() && ended.two.is_done()) << delay;
        EXPECT_EQ(name_of_recipe(1), "Long") << delay;
        EXPECT_EQ(name_of_recipe(2), "Short") << delay;
        ASSERT_TRUE(recipe(Request::delete_recipe, 0, "Long"));
        ASSERT_TRUE(recipe(Request::delete_recipe, 0, "Short"));
    }
}

/// A name that is there means that recipe, case aside; of two savers the later one holds.
TEST_F(TwoWriters, SaveUnderOneName) {
    ASSERT_TRUE(upload_and_activate(content()));
    ask_both(request(record(), Request::put_recipe, {{0, 7}}, 0, "Short"),
             request(record(), Request::put_recipe, {{0, 8}}, 0, "SHORT"), 3);
    EXPECT_EQ(name_of_recipe(1), "SHORT");
    EXPECT_EQ(name_of_recipe(2), "");
    ASSERT_TRUE(recipe(Request::load_recipe, 0, "short"));
    EXPECT_EQ(wanted()[0], 8);
    EXPECT_EQ(active_recipe(), 1U);
}

/// One deletes what the other is about to load, and another recipe has its number by then.
TEST_F(TwoWriters, AnotherRecipeIsNeverLoadedInItsPlace) {
    ASSERT_TRUE(upload_and_activate(content()));
    ASSERT_TRUE(ask_for(request(record(), Request::put_recipe, {{0, 7}}, 0, "Short")));
    ASSERT_TRUE(recipe(Request::delete_recipe, 1));
    ASSERT_TRUE(ask_for(request(record(), Request::put_recipe, {{0, 9}}, 0, "Long")));
    EXPECT_FALSE(recipe(Request::load_recipe, 0, "Short"));
    EXPECT_EQ(result(), result_of(Result::no_recipe, reg::SET_POINT_WRITE));
    EXPECT_FALSE(recipe(Request::load_recipe, 1, "Short"));
    EXPECT_EQ(result(), result_of(Result::no_recipe, reg::SET_POINT_WRITE));
    ASSERT_TRUE(save("Other"));
    EXPECT_FALSE(recipe(Request::delete_recipe, 1, "Other"));
    EXPECT_EQ(result(), result_of(Result::other_recipe, reg::SET_POINT_WRITE));
    EXPECT_EQ(wanted(), kDefaults);
    EXPECT_EQ(name_of_recipe(1), "Long");
    EXPECT_TRUE(recipe(Request::load_recipe, 1, "LONG"));
    EXPECT_EQ(wanted()[0], 9);
}

TEST_F(TwoWriters, ANewNameIsRefusedWhenAllAreTaken) {
    ASSERT_TRUE(upload_and_activate(content()));
    for (const char* name : {"1", "2", "3", "4", "5", "6", "7"}) ASSERT_TRUE(save(name));
    const Ended ended = ask_both(request(record(), Request::save_recipe, {}, 0, "8"),
                                 request(record(), Request::save_recipe, {}, 0, "9"), 0);
    EXPECT_TRUE(ended.one.is_done());
    EXPECT_EQ(ended.two.word(), static_cast<std::uint32_t>(Result::no_recipe_left));
    EXPECT_TRUE(save("5"));
    EXPECT_EQ(name_of_recipe(8), "8");
}

/// The storage takes longer than a second: the answer waits for the real end, and another one's request that
/// has not begun by then is known not to be carried out.
TEST_F(TwoWriters, ASlowStorageIsWaitedFor) {
    ASSERT_TRUE(upload_and_activate(content()));
    flash.work_for(2'000);
    const Uploaded first = request(record(), Request::change, {{0, 1}});
    const Uploaded second = request(record(), Request::change, {{0, 2}});
    SetPoints& kept = controller->set_points();
    SetPoints::Writer one = writer(reg::Origin::user_port);
    SetPoints::Writer two = writer(reg::Origin::modbus);
    const base::Instant begun = board.now;
    PendingResult first_ended = kept.serve(one, first, board.now);
    PendingResult second_ended;
    while (!first_ended && board.now < begun + 60s) {
        poll();
        if (!second_ended) second_ended = kept.serve(two, second, board.now);
        first_ended = kept.serve(one, first, board.now);
    }
    EXPECT_GT(board.now, begun + 2s);
    EXPECT_TRUE(first_ended.is_done());
    EXPECT_EQ(second_ended.word(), static_cast<std::uint32_t>(Result::busy));
    run(30s);
    EXPECT_EQ(wanted()[0], 1);
}

/// On the user's port, whose client goes on before the answer: the end of its request is there to be read,
/// and the same one again is not carried out twice.
TEST_F(TwoWriters, ARequestKnowsItsEnd) {
    ASSERT_TRUE(upload_and_activate(content()));
    ASSERT_TRUE(save("Short"));
    const auto ended_of = [&](std::uint32_t own_number) -> std::uint32_t {
        EXPECT_TRUE(write(reg::SET_POINT_POINTER, 254U << 16));
        const auto shown = block(reg::SET_POINT_POINTER);
        for (std::size_t i = 0; shown && i < 4; ++i) {
            if (base::load_u32(&shown->data[4 + 8 * i]) == own_number)
                return base::load_u32(&shown->data[8 + 8 * i]);
        }
        return 0xDEAD;
    };
    EXPECT_EQ(ended_of(77), 0xDEADU);
    flash.work_for(100);
    const Uploaded bytes = request(record(), Request::delete_recipe, {}, 0, "Short", 77);
    put(mactalk::encode_long_write(reg::kDefaultAddress, reg::SET_POINT_WRITE, bytes).view());
    run(10ms);
    EXPECT_EQ(ended_of(77), 0xFFFF'FFFFU);
    run(2s);
    EXPECT_EQ(ended_of(77), 0U);
    EXPECT_TRUE(ask_for(bytes)) << "done already";
    EXPECT_EQ(logged(Event::recipe_deleted), 1U);
    EXPECT_FALSE(ask_for(request(record(), Request::delete_recipe, {}, 0, "Short", 78)));
    EXPECT_EQ(ended_of(78), static_cast<std::uint32_t>(Result::no_recipe));
    EXPECT_EQ(ended_of(77), 0U);
}

/// What is being stored is stored before the gateway restarts.
TEST_F(TwoWriters, AResetWaitsForTheEnd) {
    ASSERT_TRUE(upload_and_activate(content()));
    flash.work_for(100);
    SetPoints::Writer one = writer(reg::Origin::panel);
    EXPECT_FALSE(
        controller->set_points().serve(one, request(record(), Request::change, {{0, 1}}), board.now));
    EXPECT_TRUE(command(Command::reset));
    EXPECT_FALSE(controller->reset_asked());
    run(2s);
    EXPECT_TRUE(controller->reset_asked());
    EXPECT_EQ(wanted()[0], 1);
}

}  // namespace
}  // namespace nplc::gateway
