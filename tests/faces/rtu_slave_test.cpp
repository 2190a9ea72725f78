// The axes as slaves among others on a serial line, in virtual time: what is answered, and when nothing is.
#include "rtu_slave.h"

#include <gtest/gtest.h>

#include "faces/axis_loop.h"
#include "port_bench.h"

namespace nplc::modbus {
namespace {

namespace gw = registers::gateway;
using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;

const gateway::Bytes kWaits{{0xC0, 0, 0, 0x01, 0x80, 0, 0, 0}, {0xC1, 0, 0, 0x3E, 0x80, 1, 0, 0}};
constexpr std::uint8_t kUnit = 10;
const Bytes kAskStatus{4, 0, 1, 0, 1};
const Bytes kOrderStop{5, 0, 1, 0xFF, 0};
/// 3.5 characters of 11 bits at 19200 baud are 2005 us, and an adapter holds characters back for 20 ms.
constexpr base::Microseconds kPause = 23ms;

Bytes sealed(std::uint8_t unit, const Bytes& pdu) {
    const protocol::modbus::RtuFrame made(unit, pdu);
    return {made.bytes().begin(), made.bytes().end()};
}

struct RtuBench {
    RtuBench() {
        EXPECT_TRUE(port.upload_and_activate(kWaits));
        EXPECT_TRUE(second_port.upload_and_activate(kWaits));
        second_port.board.now = port.board.now;
        slave.join(bell, now());
        run(20ms);
        EXPECT_TRUE(port.gateway->run());
        EXPECT_TRUE(second_port.gateway->run());
        run(20ms);
    }

    base::Instant now() const { return port.board.now; }
    bool runs() const { return port.gateway->run_state() != gw::RunState::stopped; }
    bool second_runs() const { return second_port.gateway->run_state() != gw::RunState::stopped; }
    /// What the slave sends meanwhile.
    Bytes run(base::Microseconds time, bool axis_lives = true) {
        Bytes sent;
        for (const auto end = now() + time; now() < end;) {
            port.poll();
            second_port.poll();
            if (axis_lives) loop.poll(*port.controller, now(), now());
            if (axis_lives) second_loop.poll(*second_port.controller, now(), now());
            slave.take({}, now(), now());
            slave.poll(now());
            const auto bytes = slave.out(now());
            sent.insert(sent.end(), bytes.begin(), bytes.end());
            if (!bytes.empty()) slave.note_sent(bytes.size());
        }
        return sent;
    }
    void hear(const Bytes& bytes) {
        std::vector<ports::ReceivedByte> all;
        for (const std::uint8_t byte : bytes) all.push_back({byte, false});
        slave.take(all, now(), now());
    }
    /// A request that is not answered yet: the axis leaves no image, which is waited for 100 ms.
    void ask_in_vain(const Bytes& pdu) {
        run(60ms, false);
        hear(sealed(kUnit, pdu));
        EXPECT_EQ(run(40ms, false), Bytes{});
    }

