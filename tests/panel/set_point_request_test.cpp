// Clients' requests on set-points, as bytes for the gateway; the bytes are checked as REGISTERS.md has them.
#include "set_point_request.h"

#include <gtest/gtest.h>

#include "base/crc32.h"
#include "set_point_case.h"
#include "set_points/symbol_record.h"

namespace nplc::panel {
namespace {

namespace own = registers::gateway;
using Bytes = std::vector<std::uint8_t>;

using gateway::SetPointCase;
using Kind = own::SetPointRequest;

set_points::Record two() {
    set_points::SetPoint length = SetPointCase::length();
    length.reg = 49;
    length.at_power_up = false;
    length.unit = "mm";
    length.steps_per_unit = 100;
    length.step = 0.5;
    length.initial = 8000;
    length.lowest = 1000;
    length.highest = 20'000;
    set_points::SetPoint pieces = SetPointCase::dwell();
    pieces.name = "Pieces";
    pieces.kind = set_points::ValueKind::counter;
    pieces.unit_code = registers::set_points::kCount;
    pieces.unit = "";
    pieces.initial = 3;
    pieces.highest = 999;
    pieces.places = {1};
    return {{length, pieces}, 1};
}

/// With recipe 2, `Short`, and room for 3.
SetPointFeed feed() {
    auto book = std::make_shared<faces::SetPointBook>();
    book->record = two();
    book->record_crc = base::crc32(set_points::encode(book->record));
    book->recipes = {{2, "Short", {{0, 2500}}}};
    book->changes = {{7, 0, own::Origin::panel, 0, 8000, 2500},
                     {9, 1, own::Origin::panel, 0, 3, 4},
                     {9, 0, own::Origin::panel, 0, 2500, 3000}};
    faces::AxisImage image;
    image.own[own::SET_POINT_RECORD] = book->record_crc;
    image.own[own::SET_POINT_COUNT] = 2 | 16U << 8 | 3U << 16;
    image.own[own::SET_POINT_STATE] = own::kChangeWaits | 2U << 8;
    image.own[own::SET_POINT] = 8000;
    image.own[own::SET_POINT + 1] = 3;
    image.own[own::SET_POINT_WANTED] = 3000;
    image.own[own::SET_POINT_WANTED + 1] = 4;
    SetPointFeed result;
    EXPECT_TRUE(result.look(image, book));
    EXPECT_FALSE(result.look(image, book));
    return result;
}

SetPointsRead ask(const std::string& members) {
    return SetPointWork::read(Request::read(R"({"id":1,)" + members + "}"), feed());
}

Bytes sent(SetPointsRead read) {
    if (!read.work) return {};
    const auto command = read.work->next({});
    EXPECT_EQ(command->reg, own::SET_POINT_WRITE);
    EXPECT_EQ(command->from, own::Origin::panel);
    return {command->data.begin(), command->data.begin() + command->size};
}

Bytes request(Kind kind, const std::vector<SetPointCase::Value>& values, std::string_view name = {}) {
    return SetPointCase::request(two(), kind, values, 0, name);
}

TEST(PanelSetPoints, AChangeIsOneRequest) {
    // 120.5 mm are 12050 steps.
    const Bytes both = request(Kind::change, {{0, 12050}, {1, 5}});
    EXPECT_EQ(sent(ask(R"("do":"set_points","values":{"Pieces":5,"length":"120.5 mm"})")), both);
    EXPECT_EQ(sent(ask(R"("do":"set_points","values":{"Length":120.5,"Pieces":"5"})")), both);
}

TEST(PanelSetPoints, WhatCannotBeIsSaidWithNameAndLimits) {
    const auto error = [](const std::string& members) { return ask(members).error; };
    const std::string limits = "Length takes 10 mm to 200 mm in steps of 0.5 mm; nothing was changed";
    EXPECT_EQ(error(R"("do":"set_points","values":{"Pieces":5,"Length":201})"),
              "201 is out of range; " + limits);
    EXPECT_NE(error(R"("do":"set_points","values":{"Length":"80 rpm"})").find("'rpm' is no unit of Length"),
              std::string::npos);
    EXPECT_NE(error(R"("do":"set_points","values":{"Length":null})").find("'' is no value"),
              std::string::npos);
    EXPECT_EQ(error(R"("do":"set_points","values":{"Width":1})"),
              "there is no set-point 'Width'; there are Length, Pieces; nothing was changed");
    EXPECT_EQ(error(R"("do":"set_points","values":{"Length":20,"LENGTH":30})"),
              "Length stands here twice; nothing was changed");
    EXPECT_EQ(error(R"("do":"set_points","crc":1,"values":{"Length":20})"),
              "another table is active by now, and its set-points are others; nothing was changed");
    for (const char* wrong :
         {R"("do":"set_points")", R"("do":"set_points","values":[1])", R"("do":"set_points","values":{})",
          R"("do":"recipe","action":"eat")", R"("do":"recipe","action":"import","format":"xml","text":"")"}) {
        EXPECT_FALSE(ask(wrong).is_message) << wrong;
        EXPECT_FALSE(ask(wrong).work) << wrong;
    }
    const Request any = Request::read(R"({"id":1,"do":"set_points","values":{"Length":20}})");
    EXPECT_EQ(SetPointWork::read(any, SetPointFeed()).error,
              "the active table has no set-points; declare them with SET_POINT and upload it");
}

TEST(PanelSetPoints, RecipesGoByTheirNames) {
    EXPECT_EQ(sent(ask(R"("do":"recipe","action":"save","name":"New")")),
              request(Kind::save_recipe, {}, "New"));
    EXPECT_EQ(sent(ask(R"("do":"recipe","action":"load","name":"SHORT")")),
              request(Kind::load_recipe, {}, "SHORT"));
    EXPECT_EQ(sent(ask(R"("do":"recipe","action":"delete","name":"Short")")),
              request(Kind::delete_recipe, {}, "Short"));
    EXPECT_EQ(ask(R"("do":"recipe","action":"load","name":"Long")").error,
              "there is no recipe 'Long'; there are 'Short'");
    EXPECT_NE(ask(R"("do":"recipe","action":"save","name":"sixteen letters.")").error, "");
    EXPECT_NE(ask(R"("do":"recipe","action":"save","name":"")").error, "");
    // What a scenario needs to do the same: all values, the default where the recipe has none.
    EXPECT_EQ(ask(R"("do":"recipe","action":"load","name":"Short")").work->action(),
              "set Length := 25 mm and Pieces := 3");
}

TEST(PanelSetPoints, AFileIsImportedOneRecipeAfterTheOther) {
    const std::string file =
        R"("do":"recipe","action":"import","format":"csv","text":"recipe,set_point,value,unit\n)";
    SetPointsRead read = ask(file + R"(short,Length,20,mm\nA,Pieces,7,\nB,Pieces,8,\n")");
    ASSERT_TRUE(read.work) << read.error;
    std::vector<std::string> names;
    while (const auto command = read.work->next({})) {
        EXPECT_FALSE(read.work->next({})) << "one at a time";
        read.work->submitted(5);
        EXPECT_TRUE(read.work->is_of(5));
        EXPECT_EQ(command->data[4], 3);
        EXPECT_EQ(command->data[5], 0) << "the gateway finds the number";
        names.emplace_back(reinterpret_cast<const char*>(&command->data[12]));
        read.work->ended({});
    }
    EXPECT_EQ(names, (std::vector<std::string>{"short", "A", "B"}));
    EXPECT_TRUE(read.work->is_over());
    EXPECT_EQ(read.work->text(), "3 recipes stored");
    EXPECT_EQ(ask(file + R"(A,Pieces,7,\nB,Pieces,8,\nC,Pieces,9,\n")").error,
              "3 new recipes, and there is room for 2; delete others, or save under names that are there; "
              "nothing was imported");

