// A Modbus master that asks every few seconds, on a gateway whose board is the test's own.
#include <gtest/gtest.h>

#include "faces/axis_loop.h"
#include "modbus/session.h"
#include "port_bench.h"

namespace nplc::modbus {
namespace {

namespace gw = registers::gateway;
using namespace std::chrono_literals;

const gateway::Bytes kTable{{0xC0, 0, 0, 0x01, 0x80, 0, 0, 0}, {0xC1, 0, 0, 0x3E, 0x80, 1, 0, 0}};
constexpr std::uint8_t kReadInputs = 4;

struct Machine {
    Machine() {
        EXPECT_TRUE(port.upload_and_activate(kTable));
        units.push_back(std::make_unique<Unit>(model, settings));
        session.emplace(units, "PLC", bell);
    }

    void run(base::Microseconds time) {
        for (const auto end = now() + time; now() < end;) {
            port.poll();
            loop.poll(*port.controller, now(), now());
        }
    }
    base::Instant now() const { return port.board.now; }
    /// The first word, or nothing where the answer is exception 0Bh. The server waits for a new image.
    std::optional<unsigned> read(std::uint16_t address, std::uint8_t count) {
        static_cast<void>(model.image(now()));
        run(20ms);
        const std::array<std::uint8_t, 5> pdu{kReadInputs, static_cast<std::uint8_t>(address >> 8),
                                              static_cast<std::uint8_t>(address), 0, count};
        const auto answer = session->serve(1, pdu, {.now = now(), .arrived = now()});
        const auto bytes = answer->bytes();
        if (bytes[0] != kReadInputs) {
            EXPECT_EQ(bytes[1], static_cast<std::uint8_t>(Exception::target_failed));
            return std::nullopt;
        }
        return unsigned{bytes[2]} << 8 | bytes[3];
    }

    gateway::PortBench port;
    faces::AxisModel model{"x"};
    faces::AxisLoop loop{model, {}};
    faces::Bell bell{[] {}};
    Settings settings;
    std::vector<std::unique_ptr<Unit>> units;
    std::optional<Session> session;
};

TEST(SlowMaster, KnowsTheMotorFromItsSecondQuestionOn) {
    for (const base::Microseconds every : {2'000ms, 5'000ms, 30'000ms}) {
        Machine machine;
        EXPECT_FALSE(machine.read(100, 6)) << "nobody asked before";
        EXPECT_FALSE(machine.read(120, 8));
        machine.run(5s);
        for (int i = 0; i < 12; ++i) {
            machine.run(every);
            EXPECT_TRUE(machine.read(100, 6)) << i << " of every " << every.count() << " us";
            EXPECT_TRUE(machine.read(120, 8)) << i << " of every " << every.count() << " us";
        }
    }
}

TEST(SlowMaster, KnowsWhy) {
    Machine machine;
    EXPECT_FALSE(machine.read(kWhy, 1));
    machine.run(15s);
    for (int i = 0; i < 10; ++i) {
        machine.run(5s);
        EXPECT_TRUE(machine.read(kWhy, 1)) << i;
    }
}

TEST(SlowMaster, LeavesTheLineAloneAMinuteAfter) {
    Machine machine;
    EXPECT_FALSE(machine.read(100, 6));
    machine.run(59s);
    const std::uint64_t images = machine.model.image_number();
    machine.port.board.accesses.clear();
    machine.run(500ms);
    EXPECT_NEAR(static_cast<double>(machine.port.board.accesses.size()), 5, 1) << "as ever, one in 100 ms";
    EXPECT_EQ(machine.model.image_number(), images);
    machine.run(1s);
    machine.port.board.accesses.clear();
    machine.run(5s);
    EXPECT_TRUE(machine.port.board.accesses.empty());
}

TEST(SlowMaster, TheStatusAloneCostsTheMotorsLineNothingForLong) {
    Machine machine;
    EXPECT_TRUE(machine.read(2, 4));
    machine.run(2s);
    machine.port.board.accesses.clear();
    machine.run(5s);
    EXPECT_TRUE(machine.port.board.accesses.empty());
}

TEST(SlowMaster, TheSeldomValuesAreKnownSoonAndHaveMargin) {
    Machine machine;
    EXPECT_FALSE(machine.read(120, 8));
    base::Instant begin = machine.now();
    while (!machine.read(120, 8)) ASSERT_LT(machine.now() - begin, 4s);
    base::Microseconds oldest{0};
    begin = machine.now();
    while (machine.now() - begin < 60s) {
        machine.run(100ms);
        const faces::AxisImage image = machine.model.image(machine.now());
        for (const auto item :
             {faces::MotorItem::error_word, faces::MotorItem::mode, faces::MotorItem::target})
            oldest = std::max(oldest, base::Microseconds(image.taken - image.of_motor(item).taken));
    }
    EXPECT_LT(oldest, 8s);
    machine.port.board.access_answers = motor::AccessState::failed;
    machine.run(9s);
    EXPECT_TRUE(machine.read(120, 8)) << "valid for more than twice as long as a turn";
    machine.run(12s);
    EXPECT_FALSE(machine.read(120, 8));
}

TEST(SlowMaster, OfALostMotorNothingIsKnown) {
    Machine machine;
    for (int i = 0; i < 40 && !machine.read(120, 8); ++i) machine.run(100ms);
    ASSERT_TRUE(machine.read(120, 8));
    machine.port.board.link_state = motor::Link::down;
    machine.run(50ms);
    EXPECT_FALSE(machine.read(120, 8));
    EXPECT_TRUE(machine.read(0, 45)) << "the status is";
}

}  // namespace
}  // namespace nplc::modbus