    gateway::PortBench port;
    faces::AxisModel model{"x"};
    faces::AxisLoop loop{model, {}};
    gateway::PortBench second_port;
    faces::AxisModel second_model{"y"};
    faces::AxisLoop second_loop{second_model, {}};
    faces::Bell bell{[] {}};
    RtuSlave slave{{.unit = kUnit}, {&model, &second_model}};
};

TEST(RtuSlave, AnswersAfterTheSilence) {
    RtuBench line;
    line.hear(sealed(kUnit, kAskStatus));
    const auto asked = line.now();
    while (line.slave.out(line.now()).empty()) {
        ASSERT_LT(line.now() - asked, 1s);
        line.port.poll();
        line.loop.poll(*line.port.controller, line.now(), line.now());
        line.slave.poll(line.now());
    }
    EXPECT_GE(line.now() - asked, 2'005us);
    const auto out = line.slave.out(line.now());
    EXPECT_EQ(Bytes(out.begin(), out.begin() + 3), (Bytes{kUnit, 4, 2}));
}

TEST(RtuSlave, ALateAnswerIsSentIfTheLineIsSilent) {
    RtuBench line;
    line.ask_in_vain(kAskStatus);
    const Bytes answer = line.run(500ms);
    ASSERT_FALSE(answer.empty());
    EXPECT_EQ(answer[0], kUnit);
}

TEST(RtuSlave, ALateAnswerStaysOutOfAnothersTurn) {
    Bytes damaged = sealed(9, kAskStatus);
    damaged[3] ^= 1U;
    const Bytes half(damaged.begin(), damaged.begin() + 3);
    for (const Bytes& next :
         {sealed(9, kAskStatus), sealed(9, {0x2B, 0x0E, 1, 0}), sealed(0, {5, 0, 7, 0xFF, 0}),
          sealed(0, kOrderStop), damaged, half, Bytes{9}}) {
        for (const Bytes& request : {kAskStatus, Bytes{6, 0, 2, 0x20, 0}, kOrderStop}) {
            RtuBench line;
            line.ask_in_vain(request);
            line.hear(next);
            EXPECT_EQ(line.run(2s, false), Bytes{}) << "an axis that leaves no image";
            EXPECT_EQ(line.run(2s), Bytes{});
            line.hear(sealed(kUnit, kAskStatus));
            EXPECT_FALSE(line.run(500ms).empty()) << "the next one";
        }
    }
}

/// One that is ready, and waits for the silence.
TEST(RtuSlave, AnAnswerThatIsReadyStaysOutOfAnothersTurn) {
    RtuBench line;
    for (faces::AxisModel* axis : {&line.model, &line.second_model})
        static_cast<void>(axis->image(line.now()));
    line.run(20ms);
    line.hear(sealed(kUnit, kAskStatus));
    line.slave.poll(line.now());
    EXPECT_TRUE(line.slave.out(line.now()).empty());
    EXPECT_FALSE(line.slave.out(line.now() + 3ms).empty());
    line.hear(sealed(9, kAskStatus));
    EXPECT_TRUE(line.slave.out(line.now() + 3ms).empty());
    EXPECT_EQ(line.run(1s), Bytes{});
}

TEST(RtuSlave, ARequestWithoutAnAnswerIsCarriedOut) {
    RtuBench line;
    line.ask_in_vain(kOrderStop);
    EXPECT_TRUE(line.runs());
    line.hear(sealed(9, kAskStatus));
    EXPECT_EQ(line.run(2s), Bytes{});
    EXPECT_FALSE(line.runs());
}

/// The master waits for a motor's stop, no longer than for anything else.
TEST(RtuSlave, AnOrderUnderWayIsNotAnsweredIntoAnothersTurn) {
    RtuBench line;
    line.hear(sealed(kUnit, kOrderStop));
    line.slave.poll(line.now());
    EXPECT_EQ(line.run(kPause + 20ms, false), Bytes{});
    line.hear(sealed(9, kAskStatus));
    EXPECT_EQ(line.run(3s), Bytes{});
    EXPECT_FALSE(line.runs());
}

/// The master's driver is switched off, and what comes of it is no message.
TEST(RtuSlave, ACharacterDirectlyBehindTheRequestCostsNoAnswer) {
    RtuBench line;
    line.hear(sealed(kUnit, kAskStatus));
    line.run(1ms);
    line.hear({0});
    const auto heard = line.now();
    EXPECT_EQ(line.run(20ms), Bytes{}) << "it may be the begin of a message";
    EXPECT_FALSE(line.run(heard + 200ms - line.now()).empty());
}

Bytes joined(Bytes one, const Bytes& other) {
    one.insert(one.end(), other.begin(), other.end());
    return one;
}

/// Noise, a half frame, a neighbour's frame of unknown length before it; another request behind it, also one
/// for the other axis. Each in one piece, and a character at a time.
TEST(RtuSlave, AStopIsFoundWhateverIsBeforeAndBehindIt) {
    const Bytes stop = sealed(kUnit, kOrderStop);
    const Bytes read = sealed(kUnit, kAskStatus);
    const Bytes half(read.begin(), read.begin() + 5);
    struct Burst {
        Bytes bytes;
        bool is_for_all = false;
    };
    const std::vector<Burst> bursts{
        {joined({0}, stop)},
        {joined(half, stop)},
        {joined(sealed(9, {0x2B, 0x0E, 1, 0}), stop)},
        {joined(stop, read)},
        {joined(stop, sealed(kUnit + 1, kAskStatus))},
        {joined({0}, sealed(0, kOrderStop)), true},
        {sealed(0, {16, 0, 0, 0, 2, 4, 0, 2, 0, 7}), true},
    };
    for (const Burst& burst : bursts) {
        for (const bool is_in_one : {true, false}) {
            SCOPED_TRACE(testing::PrintToString(burst.bytes) + (is_in_one ? " in one" : " by characters"));
            RtuBench line;
            if (is_in_one) line.hear(burst.bytes);
            for (std::size_t i = 0; i < burst.bytes.size() && !is_in_one; ++i) {
                line.hear({burst.bytes[i]});
                line.run(573us);  // 11 bits at 19200 baud
            }
            line.run(2s);
            EXPECT_FALSE(line.runs());
            EXPECT_EQ(line.second_runs(), !burst.is_for_all);
            line.hear(read);
            EXPECT_FALSE(line.run(500ms).empty()) << "the next one is answered";
        }
    }
}

TEST(RtuSlave, OthersTalkIsPassedOver) {
    RtuBench line;
    for (const Bytes& one :
         {sealed(9, {3, 0, 0, 0, 2}), sealed(9, {3, 4, 1, 2, 3, 4}), sealed(12, kAskStatus)}) {
        line.hear(one);
        EXPECT_EQ(line.run(1ms), Bytes{});
    }
    line.hear(sealed(kUnit, kAskStatus));
    EXPECT_FALSE(line.run(500ms).empty());
}

/// What is removed before it changes nothing.
TEST(RtuSlave, AnAxisIsTheUnitOfItsOwn) {
    RtuBench line;
    const auto units_of = [&line](const std::vector<std::uint8_t>& units, const faces::Axes& axes) {
        RtuSlave slave{{.unit = kUnit, .settings = {.units = units}}, axes};
        faces::Bell bell{[] {}};
        slave.join(bell, line.now());
        std::vector<unsigned> answering;
        for (unsigned unit = 1; unit <= protocol::modbus::kHighestUnit; ++unit) {
            std::vector<ports::ReceivedByte> all;
            for (const std::uint8_t byte : sealed(static_cast<std::uint8_t>(unit), kAskStatus))
                all.push_back({byte, false});
            static_cast<void>(line.model.image(line.now()));
            line.run(30ms);
            slave.take(all, line.now(), line.now());
            slave.poll(line.now());
            slave.poll(line.now() + 200ms);
            const auto out = slave.out(line.now() + 200ms);
            if (out.empty()) continue;
            EXPECT_EQ(out[0], unit);
            answering.push_back(unit);
        }
        return answering;
    };
    faces::AxisModel other{"y"};
    EXPECT_EQ(units_of({}, {&other, &line.model}), (std::vector<unsigned>{10, 11}));
    EXPECT_EQ(units_of({3, 247}, {&other, &line.model}), (std::vector<unsigned>{3, 247}));
    EXPECT_EQ(units_of({247}, {&line.model}), (std::vector<unsigned>{247}));
    EXPECT_EQ(units_of({0, 4}, {&other, &line.model}), (std::vector<unsigned>{4, 10}));
}

}  // namespace
}  // namespace nplc::modbus
