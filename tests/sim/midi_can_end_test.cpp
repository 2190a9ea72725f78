#include <cmath>
#include <span>
#include <string>

#include "midi_bench.h"
#include "sim/midi_ends.h"

namespace nplc::sim {
namespace {

namespace can = protocol::midi_can;
using std::chrono::milliseconds;
using std::chrono::seconds;

/// Modules on a bus of 125 kbit/s with one master, in virtual time.
class BusBench {
  public:
    explicit BusBench(std::initializer_list<std::uint8_t> addresses) {
        for (const std::uint8_t address : addresses) {
            modules.emplace_back(midi::Model::mac34_1, MidiOptions{.can = true, .address = address});
        }
        for (MidiModule& module : modules) ends.emplace_back(module);
    }
    void pass(Time time) {
        for (const Time end = now + time; now < end;) {
            now += std::chrono::microseconds{100};
            for (std::size_t i = 0; i < modules.size(); ++i) {
                modules[i].advance(now);
                while (const auto frame = ends[i].transmit()) bus.send(*frame, static_cast<int>(i));
            }
            while (const auto heard_now = bus.take(now)) {
                for (std::size_t i = 0; i < modules.size(); ++i) {
                    if (heard_now->sender != static_cast<int>(i)) ends[i].receive(heard_now->frame);
                }
                if (heard_now->sender != kMaster) heard.push_back(heard_now->frame);
            }
        }
    }
    std::vector<base::CanFrame> ask(const can::Request& request, Time time = milliseconds{10}) {
        heard.clear();
        bus.send(can::encode(request), kMaster);
        pass(time);
        return heard;
    }