    read = ask(file + R"(A,Length,20,mm\nB,Pieces,8,\n")");
    EXPECT_TRUE(read.work->next({}));
    read.work->ended({.result = faces::Result::not_for_motor, .detail = 0});
    EXPECT_TRUE(read.work->is_over());
    EXPECT_NE(read.work->text().find("'A': Length: "), std::string::npos) << read.work->text();
}

TEST(PanelSetPoints, ClientsAreToldInTheUnits) {
    const auto told = nlohmann::json::parse(feed().text("x"));
    EXPECT_EQ(told["values"][0],
              nlohmann::json::parse(R"({"name":"Length","unit":"mm","value":30,"in_force":80,"lowest":10,
                  "highest":200,"step":0.5,"initial":80})"));
    EXPECT_EQ(told["values"][1]["unit"], "");
    EXPECT_EQ(told["waits"], true);
    EXPECT_EQ(told["recipe"], 2);
    EXPECT_EQ(told["takes"], nlohmann::json::parse("[0]"));
    EXPECT_EQ(told["room"], 3);
    EXPECT_EQ(told["recipes"],
              nlohmann::json::parse(R"([{"number":2,"name":"Short","values":{"Length":25}}])"));
    EXPECT_EQ(feed().changes_at(9), "Pieces 3 to 4, Length 25 mm to 30 mm");
    EXPECT_EQ(feed().changes_at(8), "");
    EXPECT_EQ(feed().recipe_name(2), "2 'Short'");
    EXPECT_EQ(feed().recipe_name(3), "3");
}

/// Term 0 writes P1 (49, 32 bits) := 8000, term 1 presets the counter with 3; then the end.
const Bytes kTable{0xC0, 0, 0x80, 0xB1, 0x40, 0x1F, 0, 0, 0xC0, 0, 0, 0x7E,
                   0x80, 0, 3,    0,    0x3F, 0,    0, 0, 0,    0, 0, 0};

TEST(PanelSetPoints, AnUploadBringsTheRecordOfItsNames) {
    const auto symbols = nlohmann::json::parse(R"({"takes_set_points":[0],"set_points":[
        {"name":"Length","register":49,"longword":true,"at_power_up":false,"unit":"mm","unit_code":2,
         "steps_per_unit":100.0,"step":0.5,"initial":8000,"lowest":1000,"highest":20000,"terms":[0]},
        {"name":"Pieces","preset":"counter","unit":"","unit_code":129,"steps_per_unit":1.0,
         "initial":3,"lowest":1,"highest":999,"terms":[1]}]})");
    EXPECT_EQ(set_points::record_in(symbols, kTable), set_points::encode(two()));
    EXPECT_EQ(set_points::record_in(nlohmann::json::parse("{}"), kTable), Bytes());
    EXPECT_EQ(set_points::record_in(nlohmann::json(), kTable), Bytes());
    auto wrong = symbols;
    wrong["set_points"][0]["initial"] = 8001;
    EXPECT_EQ(set_points::record_in(wrong, kTable), std::nullopt);
    wrong = symbols;
    wrong["set_points"][0].erase("unit");
    EXPECT_EQ(set_points::record_in(wrong, kTable), std::nullopt);
    wrong = symbols;
    wrong["set_points"] = "all";
    EXPECT_EQ(set_points::record_in(wrong, kTable), std::nullopt);
}

}  // namespace
}  // namespace nplc::panel
