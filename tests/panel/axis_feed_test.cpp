#include "axis_feed.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace nplc::panel {
namespace {

using faces::MotorItem;
using Json = nlohmann::json;
using namespace std::chrono_literals;

constexpr base::Instant kBegin{100s};

struct Names final : SymbolShelf {
    Found find(std::size_t, std::uint32_t) override { return {"/home/somebody/plant/feeder.seq", "{}"}; }
    std::string keep(std::size_t, std::uint32_t, std::string_view) override { return {}; }
};

struct Axis {
    Axis() { leave(kBegin); }
    /// The loop leaves an image; the panel looks at it.
    void leave(base::Instant now) {
        image.taken = now;
        ++image.number;
        model.board().put(image);
        feed.look(now);
    }
    void read(MotorItem item, std::int32_t value, base::Instant now) {
        image.motor[static_cast<std::size_t>(item)] = {true, value, now};
    }
    /// The motor's values of the message after one that contained `before`.
    Json values(const faces::AxisImage* before, base::Instant now) const {
        const std::string text = feed.image_text(before, true, now);
        return text.empty() ? Json() : Json::parse(text).value("m", Json());
    }

    faces::AxisImage image;
    faces::AxisModel model{"x"};
    Names names;
    AxisFeed feed{{.model = &model}, 0, &names};
};

TEST(AxisFeed, AValueThatIsNotReadAgainIsToldOnceMoreAsNotGood) {
    Axis axis;
    axis.read(MotorItem::position, 4'711, kBegin);
    axis.read(MotorItem::error_word, 0, kBegin);
    axis.leave(kBegin);
    EXPECT_EQ(axis.values(nullptr, kBegin)["P_IST"], Json::parse("[4711,0,true]"));
    faces::AxisImage told = axis.feed.image();
    const auto next = [&](base::Microseconds after) {
        axis.leave(kBegin + after);
        Json values = axis.values(&told, kBegin + after);
        told = axis.feed.image();
        return values;
    };
    EXPECT_TRUE(next(1'900ms).is_null());
    EXPECT_EQ(next(2'010ms), Json::parse(R"({"P_IST":[4711,2010,false]})"));
    EXPECT_TRUE(next(2'100ms).is_null()) << "once";
    EXPECT_TRUE(next(19'000ms).is_null()) << "read in turns of 8 s";
    EXPECT_EQ(next(20'010ms), Json::parse(R"({"ERR_STAT":[0,20010,false]})"));
    axis.read(MotorItem::position, 4'711, kBegin + 21s);
    EXPECT_EQ(next(21s), Json::parse(R"({"P_IST":[4711,0,true]})"));
}

TEST(AxisFeed, AsksForATrendOfTheTorque) {
    Axis axis;
    EXPECT_TRUE(axis.model.wants_trend(kBegin));
    EXPECT_FALSE(axis.model.wants_trend(kBegin + 1'001ms));
    axis.read(MotorItem::torque, 512, kBegin);
    axis.leave(kBegin);
    const faces::AxisImage told = axis.feed.image();
    axis.leave(kBegin + 2'010ms);
    EXPECT_EQ(axis.values(&told, kBegin + 2'010ms), Json::parse(R"({"VF_OUT":[512,2010,false]})"));
}

TEST(AxisFeed, TellsTheNameOfTheProgramsFile) {
    Axis axis;
    axis.model.table_shelf().put(std::make_shared<const faces::AxisTable>(
        faces::AxisTable{.crc = 1, .bytes = std::vector<std::uint8_t>(8, 0xFF)}));
    axis.leave(kBegin + 10ms);
    EXPECT_EQ(Json::parse(axis.feed.program_text())["file"], "feeder.seq");
}

/// A table with one set-point of that name, and its activation in the log.
void exchange(Axis& axis, const std::string& name, std::uint32_t table, base::Instant now) {
    set_points::SetPoint point;
    point.name = name;
    point.unit = "mm";
    point.highest = 200;
    auto book = std::make_shared<faces::SetPointBook>();
    book->edition = book->record_crc = table;
    book->record = {{point}, 1};
    ASSERT_TRUE(axis.model.set_point_shelf().put(book));
    namespace gw = registers::gateway;
    axis.image.own[gw::SET_POINT_COUNT] = 1;
    axis.image.own[gw::SET_POINT_RECORD] = table;
    axis.image.own[gw::SET_POINT_WANTED] = name == "Length" ? 90 : 0;
    axis.image.own[gw::LOG + 2 * (axis.image.own[gw::LOG_COUNT]++ % gw::kLogEntries) + 1] =
        static_cast<std::uint32_t>(gw::Event::table_activated);
    axis.leave(now);
}

TEST(AxisFeed, TheEventOfANewTableNamesTheValuesThatItDrops) {
    Axis axis;
    const auto last_text = [&axis] {
        const std::string text = axis.feed.events_text(axis.feed.last_event() - 1);
        return Json::parse(text)["events"].back()["text"].get<std::string>();
    };
    exchange(axis, "Length", 7, kBegin + 10ms);
    EXPECT_EQ(last_text().find("Length"), std::string::npos);
    exchange(axis, "Width", 8, kBegin + 20ms);
    EXPECT_NE(last_text().find("; Length 90 mm is dropped: the table has no such set-point"),
              std::string::npos)
        << last_text();
    exchange(axis, "Length", 7, kBegin + 30ms);
    exchange(axis, "Width", 8, kBegin + 10s);
    EXPECT_EQ(last_text().find("Length"), std::string::npos)
        << "nobody looked on: it may have been set to another value meanwhile";
}

}  // namespace
}  // namespace nplc::panel