    static constexpr int kMaster = -1;
    std::deque<MidiModule> modules;
    std::deque<MidiCanEnd> ends;
    CanBus bus{125'000};
    std::vector<base::CanFrame> heard;
    Time now{0};
};

using Ask = can::Request::Kind;

/// "601 23 13 20 00 00 00 03 E8": identifier and bytes.
base::CanFrame frame_of(const std::string& text) {
    base::CanFrame frame;
    frame.id = static_cast<std::uint16_t>(std::stoul(text, nullptr, 16));
    for (std::size_t at = 4; at < text.size(); at += 3)
        frame.data[frame.length++] = static_cast<std::uint8_t>(std::stoul(text.substr(at, 2), nullptr, 16));
    return frame;
}

/// A module's side of a conversation, frame by frame; an empty answer is none.
struct Exchange {
    std::string frame;
    std::string answer;
};
void converse(BusBench& bench, std::span<const Exchange> exchanges) {
    for (const auto& [frame, answer] : exchanges) {
        bench.heard.clear();
        bench.bus.send(frame_of(frame), BusBench::kMaster);
        bench.pass(milliseconds{3});
        ASSERT_EQ(bench.heard.size(), answer.empty() ? 0u : 1u) << frame;
        if (!bench.heard.empty()) {
            EXPECT_EQ(bench.heard[0], frame_of(answer)) << frame;
        }
    }
}

// 003 §VI and §VII: what is set is read back; what no table has is refused.
TEST(MidiCanEnd, ParametersFrameByFrame) {
    BusBench bench({1});
    bench.pass(milliseconds{10});
    const Exchange exchanges[] = {
        {"601 23 02 20 00 00 00 00 00", "581 60 02 20 00 00 00 00 00"},
        {"601 23 02 20 00 00 00 00 01", "581 60 02 20 00 00 00 00 00"},
        {"601 23 03 20 00 00 00 00 00", "581 60 03 20 00 00 00 00 00"},
        {"601 23 03 20 00 00 00 00 01", "581 60 03 20 00 00 00 00 00"},
        {"601 23 03 20 00 00 00 00 08", "581 60 03 20 00 00 00 00 00"},
        {"601 23 03 20 00 00 00 00 02", "581 80 03 20 00 00 00 00 00"},
        {"601 23 03 20 00 00 00 00 09", "581 60 03 20 00 00 00 00 00"},
        {"601 23 04 20 00 00 00 00 00", "581 80 04 20 00 00 00 00 00"},
        {"601 23 05 20 00 00 00 00 00", "581 80 05 20 00 00 00 00 00"},
        {"601 23 06 20 00 00 00 00 00", "581 80 06 20 00 00 00 00 00"},
        {"601 23 07 20 00 00 00 00 01", "581 60 07 20 00 00 00 00 00"},
        {"601 23 07 20 00 00 00 00 00", "581 60 07 20 00 00 00 00 00"},
        {"601 23 08 20 00 00 00 00 05", "581 80 08 20 00 00 00 00 00"},
        {"601 23 09 20 00 00 01 86 A0", "581 60 09 20 00 00 00 00 00"},
        {"601 40 02 20 00 00 00 00 00", "581 42 02 20 00 00 01 86 A0"},
        {"601 23 0A 20 00 FF FE 79 60", "581 60 0A 20 00 00 00 00 00"},
        {"601 40 03 20 00 00 00 00 00", "581 42 03 20 00 FF FE 79 60"},
        {"601 23 0B 20 00 00 00 00 00", "581 60 0B 20 00 00 00 00 00"},
        {"601 23 0C 20 00 00 00 00 81", "581 80 0C 20 00 00 00 00 00"},  // more than Imax
        {"601 23 0C 20 00 00 00 00 40", "581 60 0C 20 00 00 00 00 00"},
        {"601 23 0D 20 00 00 00 01 E0", "581 60 0D 20 00 00 00 00 00"},
        {"601 23 0E 20 00 00 00 05 00", "581 60 0E 20 00 00 00 00 00"},
        {"601 40 05 20 00 00 00 00 00", "581 42 05 20 00 05 00 01 E0"},
        {"601 23 0F 20 00 00 00 00 10", "581 60 0F 20 00 00 00 00 00"},
        {"601 23 1C 20 00 00 00 00 14", "581 60 1C 20 00 00 00 00 00"},
        {"601 40 06 20 00 00 00 00 00", "581 42 06 20 00 10 40 19 14"},
        {"601 40 00 20 00 00 00 00 00", "581 42 00 20 00 00 00 00 00"},
        {"601 40 01 20 00 00 00 00 00", "581 42 01 20 00 00 00 00 00"},
        {"601 40 04 20 00 00 00 00 00", "581 42 04 20 00 00 00 07 04"},
        // 25 °C: 165 / 2.45 = 67.3; 48 V: 48 / 0.4 = 120; it follows.
        {"601 40 07 20 00 00 00 00 00", "581 42 07 20 00 43 78 08 00"},
        {"601 40 08 20 AF 00 00 00 00", "581 42 08 20 AF 80 00 00 00"},
        {"601 40 09 20 00 00 00 00 00", "581 80 09 20 00 00 00 00 00"},
        {"601 40 0F 20 00 00 00 00 00", "581 80 0F 20 00 00 00 00 00"},
        {"601 23 12 20 00 00 00 00 00", "581 80 12 20 00 00 00 00 00"},
        {"601 23 1B 20 00 00 00 00 01", "581 80 1B 20 00 00 00 00 00"},
        {"601 23 1D 20 00 00 00 00 00", "581 80 1D 20 00 00 00 00 00"},
        {"601 23 1F 20 00 00 00 00 00", "581 80 1F 20 00 00 00 00 00"},
        {"602 40 00 20 00 00 00 00 00", ""},
        {"601 40 00 20 00 00 00 00", ""},  // not whole
        {"080 00", ""},
    };
    converse(bench, exchanges);
}

// 003 §VI "!": what is refused while it moves, and what is not.
TEST(MidiCanEnd, MotionFrameByFrame) {
    BusBench bench({1});
    bench.pass(milliseconds{10});
    const Exchange moving[] = {
        {"601 23 19 20 00 00 00 00 00", "581 60 19 20 00 00 00 00 00"},
        {"601 23 13 20 00 00 98 96 80", "581 60 13 20 00 00 00 00 00"},  // 10000000
        {"601 23 13 20 00 00 00 00 00", "581 80 13 20 00 00 00 00 00"},
        {"601 23 14 20 00 00 00 00 00", "581 80 14 20 00 00 00 00 00"},
        {"601 23 02 20 00 00 00 00 01", "581 80 02 20 00 00 00 00 00"},
        {"601 23 03 20 00 00 00 00 00", "581 80 03 20 00 00 00 00 00"},
        {"601 23 09 20 00 00 00 00 00", "581 80 09 20 00 00 00 00 00"},
        {"601 23 0A 20 00 00 00 00 00", "581 80 0A 20 00 00 00 00 00"},
        {"601 23 0D 20 00 00 00 01 E0", "581 80 0D 20 00 00 00 00 00"},
        {"601 23 0F 20 00 00 00 00 10", "581 80 0F 20 00 00 00 00 00"},
        {"601 23 0C 20 00 00 00 00 40", "581 60 0C 20 00 00 00 00 00"},
        {"601 23 0E 20 00 00 00 05 00", "581 60 0E 20 00 00 00 00 00"},
        {"601 23 1C 20 00 00 00 00 14", "581 60 1C 20 00 00 00 00 00"},
        {"601 40 00 20 01 00 00 00 00", "581 80 00 20 01 00 00 00 00"},  // R: no such sub-index
        {"601 23 18 20 00 00 00 00 00", "581 60 18 20 00 00 00 00 00"},
        {"601 23 0B 20 00 00 00 00 00", "581 60 0B 20 00 00 00 00 00"},
        {"601 23 15 20 00 00 F6 03 20", "581 60 15 20 00 00 00 00 00"},
        {"601 23 15 20 00 00 F6 01 90", "581 60 15 20 00 00 00 00 00"},  // faster
    };
    converse(bench, moving);
    bench.pass(seconds{2});
    EXPECT_LT(bench.modules[0].position(), 0);
    const Exchange to_rest[] = {{"601 23 15 20 00 00 F6 00 00", "581 60 15 20 00 00 00 00 00"}};
    converse(bench, to_rest);
    bench.pass(seconds{2});
    // 03E8h increments of 1000h: 1000 x 512 us.
    const Exchange segments[] = {
        {"601 23 0B 20 00 00 00 00 00", "581 60 0B 20 00 00 00 00 00"},
        {"601 23 16 20 00 03 E8 10 00", "581 60 16 20 00 00 00 00 00"},  // it runs
        {"601 23 1E 20 00 03 E8 10 00", "581 60 1E 20 00 00 00 00 00"},  // three wait
        {"601 23 16 20 00 FC 18 10 00", "581 60 16 20 00 00 00 00 00"},  // -1000
        {"601 23 16 20 00 00 05 10 00", "581 60 16 20 00 00 00 00 00"},
        {"601 23 16 20 00 03 E8 10 00", "581 80 16 20 00 00 00 00 00"},
        {"601 23 1E 20 00 03 E8 10 00", "581 80 1E 20 00 00 00 00 00"},
        {"601 23 17 20 00 00 00 00 00", "581 80 17 20 00 00 00 00 00"},  // R: 003 names 13h, 14h, 15h
    };
    converse(bench, segments);
    bench.pass(milliseconds{512});
    const Exchange after[] = {{"601 23 16 20 00 00 03 10 00", "581 60 16 20 00 00 00 00 00"},
                              {"601 23 16 20 00 00 03 10 00", "581 80 16 20 00 00 00 00 00"},
                              {"601 40 00 20 00 00 00 00 00", "581 42 00 20 00 00 00 03 E8"}};
    converse(bench, after);
    bench.pass(seconds{2});
    const Exchange end[] = {{"601 40 00 20 00 00 00 00 00", "581 42 00 20 00 00 00 00 08"},
                            {"601 23 14 20 00 00 00 00 00", "581 60 14 20 00 00 00 00 00"},
                            {"601 23 1A 20 00 00 00 00 00", "581 60 1A 20 00 00 00 00 00"}};
    converse(bench, end);
    EXPECT_FALSE(bench.modules[0].powered());
}

// 003 §V.2, §V.4, §V.5, §V.8, §VII 00h and 01h.
TEST(MidiCanEnd, TheBusFrameByFrame) {
    BusBench bench({1});
    bench.pass(milliseconds{10});
    const Exchange exchanges[] = {
        {"601 23 10 20 00 00 00 00 00", "581 60 10 20 00 00 00 00 00"},
        {"601 23 13 20 00 00 00 00 0A", "581 60 13 20 00 00 00 00 00"},
        {"601 40 07 20 00 00 00 00 00", "581 42 07 20 00 43 78 08 00"},  // it waits
        {"080", ""},
        {"7E5 11 05 00 00 00 00 00 00", ""},  // not in configuration
        {"7E5 04 01 00 00 00 00 00 00", ""},
        {"7E5 11 00 00 00 00 00 00 00", "7E4 11 01 00 00 00 00 00 00"},  // 01h to 7Fh
        {"7E5 11 7F 00 00 00 00 00 00", "7E4 11 00 00 00 00 00 00 00"},
        {"601 23 11 20 00 00 00 00 00", "581 60 11 20 00 00 00 00 00"},  // it is still 1
        {"7E5 04 00 00 00 00 00 00 00", "77F 00"},
        {"601 40 00 20 00 00 00 00 00", ""},
        {"67F 40 00 20 00 00 00 00 00", "5FF 42 00 20 00 00 00 00 0A"},
        {"600 23 0B 20 00 00 00 00 00", ""},  // it acts, and only address 1 answers
        {"67F 40 00 20 00 00 00 00 00", "5FF 42 00 20 00 00 00 00 00"},
        {"67F 23 01 20 00 00 00 00 00", "5FF 60 01 20 00 00 00 00 00"},
    };
    converse(bench, exchanges);
    bench.heard.clear();
    bench.pass(seconds{2});
    ASSERT_EQ(bench.heard.size(), 1u);
    EXPECT_EQ(bench.heard[0], frame_of("701 00"));  // the factory's address
    const Exchange again[] = {{"600 23 18 20 00 00 00 00 00", "581 60 18 20 00 00 00 00 00"},
                              {"600 40 00 20 00 00 00 00 00", "581 42 00 20 00 00 00 00 00"},
                              {"601 23 00 20 00 00 00 00 00", "581 60 00 20 00 00 00 00 00"},
                              {"601 40 00 20 00 00 00 00 00", ""}};
    converse(bench, again);
}

// 003 §V.2, §V.6, §V.7, §VII 00h.
TEST(MidiCanEnd, BootUpCommandsAndQueries) {
    BusBench bench({1, 2});
    bench.pass(milliseconds{10});
    ASSERT_EQ(bench.heard.size(), 2u);
    EXPECT_EQ(bench.heard[0], (base::CanFrame{.id = 0x701, .length = 1, .data = {0}}));
    EXPECT_EQ(bench.heard[1], (base::CanFrame{.id = 0x702, .length = 1, .data = {0}}));
    auto heard = bench.ask({Ask::command, 2, 0x2013, 0, 1'000});
    ASSERT_EQ(heard.size(), 1u);
    EXPECT_EQ(heard[0],
              (base::CanFrame{.id = 0x582, .length = 8, .data = {0x60, 0x13, 0x20, 0, 0, 0, 0, 0}}));
    EXPECT_TRUE(bench.modules[1].moving());
    EXPECT_FALSE(bench.modules[0].moving());
    heard = bench.ask({Ask::command, 2, 0x2013, 0, 1'000});
    ASSERT_EQ(heard.size(), 1u);
    EXPECT_EQ(heard[0],
              (base::CanFrame{.id = 0x582, .length = 8, .data = {0x80, 0x13, 0x20, 0, 0, 0, 0, 0}}));
    bench.pass(seconds{1});
    heard = bench.ask({Ask::query, 2, 0x2000, 0, 0});
    ASSERT_EQ(heard.size(), 1u);
    EXPECT_EQ(heard[0],
              (base::CanFrame{.id = 0x582, .length = 8, .data = {0x42, 0, 0x20, 0, 0, 0, 0x03, 0xE8}}));
    heard = bench.ask({Ask::query, 1, 0x2008, 0xAF, 0});  // Imax
    ASSERT_EQ(heard.size(), 1u);
    EXPECT_EQ(heard[0],
              (base::CanFrame{.id = 0x581, .length = 8, .data = {0x42, 8, 0x20, 0xAF, 0x80, 0, 0, 0}}));
    for (const can::Request& bad :
         {can::Request{Ask::command, 1, 0x2008, 0, 5}, can::Request{Ask::query, 1, 0x2009, 0, 0},
          can::Request{Ask::command, 1, 0x1013, 0, 0}}) {
        heard = bench.ask(bad);
        ASSERT_EQ(heard.size(), 1u);
        EXPECT_EQ(heard[0].data[0], 0x80);
    }
    EXPECT_TRUE(bench.ask({Ask::command, 3, 0x2013, 0, 5}).empty());
}

TEST(MidiCanEnd, AResetIsAnsweredAndBootsAfterTwoSeconds) {
    BusBench bench({1});
    bench.pass(milliseconds{10});
    EXPECT_EQ(bench.ask({Ask::command, 1, 0x2000, 0, 0}).size(), 1u);
    EXPECT_TRUE(bench.ask({Ask::query, 1, 0x2000, 0, 0}, milliseconds{1'980}).empty());
    bench.pass(milliseconds{30});
    ASSERT_EQ(bench.heard.size(), 1u);
    EXPECT_EQ(bench.heard[0].id, 0x701);
}

// 003 §V.8: all act, address 1 answers.
TEST(MidiCanEnd, TheGeneralMessage) {
    BusBench bench({1, 2});
    bench.pass(milliseconds{10});
    const auto heard = bench.ask({Ask::command, can::kGeneral, 0x2013, 0, 1'000});
    ASSERT_EQ(heard.size(), 1u);
    EXPECT_EQ(heard[0].id, 0x581);
    EXPECT_TRUE(bench.modules[0].moving());
    EXPECT_TRUE(bench.modules[1].moving());
}

// 003 §V.4: two axes prepared, one frame starts both.
TEST(MidiCanEnd, Sync) {
    BusBench bench({1, 2});
    bench.pass(milliseconds{10});
    for (const std::uint8_t address : {std::uint8_t{1}, std::uint8_t{2}}) {
        bench.ask({Ask::command, address, 0x2010, 0, 0});
        bench.ask({Ask::command, address, 0x2013, 0, 10'000});
    }
    EXPECT_TRUE(bench.ask({.kind = Ask::sync}).empty());
    bench.pass(milliseconds{300});
    EXPECT_GT(bench.modules[0].position(), 0);
    EXPECT_EQ(bench.modules[0].position(), bench.modules[1].position());
}

// 003 §V.5: valid and kept only at the end of the whole procedure, which a boot-up closes.
TEST(MidiCanEnd, TheAddressByLmt) {
    BusBench bench({1});
    bench.pass(milliseconds{10});
    EXPECT_TRUE(bench.ask({.kind = Ask::set_address, .data = 5}).empty());  // not in configuration mode
    EXPECT_TRUE(bench.ask({.kind = Ask::configure}).empty());
    auto heard = bench.ask({.kind = Ask::set_address, .data = 0x80});
    ASSERT_EQ(heard.size(), 1u);
    EXPECT_EQ(heard[0].data[1], 1);
    heard = bench.ask({.kind = Ask::set_address, .data = 5});
    ASSERT_EQ(heard.size(), 1u);
    EXPECT_EQ(heard[0], (base::CanFrame{.id = 0x7E4, .length = 8, .data = {0x11, 0, 0, 0, 0, 0, 0, 0}}));
    EXPECT_EQ(bench.modules[0].memory().address, 1);
    heard = bench.ask({.kind = Ask::operate});
    ASSERT_EQ(heard.size(), 1u);
    EXPECT_EQ(heard[0], (base::CanFrame{.id = 0x705, .length = 1, .data = {0}}));
    EXPECT_EQ(bench.modules[0].memory().address, 5);
    EXPECT_EQ(bench.ask({Ask::query, 5, 0x2000, 0, 0}).size(), 1u);
}

// 003 §VII 16h: a circle of 32 segments of 50 ms, radius 2000, by two axes. Whoever is refused tries again;
// the inner radius of the polygon is 2000 cos(180 / 32 degrees) = 1990, and one axis runs some milliseconds
// before the other.
TEST(MidiCanEnd, TwoAxesDrawACircle) {
    constexpr int kSegments = 32;
    constexpr double kRadius = 2'000;
    constexpr std::int64_t kTicks = 400'000;
    BusBench bench({1, 2});
    bench.pass(milliseconds{10});
    const auto corner = [](int number, int axis) {
        const double angle = number * 2 * M_PI / kSegments;
        return std::lround(kRadius * (axis == 0 ? std::cos(angle) : std::sin(angle)));
    };
    int sent[2] = {0, 0};
    int refused = 0;
    double least = kRadius;
    double most = kRadius;
    std::int32_t left = 0;
    for (int round = 0;
         round < 1'000 && (sent[0] < kSegments || sent[1] < kSegments || bench.modules[1].moving());
         ++round) {
        for (int axis = 0; axis < 2; ++axis) {
            if (sent[axis] == kSegments) continue;
            const std::int64_t steps = corner(sent[axis] + 1, axis) - corner(sent[axis], axis);
            const auto data = midi::pack(*midi::find_command(midi::SEGMENT), static_cast<std::int32_t>(steps),
                                         static_cast<std::int32_t>(kTicks / std::abs(steps)));
            ASSERT_TRUE(data);
            const auto address = static_cast<std::uint8_t>(axis + 1);
            const auto heard = bench.ask({Ask::command, address, 0x2016, 0, *data}, milliseconds{3});
            ASSERT_EQ(heard.size(), 1u);
            heard[0].data[0] == 0x60 ? ++sent[axis] : ++refused;
        }
        bench.pass(milliseconds{3});
        const double radius = std::hypot(kRadius + bench.modules[0].position(), bench.modules[1].position());
        least = std::min(least, radius);
        most = std::max(most, radius);
        left = std::min(left, bench.modules[0].position());
    }
    EXPECT_GT(refused, kSegments);
    EXPECT_EQ(bench.modules[0].position(), 0);
    EXPECT_EQ(bench.modules[1].position(), 0);
    EXPECT_GT(least, 1'950);
    EXPECT_LT(most, 2'040);
    EXPECT_NEAR(left, -4'000, 10);
}

// 47 bits and the data: 111 at 125 kbit/s are 888 us; the lowest identifier goes first.
TEST(CanBus, TimeAndPriority) {
    CanBus bus(125'000);
    bus.send({.id = 0x700, .length = 8}, 0);
    EXPECT_FALSE(bus.take(Time{0}));
    bus.send({.id = 0x602, .length = 8}, 0);
    bus.send({.id = 0x601, .length = 8}, 1);
    bus.send({.id = 0x080}, 1);  // behind its sender's first
    Time end{0};
    for (const int id : {0x700, 0x601, 0x080, 0x602}) {
        end += std::chrono::microseconds{id == 0x080 ? 376 : 888};
        EXPECT_FALSE(bus.take(end - Time{1})) << id;
        EXPECT_EQ(bus.next_event(), end) << id;
        const auto heard = bus.take(end);
        ASSERT_TRUE(heard) << id;
        EXPECT_EQ(heard->frame.id, id);
    }
    EXPECT_TRUE(bus.is_idle());
}

}  // namespace
}  // namespace nplc::sim
