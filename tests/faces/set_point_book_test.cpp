// What faces see of set-points, and how they change them.
#include "faces/set_point_book.h"

#include <gtest/gtest.h>

#include "faces/axis_loop.h"
#include "faces/drop_watch.h"
#include "set_points_bench.h"

namespace nplc::faces {
namespace {

namespace gw = registers::gateway;
using gateway::SetPointBench;
using Kind = gw::SetPointRequest;
using namespace std::chrono_literals;

struct BookBench {
    BookBench() { EXPECT_TRUE(port.upload_and_activate(SetPointBench::content())); }

    void poll() {
        port.poll();
        loop.poll(*port.controller, port.board.now, port.board.now);
    }
    AxisImage image() {
        for (int look = 0; look < 2; ++look) {
            static_cast<void>(model.image(port.board.now));
            for (const auto end = port.board.now + 20ms; port.board.now < end;) poll();
        }
        return model.image(port.board.now);
    }
    void submit(CommandDesk::Client& client, const std::vector<std::uint8_t>& request) {
        client.submit(Command::set_points(request, gw::Origin::modbus, port.board.now));
    }
    Completion ask(CommandDesk::Client& client, const std::vector<std::uint8_t>& request,
                   base::Microseconds patience = 1s) {
        submit(client, request);
        for (const auto end = port.board.now + patience; port.board.now < end;) {
            poll();
            if (const auto ended = client.take()) return *ended;
        }
        return {.result = Result::busy};
    }
    Completion change(CommandDesk::Client& client, std::size_t index, std::int32_t value) {
        return ask(client,
                   set_points::encode_request(model.set_points()->record, Kind::change, {{index, value}}));
    }

