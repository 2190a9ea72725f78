// Set-points and recipes over the firmware's own user port, in virtual time; and recipes as files.
#include "nanoctl/set_points.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "gateway_unit.h"
#include "nanoctl/transfer.h"
#include "set_points/recipe_file.h"
#include "set_points/values.h"
#include "set_points_bench.h"

namespace nplc::nanoctl {
namespace {

using gateway::SetPointBench;
using gw::SetPointRequest;
using set_points::NewValue;
using set_points::Recipe;
using set_points::RecipeFormat;

struct SetPointClient {
    explicit SetPointClient(std::uint64_t seed = 1)
        : wire(unit, 19'200, seed), master(wire, {.attempts = 10}), client(master, gw::kDefaultAddress) {
        upload(client, SetPointBench::content(), [](std::size_t, std::size_t) {});
        client.activate();
    }
    void ask(SetPointRequest kind, const std::vector<NewValue>& values, std::string_view recipe = {}) {
        const set_points::Record record = SetPointBench::record();
        write_set_points(client, record, set_points::encode_request(record, kind, values, {.name = recipe}));
    }

    GatewayUnit unit;
    mactalk_client::SimWire wire;
    mactalk_client::Master master;
    GatewayClient client;
};

TEST(NanoctlSetPoints, AreReadAndChanged) {
    SetPointClient bench;
    EXPECT_TRUE(takes_set_points(bench.client));
    KeptSetPoints kept = read_set_points(bench.client);
    EXPECT_EQ(kept.record, SetPointBench::record());
    EXPECT_EQ(kept.recipes, 8U);
    EXPECT_EQ(kept.wanted, (std::vector<std::int32_t>{65536, 1000, 500}));
    bench.ask(SetPointRequest::change, {{2, 20}, {0, -5}});
    kept = read_set_points(bench.client);
    EXPECT_EQ(kept.wanted, (std::vector<std::int32_t>{-5, 1000, 20}));
    EXPECT_EQ(kept.in_force, kept.wanted);
}

/// What the log only counts.
TEST(NanoctlSetPoints, ChangesAreToldWithTheirValues) {
    SetPointClient bench;
    EXPECT_TRUE(read_changes(bench.client).changes.empty());
    bench.ask(SetPointRequest::change, {{2, 20}, {0, -5}});
    const KnownChanges known = read_changes(bench.client);
    ASSERT_EQ(known.changes.size(), 2U);
    EXPECT_EQ(known.changes[0].by, gw::Origin::user_port);
    const std::uint32_t when = known.changes[0].milliseconds;
    EXPECT_EQ(set_points::changes_text(known.changes, known.record, when),
              "Length 65536 counts to -5 counts, Dwell 500 ms to 20 ms");
    EXPECT_EQ(set_points::changes_text(known.changes, known.record, when + 1), "");
}

TEST(NanoctlSetPoints, TheLastSixteenChangesAreTold) {
    SetPointClient bench;
    for (std::int32_t i = 0; i < 9; ++i) {
        bench.ask(SetPointRequest::change, {{0, i}, {2, 20 + i}});
        bench.master.pause(base::Milliseconds(100));
    }
    const KnownChanges known = read_changes(bench.client);
    ASSERT_EQ(known.changes.size(), 16U);
    const auto text = [&](std::size_t index) {
        return set_points::changes_text(known.changes, known.record, known.changes[index].milliseconds);
    };
    EXPECT_EQ(text(15), "Length 7 counts to 8 counts, Dwell 27 ms to 28 ms");
    EXPECT_EQ(text(3), text(2));
    EXPECT_EQ(text(2), "Length 1 counts to 2 counts, Dwell 21 ms to 22 ms");
    EXPECT_EQ(
        text(0),
        "Length 0 counts to 1 counts, Dwell 20 ms to 21 ms, and perhaps values that are not kept any more");
}

TEST(NanoctlSetPoints, ARefusalNamesTheValueAndItsLimits) {
    SetPointClient bench;
    try {
        bench.ask(SetPointRequest::change, {{0, 5}, {2, 0}});
        FAIL();
    } catch (const Refused& refused) {
        EXPECT_EQ(refused.result(), gw::Result::out_of_range);
        EXPECT_STREQ(refused.what(),
                     "Dwell: a set-point is out of its range; it takes 1 ms to 5000 ms; nothing was changed");
    }
    EXPECT_EQ(read_set_points(bench.client).wanted[0], 65536);
}

TEST(NanoctlSetPoints, RecipesAreListed) {
    SetPointClient bench;
    bench.ask(SetPointRequest::save_recipe, {}, "Default");
    bench.ask(SetPointRequest::put_recipe, {{0, 7}, {1, 200}}, "Short");
    const KeptSetPoints kept = read_set_points(bench.client);
    const std::vector<Recipe> recipes = read_recipes(bench.client, kept);
    ASSERT_EQ(recipes.size(), 2U);
    EXPECT_EQ(recipes[0].number, 1);
    EXPECT_EQ(recipes[0].name, "Default");
    ASSERT_EQ(recipes[0].values.size(), 3U);
    EXPECT_EQ(recipes[0].values[1].value, 1000);
    EXPECT_EQ(recipes[1].name, "Short");
    EXPECT_EQ(recipes[1].number, 2);
}

struct Exchange {
    explicit Exchange(SetPointClient& client, const set_points::Record& next)
        : before(read_before(client.client, next)) {
        upload(client.client, SetPointBench::content(next), [](std::size_t, std::size_t) {});
        client.client.activate();
        for (const set_points::Dropped& one : read_dropped(client.client, before, next))
            told += set_points::text_of(one) + "\n";
    }
    std::optional<ValuesBefore> before;
    std::string told;
};

/// Length is gone, Speed has another range, Dwell another unit.
set_points::Record other_record() {
    set_points::Record next{{SetPointBench::speed(), SetPointBench::dwell()}, 3};
    next.values[0].highest = 2000;
    next.values[1].unit_code = registers::set_points::kCount;
    next.values[1].unit = "parts";
    return next;
}

TEST(NanoctlSetPoints, WhatANewTableDropsIsNamedWithTheReason) {
    SetPointClient bench;
    bench.ask(SetPointRequest::change, {{0, -5}, {1, 2500}, {2, 20}});
    bench.ask(SetPointRequest::put_recipe, {{0, 7}, {1, 200}}, "Short");
    const Exchange exchange(bench, other_record());
    EXPECT_EQ(
        exchange.told,
        "Length -5 counts is dropped: the table has no such set-point\n"
        "Speed 1192 rpm is dropped, its default 477 rpm is in its place: it takes 47.7 rpm to 953.7 rpm\n"
        "Dwell 20 ms is dropped, its default 500 parts is in its place: its unit is another one, it takes "
        "1 parts to 5000 parts\n"
        "recipe 'Short': Length 7 counts is not loaded: the table has no such set-point\n"
        "recipe 'Short': Dwell 20 ms is not loaded, its default 500 parts is in its place: its unit is "
        "another one, it takes 1 parts to 5000 parts\n");
    const KeptSetPoints kept = read_set_points(bench.client);
    EXPECT_EQ(kept.wanted, (std::vector<std::int32_t>{1000, 500}));
    EXPECT_EQ(Exchange(bench, other_record()).before, std::nullopt) << "the same record: nothing is dropped";
}

TEST(NanoctlSetPoints, ATableWithoutSetPointsDropsThemAll) {
    SetPointClient bench;
    bench.ask(SetPointRequest::change, {{0, -5}});
    EXPECT_EQ(Exchange(bench, {}).told,
              "Length -5 counts is dropped: the table has no such set-point\n"
              "Speed 477 rpm is dropped: the table has no such set-point\n"
              "Dwell 500 ms is dropped: the table has no such set-point\n");
    EXPECT_EQ(Exchange(bench, other_record()).told,
              "Dwell has its default 500 parts: what was kept has another name, unit or range\n")
        << "their values before are not known any more";
}

TEST(NanoctlSetPoints, WhereNothingWasEverSetNothingIsDropped) {
    SetPointClient bench;
    EXPECT_EQ(Exchange(bench, other_record()).told, "");
}

/// The register keeps its steps: the operator's value is another one in the unit.
TEST(NanoctlSetPoints, AnotherScaleIsTold) {
    SetPointClient bench;
    bench.ask(SetPointRequest::change, {{0, 8192}});
    set_points::Record next = SetPointBench::record();
    next.values[0].unit = "mm";
    next.values[0].steps_per_unit = 819.2;
    EXPECT_EQ(Exchange(bench, next).told,
              "Length 8192 counts stays and is 10 mm now: its scale is another one\n");
}

TEST(NanoctlSetPoints, WhatALoadedRecipeDoesNotGiveIsNamed) {
    SetPointClient bench;
    bench.ask(SetPointRequest::put_recipe, {{0, 7}, {1, 2500}, {2, 20}}, "Short");
    const set_points::Record next = other_record();
    static_cast<void>(Exchange(bench, next));
    const KeptSetPoints before = read_set_points(bench.client);
    const Recipe recipe = read_recipes(bench.client, before).at(0);
    write_set_points(bench.client, next,
                     set_points::encode_request(next, SetPointRequest::load_recipe, {}, {.name = "Short"}));
    std::string told;
    for (const set_points::Dropped& one : dropped_by_loading(recipe, read_set_points(bench.client)))
        told += set_points::text_of(one) + "\n";
    EXPECT_EQ(
        told,
        "recipe 'Short': a value is not loaded: the table has no such set-point\n"
        "recipe 'Short': Speed 1192 rpm is not loaded, its default 477 rpm is in its place: it takes 47.7 "
        "rpm to 953.7 rpm\n"
        "recipe 'Short': Dwell is not loaded, its default 500 parts is in its place: its unit is another "
        "one, it takes 1 parts to 5000 parts\n");
}

/// What a storage takes longer than any answer is waited for: its real result is reported.
TEST(NanoctlSetPoints, ASlowStorageIsWaitedFor) {
    SetPointClient bench;
    bench.unit.storage.work_for(10'000);
    bench.ask(SetPointRequest::put_recipe, {{0, 7}}, "Short");
    bench.unit.storage.work_for(1);
    EXPECT_EQ(read_recipes(bench.client, read_set_points(bench.client)).size(), 1U);
    bench.unit.storage.work_for(10'000);
    bench.unit.storage.fail_operation(2);
    try {
        bench.ask(SetPointRequest::change, {{0, 7}});
        FAIL();
    } catch (const Refused& refused) {
        EXPECT_EQ(refused.result(), gw::Result::storage_failed);
    }
    bench.unit.storage.work_for(1);
    EXPECT_EQ(read_set_points(bench.client).wanted[0], 65536);
}

/// The accept and what comes after it: a second deletion would be refused.
TEST(NanoctlSetPoints, ALostAnswerIsNoSecondRequest) {
    for (const std::size_t lost : {1U, 2U, 3U, 4U, 6U, 20U, 160U}) {
        SetPointClient bench;
        bench.ask(SetPointRequest::put_recipe, {{0, 7}}, "Short");
        bench.unit.loses = lost;
        EXPECT_NO_THROW(bench.ask(SetPointRequest::delete_recipe, {}, "Short")) << lost;
        EXPECT_EQ(bench.unit.loses, 0U);
    }
}

TEST(NanoctlSetPoints, ABadLineChangesThemAllTheSame) {
    SetPointClient bench(7);
    // A block of 64 bytes has some 140 characters: one of three comes damaged, ten in a row once in 50,000.
    bench.wire.set_faults({.drop = 0.001, .damage = 0.001, .framing = 0.001});
    for (std::int32_t i = 1; i < 40; ++i) {
        bench.ask(SetPointRequest::change, {{0, i}, {1, 100 + i}, {2, i}});
        EXPECT_EQ(read_set_points(bench.client).wanted, (std::vector<std::int32_t>{i, 100 + i, i}));
    }
}

const std::vector<Recipe> kRecipes = {{0, "Short, \"fast\"", {{0, 7}, {1, 1000}, {2, 20}}},
                                      {0, "Long", {{2, 4000}}}};

TEST(RecipeFile, ComesBackAsItWasWritten) {
    for (const RecipeFormat format : {RecipeFormat::csv, RecipeFormat::toml}) {
        const std::string text = set_points::write_recipes(kRecipes, SetPointBench::record(), format);
        const auto read = set_points::read_recipes(text, SetPointBench::record(), format);
        EXPECT_EQ(read.error, "") << text;
        ASSERT_EQ(read.recipes.size(), 2U);
        EXPECT_EQ(read.recipes[0].name, kRecipes[0].name);
        ASSERT_EQ(read.recipes[0].values.size(), 3U);
        EXPECT_EQ(read.recipes[1].values[0].value, 4000);
    }
    EXPECT_EQ(set_points::write_recipes({kRecipes[1]}, SetPointBench::record(), RecipeFormat::csv),
              "recipe,set_point,value,unit\nLong,Dwell,4000,ms\n");
    EXPECT_EQ(set_points::write_recipes({kRecipes[1]}, SetPointBench::record(), RecipeFormat::toml),
              "[[recipe]]\nname = \"Long\"\n[recipe.values]\nDwell = \"4000 ms\"\n");
}

TEST(RecipeFile, SaysWhatIsWrongAndWhere) {
    const auto csv = [](const std::string& lines) {
        return set_points::read_recipes("recipe,set_point,value,unit\n" + lines, SetPointBench::record(),
                                        RecipeFormat::csv)
            .error;
    };
    EXPECT_EQ(csv("A,Dwell,0,ms\n"), "2: 0 ms is out of range; Dwell takes 1 ms to 5000 ms");
    EXPECT_EQ(csv("A,Dwell,5,ms\nA,Width,5,mm\n"), "3: the table has no set-point 'Width'");
    EXPECT_EQ(csv("A,Dwell,5\n"), "2: 3 fields, there must be 4: recipe,set_point,value,unit");
    EXPECT_EQ(csv("A,Dwell,5,ms\nA,dwell,6,ms\n"), "3: 'dwell' stands twice in this recipe");
    EXPECT_EQ(csv("A name that is too long,Dwell,5,ms\n"),
              "2: 'A name that is too long': a recipe's name has 1 to 15 characters");
    EXPECT_EQ(csv("A,\"Dwell,5,ms\n"), "2: a quote is open at the end of the line");
    EXPECT_EQ(csv("A,Dwell,500,"), "2: the file ends without the unit of Dwell: is it whole?");
    EXPECT_EQ(csv("A,Dwell,500,\n"), "");
    EXPECT_EQ(csv("A,Dwell,500,ms"), "");
    EXPECT_EQ(csv(""), "1: there is no recipe in it");
    EXPECT_EQ(csv("A,Dwell,5,ms\nB,Dwell,5,ms\na,Width,5,mm\n"),
              "4: 'a' is the recipe 'A' of line 2; case counts not");
    EXPECT_EQ(csv("  ,Dwell,5,ms\n"), "2: '  ': a recipe's name neither begins nor ends with a blank");
    EXPECT_EQ(csv("A ,Dwell,5,ms\n"), "2: 'A ': a recipe's name neither begins nor ends with a blank");
    EXPECT_EQ(csv("A B,Dwell,+5,ms\n"), "");
    EXPECT_EQ(csv("A,Length,+-5,counts\n").substr(0, 23), "2: '+-5 counts' is no v");
    const auto toml = [](const std::string& text) {
        return set_points::read_recipes(text, SetPointBench::record(), RecipeFormat::toml).error;
    };
    EXPECT_EQ(toml("[[recipe]]\nname = \"A\"\n[recipe.values]\nDwell = \"6 s\"\n"),
              "4: 6 s is out of range; Dwell takes 1 ms to 5000 ms");
    const std::string one = "[[recipe]]\nname = \"A\"\n[recipe.values]\nDwell = 6\n";
    EXPECT_EQ(toml(one), "");
    EXPECT_EQ(toml(one + "[[recipe]]\nname = \"A\"\n[recipe.values]\nLength = 6\n"),
              "5: recipe 'A' stands in line 1 already");
    EXPECT_EQ(toml(one + "[[recipe]]\nname = \"a\"\n[recipe.values]\nLength = 6\n"),
              "5: 'a' is the recipe 'A' of line 1; case counts not");
    EXPECT_EQ(toml("[[recipe]]\nname = \"A\"\n[recipe.values]\n"), "1: recipe 'A' has no values");
    EXPECT_EQ(toml(one + "[[recipes]]\nname = \"B\"\n"),
              "5: 'recipes' is no key here; recipes are written as [[recipe]]");
    EXPECT_EQ(toml("[[recipe]]\nname = \"A\"\nDwell = 6\n[recipe.values]\nDwell = 6\n"),
              "3: 'Dwell' is no key here; a [[recipe]] has a name and [recipe.values]");
    EXPECT_NE(toml("[[recipe"), "");
    EXPECT_NE(toml("[[recipe]]\nname = 5\n"), "");
}

/// Wherever a file was cut, it is refused, or what it has left is as it was written.
TEST(RecipeFile, CutShortHasNoOtherValues) {
    const auto has = [](const Recipe& recipe, const NewValue& value) {
        return std::any_of(recipe.values.begin(), recipe.values.end(), [&](const NewValue& v) {
            return v.index == value.index && v.value == value.value;
        });
    };
    for (const RecipeFormat format : {RecipeFormat::csv, RecipeFormat::toml}) {
        const std::string text = set_points::write_recipes(kRecipes, SetPointBench::record(), format);
        for (std::size_t length = 0; length < text.size(); ++length) {
            const auto read =
                set_points::read_recipes(text.substr(0, length), SetPointBench::record(), format);
            for (std::size_t i = 0; i < read.recipes.size(); ++i) {
                EXPECT_EQ(read.recipes[i].name, kRecipes[i].name) << length;
                for (const NewValue& value : read.recipes[i].values)
                    EXPECT_TRUE(has(kRecipes[i], value)) << text.substr(0, length);
            }
        }
    }
}

TEST(SetPointValues, StepsBesideAreThoseThatWereWritten) {
    set_points::SetPoint length = SetPointBench::length();
    length.unit = "mm";
    length.steps_per_unit = 819.2;
    length.step = 0.1;
    length.initial = length.lowest = 8192;
    length.highest = 163'840;
    length.places = {0};
    const auto record = set_points::decode(set_points::encode({{length}, 1}));
    ASSERT_TRUE(record);
    EXPECT_EQ(record->values[0], length);
    EXPECT_EQ(set_points::read_value(record->values[0], "120.05mm").error,
              "120.05mm is between two steps, 120 or 120.1; Length takes 10 mm to 200 mm in steps of 0.1 mm");
}

TEST(RecipeFile, TheNameTellsTheForm) {
    for (const char* toml : {"r.toml", "R.TOML", ".toml"})
        EXPECT_EQ(set_points::format_of(toml), RecipeFormat::toml) << toml;
    for (const char* csv : {"r.csv", "toml", "", "r.toml.csv", "-"})
        EXPECT_EQ(set_points::format_of(csv), RecipeFormat::csv) << csv;
}

/// Saved with another table.
TEST(RecipeFile, ARecipeWithoutValuesIsNotInIt) {
    for (const RecipeFormat format : {RecipeFormat::csv, RecipeFormat::toml})
        EXPECT_EQ(set_points::write_recipes({{0, "Old", {}}, kRecipes[1]}, SetPointBench::record(), format),
                  set_points::write_recipes({kRecipes[1]}, SetPointBench::record(), format));
}

TEST(RecipeFile, SaysWhatARecipeLacks) {
    EXPECT_EQ(set_points::missing_values(kRecipes[0], SetPointBench::record()), "");
    const auto record = SetPointBench::record();
    EXPECT_EQ(set_points::missing_values(kRecipes[1], record),
              record.values[0].name + ", " + record.values[1].name);
}

}  // namespace
}  // namespace nplc::nanoctl
