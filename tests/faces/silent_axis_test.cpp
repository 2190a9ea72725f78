// Stops for an axis whose loop is halted: they are answered, and carried out when it goes on.
#include <gtest/gtest.h>

#include "edge_node.h"
#include "faces/axis_loop.h"
#include "modbus/session.h"
#include "port_bench.h"

namespace nplc::faces {
namespace {

namespace gw = registers::gateway;
using namespace std::chrono_literals;
using gateway::Bytes;

constexpr base::Milliseconds kLongestAnswer{1'000};  ///< a stop is answered
const Bytes kTwoSteps{{0xC0, 0, 0, 0x01, 0x80, 0, 0, 0}, {0xC1, 0, 0, 0x3E, 0x80, 1, 0, 0}};

struct SilentAxis : testing::Test {
    SilentAxis() { EXPECT_TRUE(port.upload_and_activate(kTwoSteps)); }

    void run(base::Microseconds time) {
        for (const auto end = now() + time; now() < end;) {
            port.poll();
            loop.poll(*port.controller, now(), now());
        }
    }
    /// The faces' time goes on, the axis's loop does not.
    void halt(base::Microseconds time) { port.board.now += time; }
    base::Instant now() const { return port.board.now; }
    Command order(gw::Command command) const { return Command::of(command, now()); }
    /// The outcome that a face gets which looks every 50 ms.
    std::optional<Completion> answer(CommandDesk::Client& client, base::Microseconds within) {
        for (const auto end = now() + within; now() < end; halt(50ms)) {
            if (const auto ended = client.take(now())) return ended;
        }
        return std::nullopt;
    }
    bool runs() const { return port.gateway->run_state() == gw::RunState::running; }
    void start() {
        ASSERT_TRUE(panel->submit(order(gw::Command::run)));
        run(50ms);
        ASSERT_EQ(panel->take()->result, Result::done);
        ASSERT_TRUE(runs());
    }

    gateway::PortBench port;
    AxisModel model{"x"};
    AxisLoop loop{model, {}};
    Bell bell{[] {}};
    std::unique_ptr<CommandDesk::Client> panel = model.join(Side::person, "panel", bell);
};

TEST_F(SilentAxis, AStopIsAnsweredWithinASecondAndObeyedLater) {
    for (const gw::Command stop : {gw::Command::stop, gw::Command::safe, gw::Command::hold}) {
        start();
        const auto id = panel->submit(order(stop));
        const auto ended = answer(*panel, kLongestAnswer);
        ASSERT_TRUE(ended);
        EXPECT_EQ(ended->id, *id);
        EXPECT_EQ(ended->result, Result::stop_unconfirmed);
        EXPECT_EQ(describe(*ended), "not confirmed: the motor may be moving; the axis does not answer");
        EXPECT_FALSE(answer(*panel, 5s)) << "once";
        run(50ms);
        EXPECT_FALSE(runs());
        const auto late = panel->take(now());
        ASSERT_TRUE(late);
        EXPECT_EQ(late->result, Result::done);
        ASSERT_TRUE(panel->submit(order(gw::Command::stop)));  // of what is held
        run(50ms);
        while (panel->take(now())) {
        }
    }
}

/// As by SIGSTOP of the whole process.
TEST_F(SilentAxis, AFaceThatWasHaltedTooGivesItsAxisTime) {
    start();
    ASSERT_TRUE(panel->submit(order(gw::Command::stop)));
    EXPECT_FALSE(panel->take(now()));
    halt(2s);
    EXPECT_FALSE(panel->take(now()));
    run(50ms);
    const auto ended = panel->take(now());
    ASSERT_TRUE(ended);
    EXPECT_EQ(ended->result, Result::done);
}

TEST_F(SilentAxis, EachRepeatedStopIsAnswered) {
    const auto first = panel->submit(order(gw::Command::stop));
    ASSERT_TRUE(answer(*panel, kLongestAnswer));
    EXPECT_EQ(panel->submit(order(gw::Command::stop)), first);
    const auto again = answer(*panel, kLongestAnswer);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->id, *first);
}

TEST_F(SilentAxis, ALoopThatHaltsAfterItHasReadTheStop) {
    start();
    port.board.stop_is_confirmed = false;
    ASSERT_TRUE(panel->submit(order(gw::Command::stop)));
    run(10ms);
    const auto ended = answer(*panel, 1'200ms);
    ASSERT_TRUE(ended);
    EXPECT_TRUE(ended->is_axis_silent);
}

TEST_F(SilentAxis, AnAxisThatAnswersIsNotCalledSilent) {
    start();
    port.board.stop_is_confirmed = false;
    ASSERT_TRUE(panel->submit(order(gw::Command::stop)));
    std::vector<Completion> all;
    for (int i = 0; i < 200; ++i) {
        run(10ms);
        if (const auto ended = panel->take(now())) all.push_back(*ended);
    }
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].result, Result::stop_unconfirmed);
    EXPECT_FALSE(all[0].is_axis_silent);
}

TEST_F(SilentAxis, NothingStartsLate) {
    ASSERT_TRUE(panel->submit(order(gw::Command::stop)));
    ASSERT_TRUE(panel->submit(order(gw::Command::run)));
    halt(1'001ms);
    run(100ms);
    EXPECT_FALSE(runs());
    // Also one that is young enough does not overtake the stop before it.
    ASSERT_TRUE(panel->submit(order(gw::Command::stop)));
    halt(900ms);
    ASSERT_TRUE(panel->submit(order(gw::Command::run)));
    run(100ms);
    EXPECT_FALSE(runs());
}

TEST_F(SilentAxis, AHoldWhereAStopIsNotConfirmedSaysThatTheMotorMayMove) {
    start();
    port.board.stop_is_confirmed = false;
    ASSERT_TRUE(panel->submit(order(gw::Command::stop)));
    run(1'100ms);
    ASSERT_EQ(panel->take(now())->result, Result::stop_unconfirmed);
    ASSERT_TRUE(panel->submit(order(gw::Command::hold)));
    run(50ms);
    const auto ended = panel->take(now());
    ASSERT_TRUE(ended);
    EXPECT_EQ(ended->result, Result::stop_unconfirmed);
    EXPECT_NE(describe(*ended).find("the motor may be moving"), std::string::npos);
}

// 5: write a coil; FF00h is on. Exception 4, and `result` 43 (modbus/README.md).
TEST_F(SilentAxis, APlcIsAnswered) {
    start();
    std::vector<std::unique_ptr<modbus::Unit>> units;
    units.push_back(std::make_unique<modbus::Unit>(model, modbus::Settings{}));
    modbus::Session session(units, "PLC", bell);
    const std::array<std::uint8_t, 5> stop{5, 0, modbus::kStop, 0xFF, 0};
    ASSERT_FALSE(session.serve(1, stop, {.now = now(), .arrived = now()}));
    std::optional<modbus::Answer> answer;
    for (const auto end = now() + kLongestAnswer; !answer && now() < end; halt(20ms))
        answer = session.take(now());
    ASSERT_TRUE(answer);
    ASSERT_EQ(answer->bytes().size(), 2U);
    EXPECT_EQ(answer->bytes()[0], 0x85);
    EXPECT_EQ(answer->bytes()[1], 4);
    EXPECT_EQ(units[0]->handshake("PLC").result, 43);
    run(50ms);
    EXPECT_FALSE(runs());
}

// 4: read input registers, 50 and 51 (modbus/README.md, The map).
TEST_F(SilentAxis, APlcReadsForHowLongAStopIsNotConfirmed) {
    std::vector<std::unique_ptr<modbus::Unit>> units;
    units.push_back(std::make_unique<modbus::Unit>(model, modbus::Settings{}));
    modbus::Session session(units, "PLC", bell);
    const auto milliseconds = [&] {
        constexpr std::array<std::uint8_t, 5> kRead{4, 0, 50, 0, 2};
        EXPECT_TRUE(session.serve(1, kRead, {.now = now(), .arrived = now()}));  // asks for a new image
        run(100ms);
        const auto answer = session.serve(1, kRead, {.now = now(), .arrived = now()});
        EXPECT_TRUE(answer && answer->bytes().size() == 6);
        std::uint32_t value = 0;
        for (std::size_t i = 2; answer && i < answer->bytes().size(); ++i)
            value = value << 8 | answer->bytes()[i];
        return value;
    };
    start();
    EXPECT_EQ(milliseconds(), 0U);
    port.board.stop_takes = 71s;
    ASSERT_TRUE(panel->submit(order(gw::Command::stop)));
    run(70s);
    const std::uint32_t time = milliseconds();
    EXPECT_GE(time, 70'000U);
    EXPECT_LE(time, 70'100U);
    run(1s);
    EXPECT_EQ(milliseconds(), 0U);
}

struct Scada {
    Scada(AxisModel& model, Bell& bell) : node(options(), {&model}, bell) {
        node.begin_session();
        node.connected();
    }
    static mqtt::Options options() {
        mqtt::Options options;
        options.commands = {gw::Command::run, gw::Command::stop};
        return options;
    }
    void tick(base::Instant now) {
        node.tick({.now = now, .milliseconds = milliseconds(now)},
                  [this](const std::string& topic, const std::string& payload) {
                      sent.emplace_back(topic, *mqtt::decode(payload));
                      return true;
                  });
    }
    static std::uint64_t milliseconds(base::Instant now) {
        return 1'700'000'000'000 + static_cast<std::uint64_t>(now.time_since_epoch().count()) / 1'000;
    }
    void order(const std::string& name, base::Instant now) {
        mqtt::Metric metric;
        metric.name = "Command/" + name;
        metric.timestamp = milliseconds(now);
        metric.type = mqtt::DataType::boolean;
        metric.value = true;
        const std::string payload = mqtt::encode({.timestamp = milliseconds(now), .metrics = {metric}});
        node.receive({.topic = "spBv1.0/nanoplc/DCMD/nanoplc/x", .payload = payload, .arrived = now},
                     {.now = now, .milliseconds = milliseconds(now)});
    }
    bool has_said(const std::string& text) const {
        for (const auto& [topic, payload] : sent) {
            for (const mqtt::Metric& metric : payload.metrics) {
                const auto* value = std::get_if<std::string>(&metric.value);
                if (topic.find("/DDATA/") != std::string::npos && value != nullptr && *value == text)
                    return true;
            }
        }
        return false;
    }
    bool has_died() const { return !sent.empty() && sent.back().first.find("/DDEATH/") != std::string::npos; }

    mqtt::EdgeNode node;
    std::vector<std::pair<std::string, mqtt::Payload>> sent;
};

TEST_F(SilentAxis, AScadaSystemIsAnswered) {
    constexpr const char* kText = "not confirmed: the motor may be moving; the axis does not answer";
    start();
    Scada scada(model, bell);
    for (int i = 0; i < 40; ++i) {
        run(50ms);
        scada.tick(now());
    }
    // Also where its device would be dead by then: an image is old after a second.
    halt(700ms);
    scada.order("stop", now());
    for (const auto end = now() + kLongestAnswer; now() < end; halt(50ms)) scada.tick(now());
    EXPECT_TRUE(scada.has_said(kText));
    scada.tick(now());
    EXPECT_TRUE(scada.has_died());
    run(50ms);
    EXPECT_FALSE(runs());
}

TEST_F(SilentAxis, AStopForADeadDeviceIsObeyedAndARunIsNot) {
    start();
    Scada scada(model, bell);
    for (int i = 0; i < 40; ++i) {
        run(50ms);
        scada.tick(now());
    }
    halt(3s);
    scada.tick(now());
    ASSERT_TRUE(scada.has_died());
    scada.order("stop", now());
    run(50ms);
    EXPECT_FALSE(runs());
    halt(3s);
    scada.tick(now());
    scada.order("run", now());
    run(50ms);
    EXPECT_FALSE(runs());
}

}  // namespace
}  // namespace nplc::faces