    SetPointBench port;
    AxisModel model{"x"};
    AxisLoop loop{model, LoopSettings{}};
    Bell bell{[] {}};
    std::unique_ptr<CommandDesk::Client> plc = model.join(Side::plant, "PLC", bell);
    std::unique_ptr<CommandDesk::Client> other = model.join(Side::plant, "other", bell);
};

TEST(SetPointBook, ShowsWhatCanBeSetAndTheValues) {
    BookBench bench;
    EXPECT_EQ(bench.model.set_points()->record_crc, 0U);
    const AxisImage image = bench.image();
    const auto book = bench.model.set_points();
    EXPECT_TRUE(book->is_of(image));
    EXPECT_EQ(book->record, SetPointBench::record());
    EXPECT_EQ(set_point_in_force(image, 0), 65536);
    EXPECT_EQ(set_point_wanted(image, 2), 500);
    EXPECT_EQ(active_recipe(image), 0);
}

TEST(SetPointBook, AChangeIsLoggedWithWhoMadeIt) {
    BookBench bench;
    static_cast<void>(bench.image());
    EXPECT_EQ(bench.change(*bench.plc, 0, 70'000).result, Result::done);
    const AxisImage image = bench.image();
    EXPECT_EQ(set_point_wanted(image, 0), 70'000);
    const auto& last = bench.port.controller->set_points().change(0);
    EXPECT_EQ(last.origin, gw::Origin::modbus);
    EXPECT_EQ(last.before, 65536);
    EXPECT_EQ(last.now, 70'000);
}

TEST(SetPointBook, AChangeNeedsTheSeatAndReadingDoesNot) {
    BookBench bench;
    static_cast<void>(bench.image());
    EXPECT_EQ(bench.change(*bench.plc, 0, 70'000).result, Result::done);
    EXPECT_EQ(bench.change(*bench.other, 0, 1).result, Result::seat_taken);
    bench.other->submit(Command::own(gw::SET_POINT_POINTER, 4, bench.port.board.now));
    for (int i = 0; i < 20; ++i) bench.poll();
    EXPECT_EQ(bench.other->take()->result, Result::done);
    EXPECT_EQ(set_point_wanted(bench.image(), 0), 70'000);
}

TEST(SetPointBook, ARefusalSaysTheNameAndTheLimits) {
    BookBench bench;
    static_cast<void>(bench.image());
    const Completion ended = bench.change(*bench.plc, 2, 0);
    EXPECT_EQ(ended.result, Result::out_of_range);
    EXPECT_EQ(describe_refusal(*bench.model.set_points(), ended),
              "Dwell: a set-point is out of its range; it takes 1 ms to 5000 ms; nothing was changed");
}

std::vector<std::uint8_t> length_of(std::int32_t value) {
    return set_points::encode_request(SetPointBench::record(), Kind::change, {{0, value}});
}

/// Longer than a command may wait: requests of other clients are served meanwhile, and the reported result is
/// the real one.
TEST(SetPointBook, ASlowStorageIsWaitedForBesideOtherCommands) {
    BookBench bench;
    static_cast<void>(bench.image());
    bench.port.flash.work_for(2'000);
    bench.submit(*bench.plc, length_of(70'000));
    bench.submit(*bench.plc, length_of(70'001));
    bench.poll();
    bench.other->submit(Command::own(gw::SET_POINT_POINTER, 4, bench.port.board.now));
    std::vector<Completion> of_plc;
    std::optional<Completion> of_other;
    const auto begun = bench.port.board.now;
    while (of_plc.size() < 2 && bench.port.board.now < begun + 60s) {
        bench.poll();
        if (!of_other) of_other = bench.other->take();
        if (const auto ended = bench.plc->take()) of_plc.push_back(*ended);
        if (of_plc.size() == 1) {
            EXPECT_EQ(of_plc[0].id, 2U);
            EXPECT_EQ(of_plc[0].result, Result::too_late) << "not begun, and never stored";
        }
    }
    ASSERT_EQ(of_plc.size(), 2U);
    EXPECT_GT(bench.port.board.now, begun + 2s);
    EXPECT_EQ(of_plc[1].result, Result::done);
    ASSERT_TRUE(of_other);
    bench.port.flash.work_for(1);
    EXPECT_EQ(set_point_wanted(bench.image(), 0), 70'000);
}

/// A stop does not undo what is being stored, and does not report that it did; waiting requests are dropped.
TEST(SetPointBook, AStopMeanwhileTellsTheTruth) {
    BookBench bench;
    static_cast<void>(bench.image());
    bench.port.flash.work_for(500);
    bench.submit(*bench.plc, length_of(70'000));
    bench.submit(*bench.plc, length_of(70'001));
    for (int i = 0; i < 20; ++i) bench.poll();
    bench.other->submit(Command::of(gw::Command::stop, bench.port.board.now));
    std::vector<Completion> of_plc;
    for (int i = 0; i < 40'000 && of_plc.size() < 2; ++i) {
        bench.poll();
        if (const auto ended = bench.plc->take()) of_plc.push_back(*ended);
    }
    ASSERT_EQ(of_plc.size(), 2U);
    EXPECT_EQ(of_plc[0].id, 2U);
    EXPECT_EQ(of_plc[0].result, Result::too_late);
    EXPECT_EQ(of_plc[1].result, Result::done);
    EXPECT_EQ(bench.other->take()->result, Result::done);
    EXPECT_EQ(set_point_wanted(bench.image(), 0), 70'000);
}

/// A message at the user's port, which writes something else, and a stop while that port's own change is
/// stored.
TEST(SetPointBook, TheUsersPortAndFacesDoNotAnswerForEachOther) {
    BookBench bench;
    static_cast<void>(bench.image());
    bench.port.flash.work_for(500);
    bench.submit(*bench.plc, length_of(70'000));
    for (int i = 0; i < 20; ++i) bench.poll();
    EXPECT_TRUE(bench.port.write(gw::UPLOAD_BYTES, 5));
    std::optional<Completion> ended;
    for (int i = 0; i < 40'000 && !ended; ++i) {
        bench.poll();
        ended = bench.plc->take();
    }
    ASSERT_TRUE(ended);
    EXPECT_EQ(ended->result, Result::done);

    bench.port.put(
        protocol::mactalk::encode_long_write(gw::kDefaultAddress, gw::SET_POINT_WRITE, length_of(80'000))
            .view());
    for (int i = 0; i < 20; ++i) bench.poll();
    bench.other->submit(Command::of(gw::Command::stop, bench.port.board.now));
    bench.port.line.sent.clear();
    for (int i = 0; i < 40'000 && bench.port.line.sent.empty(); ++i) bench.poll();
    EXPECT_EQ(bench.port.line.sent, SetPointBench::accept());
    EXPECT_EQ(set_point_wanted(bench.image(), 0), 80'000);
}

/// A client that is gone in the middle of its change blocks no other client, and the change is complete.
TEST(SetPointBook, AClientThatLeavesInTheMiddleLeavesAWholeChange) {
    BookBench bench;
    static_cast<void>(bench.image());
    for (int polls = 0; polls < 30; ++polls) {
        auto leaver = bench.model.join(Side::plant, "leaver", bench.bell);
        bench.submit(*leaver, set_points::encode_request(SetPointBench::record(), Kind::change,
                                                         {{0, polls}, {1, 200 + polls}, {2, 1 + polls}}));
        for (int i = 0; i < polls; ++i) bench.poll();
        leaver.reset();
        EXPECT_EQ(bench
                      .ask(*bench.other, set_points::encode_request(SetPointBench::record(),
                                                                    Kind::save_recipe, {}, {.name = "after"}))
                      .result,
                  Result::done)
            << polls;
        const AxisImage image = bench.image();
        const SetPointBench::Three now{set_point_wanted(image, 0), set_point_wanted(image, 1),
                                       set_point_wanted(image, 2)};
        const SetPointBench::Three changed{polls, 200 + polls, 1 + polls};
        EXPECT_EQ(now, polls == 0 ? gateway::kDefaults : changed) << "given up before it was taken, or whole";
        bench.loop.seat().leave(bench.other->number());
    }
}

TEST(SetPointBook, FollowsRecipesAndUploads) {
    BookBench bench;
    static_cast<void>(bench.image());
    const set_points::Record record = SetPointBench::record();
    EXPECT_EQ(
        bench.ask(*bench.plc, set_points::encode_request(record, Kind::save_recipe, {}, {.name = "Short"}))
            .result,
        Result::done);
    AxisImage image = bench.image();
    ASSERT_NE(bench.model.set_points()->find_recipe(1), nullptr);
    EXPECT_EQ(bench.model.set_points()->find_recipe(1)->name, "Short");
    EXPECT_EQ(bench.model.set_points()->find_recipe(2), nullptr);
    EXPECT_EQ(bench.ask(*bench.plc, set_points::encode_request(record, Kind::load_recipe, {}, {.number = 1}))
                  .result,
              Result::done);
    image = bench.image();
    EXPECT_EQ(active_recipe(image), 1);
    bench.loop.seat().leave(bench.plc->number());
    ASSERT_TRUE(bench.port.upload_and_activate(SetPointBench::table()));
    image = bench.image();
    EXPECT_EQ(bench.model.set_points()->record.values.size(), 0U);
    EXPECT_TRUE(bench.model.set_points()->is_of(image));
}

TEST(DropWatch, NamesWhatAnotherTableDoesNotTake) {
    BookBench bench;
    DropWatch watch;
    watch.look(*bench.port.controller);
    EXPECT_TRUE(watch.exchanged(*bench.port.controller).empty());
    ASSERT_TRUE(bench.port.change({{0, 70'000}}));
    ASSERT_TRUE(bench.port.save("Short"));
    watch.look(*bench.port.controller);
    set_points::Record next = SetPointBench::record();
    next.values[0].highest = 65'536;
    next.values[2].name = "Pause";
    ASSERT_TRUE(bench.port.upload_and_activate(SetPointBench::content(next)));
    std::string told;
    for (const set_points::Dropped& one : watch.exchanged(*bench.port.controller))
        told += set_points::text_of(one) + "\n";
    EXPECT_EQ(
        told,
        "Length 70000 counts is dropped, its default 65536 counts is in its place: it takes -4096 counts "
        "to 65536 counts\n"
        "Dwell 500 ms is dropped: the table has no such set-point\n"
        "recipe 'Short': Length 70000 counts is not loaded, its default 65536 counts is in its place: it "
        "takes -4096 counts to 65536 counts\n"
        "recipe 'Short': Dwell 500 ms is not loaded: the table has no such set-point\n");
    EXPECT_TRUE(watch.exchanged(*bench.port.controller).empty()) << "told once";
}

}  // namespace
}  // namespace nplc::faces
