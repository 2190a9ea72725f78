// Several Modbus masters, and one that is waiting, on a gateway whose board is the test's own.
#include <gtest/gtest.h>

#include "faces/axis_loop.h"
#include "modbus/session.h"
#include "set_points_bench.h"

namespace nplc::modbus {
namespace {

namespace gw = registers::gateway;
using namespace std::chrono_literals;
using gateway::SetPointBench;
using Words = std::vector<unsigned>;

constexpr std::uint8_t kReadHoldings = 3;
constexpr std::uint8_t kReadInputs = 4;
constexpr std::uint8_t kWriteCoil = 5;
constexpr std::uint8_t kWriteWords = 16;
constexpr unsigned kRun = 1;
constexpr unsigned kStopOrder = 2;

/// A master on a connection of its own.
struct Master {
    Master(std::vector<std::unique_ptr<Unit>>& units, const std::string& address, faces::Bell& bell)
        : session(units, address, bell) {}
    Session session;
};

struct Plant {
    Plant() {
        EXPECT_TRUE(port.upload_and_activate(SetPointBench::content()));
        units.push_back(std::make_unique<Unit>(model, settings));
        run(20ms);
    }

    base::Instant now() const { return port.board.now; }
    bool runs() const { return port.gateway->run_state() != gw::RunState::stopped; }
    void poll() {
        port.poll();
        loop.poll(*port.controller, now(), now());
    }
    void run(base::Microseconds time) {
        for (const auto end = now() + time; now() < end;) poll();
    }
    std::optional<Answer> begin(Master& master, const std::vector<std::uint8_t>& pdu) {
        static_cast<void>(model.image(now()));
        run(20ms);
        return master.session.serve(1, pdu, {.now = now(), .arrived = now()});
    }
    /// The answer within 5 s.
    std::optional<Answer> ask(Master& master, const std::vector<std::uint8_t>& pdu) {
        std::optional<Answer> answer = begin(master, pdu);
        for (const auto end = now() + 5s; !answer && now() < end; poll()) answer = master.session.take(now());
        EXPECT_TRUE(answer);
        return answer;
    }
    static std::vector<std::uint8_t> written(unsigned address, const Words& words) {
        std::vector<std::uint8_t> pdu{kWriteWords,
                                      0,
                                      static_cast<std::uint8_t>(address),
                                      0,
                                      static_cast<std::uint8_t>(words.size()),
                                      static_cast<std::uint8_t>(2 * words.size())};
        for (const unsigned word : words) {
            pdu.push_back(static_cast<std::uint8_t>(word >> 8));
            pdu.push_back(static_cast<std::uint8_t>(word));
        }
        return pdu;
    }
    /// True if it was not refused.
    bool write(Master& master, unsigned address, const Words& words) {
        const auto answer = ask(master, written(address, words));
        return answer && answer->bytes()[0] == kWriteWords;
    }
    void coil(Master& master, std::uint8_t number, bool level) {
        ask(master, {kWriteCoil, 0, number, static_cast<std::uint8_t>(level ? 0xFF : 0), 0});
    }
    /// done_number and result.
    Words ended(Master& master) {
        const auto answer = ask(master, {kReadInputs, 0, kDoneNumber, 0, 2});
        if (!answer || answer->bytes().size() < 6) return {};
        const auto bytes = answer->bytes();
        return {unsigned{bytes[2]} << 8 | bytes[3], unsigned{bytes[4]} << 8 | bytes[5]};
    }

    unsigned input(Master& master, std::uint8_t address) {
        const auto answer = ask(master, {kReadInputs, 0, address, 0, 1});
        const auto bytes = answer ? answer->bytes() : std::span<const std::uint8_t>{};
        return bytes.size() < 4 ? 0x1'0000U : unsigned{bytes[2]} << 8 | bytes[3];
    }
    /// As `nanoctl reset`: a start in the same process.
    void reset() {
        port.start({.autostart = false});
        loop.restarted();
        run(20ms);
    }

    SetPointBench port;
    faces::AxisModel model{"x"};
    faces::AxisLoop loop{model, {}};
    faces::Bell bell{[] {}};
    Settings settings;
    std::vector<std::unique_ptr<Unit>> units;
};

constexpr unsigned kTooLate = 19;

struct TwoMasters : testing::TestWithParam<const char*> {
    Plant plant;
    Master plc{plant.units, "Modbus 10.0.0.1", plant.bell};
    Master other{plant.units, GetParam(), plant.bell};
};
INSTANTIATE_TEST_SUITE_P(FromOneAddressAndTwo, TwoMasters,
                         testing::Values("Modbus 10.0.0.1", "Modbus 10.0.0.2"),
                         [](const auto& test) { return test.index == 0 ? "One" : "Two"; });

/// It writes its block in cycles, and has nothing to do with the 0 of another one.
TEST_P(TwoMasters, AnothersZeroStartsNothing) {
    EXPECT_TRUE(plant.write(plc, 0, {0, 0}));
    EXPECT_TRUE(plant.write(plc, 0, {kRun, 5}));
    EXPECT_TRUE(plant.runs());
    plant.coil(plc, kStop, true);
    EXPECT_FALSE(plant.runs());
    EXPECT_TRUE(plant.write(other, 0, {0, 0}));
    EXPECT_TRUE(plant.write(plc, 0, {kRun, 5}));
    EXPECT_FALSE(plant.runs());
    EXPECT_TRUE(plant.write(plc, 0, {kRun, 6}));
    EXPECT_TRUE(plant.runs());
}

TEST_P(TwoMasters, AnothersZeroDoesNotArmABlockFromBeforeTheStart) {
    EXPECT_TRUE(plant.write(plc, 0, {kRun, 5}));
    EXPECT_EQ(plant.ended(plc), (Words{5, kTooLate}));
    EXPECT_TRUE(plant.write(other, 0, {0, 0}));
    EXPECT_TRUE(plant.write(plc, 0, {kRun, 5}));
    EXPECT_FALSE(plant.runs());
}

TEST_P(TwoMasters, AnothersCoilStartsNothing) {
    plant.coil(plc, 0, false);
    plant.coil(plc, 0, true);
    EXPECT_TRUE(plant.runs());
    plant.coil(plc, kStop, true);
    plant.coil(other, 0, false);
    plant.coil(plc, 0, true);
    EXPECT_FALSE(plant.runs());
}

TEST_P(TwoMasters, AfterAStartOfTheGatewayNothingIsCarriedOutBeforeAZero) {
    EXPECT_TRUE(plant.write(plc, 0, {0, 0}));
    EXPECT_TRUE(plant.write(plc, 0, {kRun, 5}));
    plant.coil(plc, 0, false);
    EXPECT_TRUE(plant.runs());
    plant.reset();
    EXPECT_TRUE(plant.write(plc, 0, {kRun, 6}));
    EXPECT_EQ(plant.ended(plc), (Words{6, kTooLate}));
    plant.coil(plc, 0, true);
    EXPECT_FALSE(plant.runs());
    EXPECT_TRUE(plant.write(other, 0, {0, 0}));
    EXPECT_TRUE(plant.write(plc, 0, {kRun, 6}));
    EXPECT_FALSE(plant.runs());
    EXPECT_TRUE(plant.write(plc, 0, {0, 0}));
    EXPECT_TRUE(plant.write(plc, 0, {kRun, 7}));
    EXPECT_TRUE(plant.runs());
}

/// Their number is counted anew by the gateway.
TEST_P(TwoMasters, NewEventsAreThoseSinceTheStartOfTheGateway) {
    for (const unsigned number : {1U, 2U, 3U}) {
        EXPECT_TRUE(plant.write(plc, 0, {0, 0}));
        EXPECT_TRUE(plant.write(plc, 0, {kRun, number}));
        plant.coil(plc, kStop, false);
        plant.coil(plc, kStop, true);
    }
    const unsigned before = plant.input(plc, kNewEvents);
    EXPECT_GE(before, 6U) << "started and stopped three times";
    plant.coil(plc, kAcknowledge, true);
    EXPECT_EQ(plant.input(plc, kNewEvents), 0U);
    plant.reset();
    EXPECT_LT(plant.input(plc, kNewEvents), before);
    EXPECT_EQ(plant.input(plc, kNewEvents), *plant.port.read(gw::LOG_COUNT));
}

struct TwoAddresses : testing::Test {
    Plant plant;
    Master plc{plant.units, "Modbus 10.0.0.1", plant.bell};
    Master panel{plant.units, "Modbus 10.0.0.2", plant.bell};
};

TEST_F(TwoAddresses, EachHasNumbersAndResultsOfItsOwn) {
    constexpr unsigned kNoRecipe = 26;
    EXPECT_TRUE(plant.write(plc, 0, {0, 0}));
    EXPECT_TRUE(plant.write(panel, 0, {0, 0}));
    EXPECT_TRUE(plant.write(plc, 0, {kRun, 5}));
    EXPECT_TRUE(plant.write(panel, kRecipe, {3}));
    EXPECT_TRUE(plant.write(panel, 0, {kLoadRecipe, 5})) << "the same number, and another master's";
    EXPECT_EQ(plant.ended(panel), (Words{5, kNoRecipe}));
    EXPECT_EQ(plant.ended(plc), (Words{5, 0}));
    EXPECT_TRUE(plant.runs());
}

TEST_F(TwoAddresses, AMasterGoesOnOverAnotherConnection) {
    EXPECT_TRUE(plant.write(plc, 0, {0, 0}));
    EXPECT_TRUE(plant.write(plc, 0, {kRun, 5}));
    plant.coil(panel, kStop, true);
    Master again{plant.units, "Modbus 10.0.0.1", plant.bell};
    EXPECT_TRUE(plant.write(again, 0, {kRun, 5}));
    EXPECT_FALSE(plant.runs());
    EXPECT_EQ(plant.ended(again), (Words{5, 0}));
}

TEST_F(TwoAddresses, WhoWasForgottenBeginsAnew) {
    EXPECT_TRUE(plant.write(plc, 0, {0, 0}));
    for (std::size_t i = 0; i < Unit::kMostAddresses; ++i) {
        Master one{plant.units, "Modbus " + std::to_string(i), plant.bell};
        EXPECT_TRUE(plant.write(one, 0, {0, 0}));
    }
    EXPECT_TRUE(plant.write(plc, 0, {kRun, 7}));
    EXPECT_EQ(plant.ended(plc), (Words{7, kTooLate}));
    EXPECT_FALSE(plant.runs());
}

struct Silent : TwoAddresses {
    Silent() {
        plant.settings.on_silence = Silence::stop;
        plant.settings.silence = 2s;
        plant.settings.tell = [this](const std::string& axis, const std::string& text) {
            told.push_back(axis + ": " + text);
        };
    }
    bool is_due() { return plant.units[0]->due(plant.now()).has_value(); }
    std::vector<std::string> told;
};

TEST_F(Silent, AMasterIsNamed) {
    EXPECT_TRUE(plant.write(plc, 0, {0, 0}));
    EXPECT_TRUE(plant.write(plc, 0, {kRun, 5}));
    EXPECT_FALSE(is_due());
    plant.run(2'100ms);
    EXPECT_TRUE(is_due());
    EXPECT_FALSE(is_due()) << "once";
    EXPECT_EQ(told, (std::vector<std::string>{
                        "x: Modbus 10.0.0.1, which operated last, has said nothing for 2000 ms: stop"}));
}

TEST_F(Silent, AMasterThatLeavesIsNamed) {
    {
        Master brief{plant.units, "Modbus 10.0.0.3", plant.bell};
        EXPECT_TRUE(plant.write(brief, 0, {0, 0}));
        EXPECT_TRUE(plant.write(brief, 0, {kRun, 5}));
    }
    plant.run(2'100ms);
    EXPECT_TRUE(is_due());
    EXPECT_EQ(told, (std::vector<std::string>{"x: Modbus 10.0.0.3, which operated last, has left: stop"}));
}

/// Its command may have been carried out.
TEST_F(Silent, AMasterThatDoesNotWaitForItsAnswerIsOne) {
    {
        Master brief{plant.units, "Modbus 10.0.0.3", plant.bell};
        EXPECT_TRUE(plant.write(brief, 0, {0, 0}));
        EXPECT_FALSE(plant.begin(brief, Plant::written(0, {kRun, 5})));
        plant.run(20ms);
    }
    ASSERT_TRUE(plant.runs());
    plant.run(2'100ms);
    EXPECT_TRUE(is_due());
}

/// Its asking does not hide the silence of the one that has the seat.
TEST_F(Silent, WhoWasRefusedIsNotTheMaster) {
    constexpr unsigned kSeatTaken = 22;
    EXPECT_TRUE(plant.write(plc, 0, {0, 0}));
    EXPECT_TRUE(plant.write(plc, 0, {kRun, 5}));
    EXPECT_TRUE(plant.write(panel, 0, {0, 0}));
    EXPECT_TRUE(plant.write(panel, 0, {kRun, 5}));
    EXPECT_EQ(plant.ended(panel), (Words{5, kSeatTaken}));
    plant.run(2'100ms);
    static_cast<void>(plant.ended(panel));
    EXPECT_TRUE(is_due());
}

/// A storage that takes 2,000 polls of 250 us for each operation: longer than a master waits.
struct SlowStorage : testing::Test {
    SlowStorage() {
        EXPECT_TRUE(plant.write(plc, 0, {0, 0}));
        EXPECT_TRUE(plant.write(plc, 0, {kRun, 1}));
        plant.port.flash.work_for(2'000);
        EXPECT_FALSE(plant.begin(plc, Plant::written(0, {kTakeSetPoints, 2, 0, 0, 0, 0, 0, 900})));
    }
    /// Until it has ended.
    unsigned result_of(unsigned number) {
        for (const auto end = plant.now() + 60s; plant.now() < end; plant.run(100ms)) {
            static_cast<void>(plc.session.take(plant.now()));
            if (const Words ended = plant.ended(plc); ended[0] == number) return ended[1];
        }
        return 0xFFFF;
    }
    Plant plant;
    Master plc{plant.units, "Modbus 10.0.0.1", plant.bell};
};

TEST_F(SlowStorage, IsAnsweredInASecondAndDoneNumberTellsTheEnd) {
    const base::Instant begun = plant.now();
    std::optional<Answer> answer;
    for (; !answer && plant.now() < begun + 5s; plant.run(10ms)) answer = plc.session.take(plant.now());
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->bytes()[0], kWriteWords);
    EXPECT_LE(plant.now() - begun, 1'100ms);
    EXPECT_EQ(plant.ended(plc), (Words{1, 0})) << "that of before";
    EXPECT_EQ(result_of(2), 0U);
}

TEST_F(SlowStorage, DoesNotHoldUpAStopOfItsOwnMaster) {
    const std::vector<std::uint8_t> stop = Plant::written(0, {kStopOrder, 3});
    plant.run(50ms);
    ASSERT_TRUE(plc.session.is_waiting());
    ASSERT_TRUE(Session::asks_stop(stop));
    EXPECT_EQ(plc.session.put_aside().bytes()[0], kWriteWords);
    EXPECT_TRUE(plant.runs());
    const base::Instant asked = plant.now();
    ASSERT_TRUE(plant.ask(plc, stop));
    EXPECT_LE(plant.now() - asked, 1s);
    EXPECT_FALSE(plant.runs());
    EXPECT_EQ(plant.ended(plc), (Words{3, 0}));
    plant.run(30s);
    EXPECT_EQ(plant.ended(plc), (Words{3, 0})) << "the older one tells nothing any more";
}

TEST_F(SlowStorage, AStopWithoutANumberLeavesThatOfTheChange) {
    static_cast<void>(plc.session.put_aside());
    EXPECT_TRUE(plant.write(plc, 0, {kStopOrder}));
    EXPECT_FALSE(plant.runs());
    EXPECT_EQ(plant.ended(plc), (Words{1, 0}));
    EXPECT_EQ(result_of(2), 0U);
}

/// A value of two words is read whole or not at all: half of each would be of different moments.
TEST(ModbusHalves, AreRefusedInEachWordOrder) {
    constexpr std::uint8_t kTimer = 18;
    constexpr std::uint8_t kBefore = kTimer - 1;
    for (const bool low_first : {false, true}) {
        Plant plant;
        plant.settings.low_word_first = low_first;
        Master plc{plant.units, "Modbus 10.0.0.1", plant.bell};
        const auto read = [&](std::uint8_t function, unsigned address, std::uint8_t count) {
            const auto answer = plant.ask(plc, {function, static_cast<std::uint8_t>(address >> 8),
                                                static_cast<std::uint8_t>(address), 0, count});
            const auto bytes = answer ? answer->bytes() : std::span<const std::uint8_t>{};
            return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
        };
        const std::vector<std::uint8_t> no_address{kReadInputs | 0x80U, 2};
        EXPECT_EQ(read(kReadInputs, kTimer, 1), no_address) << "the first half";
        EXPECT_EQ(read(kReadInputs, kTimer + 1, 1), no_address) << "the second half";
        EXPECT_EQ(read(kReadInputs, kBefore, 2), no_address) << "ends between them";
        EXPECT_EQ(read(kReadInputs, kTimer + 1, 2), no_address) << "begins between them";
        EXPECT_EQ(read(kReadInputs, kSetPointValues + 1, 2), no_address) << "halves of two set-points";
        EXPECT_EQ(read(kReadInputs, kTimer, 2).size(), 6U) << "whole";
        EXPECT_EQ(read(kReadInputs, kBefore, 3).size(), 8U) << "whole, with the one before it";
        EXPECT_EQ(read(kReadInputs, kSetPointValues, 2).size(), 6U) << "a set-point";
        const std::vector<std::uint8_t> no_holding{kReadHoldings | 0x80U, 2};
        EXPECT_EQ(read(kReadHoldings, kSetPointsNew, 1), no_holding);
        EXPECT_EQ(read(kReadHoldings, kSetPointsNew + 1, 1), no_holding);
        EXPECT_EQ(read(kReadHoldings, kSetPointsNew, 2).size(), 6U);
    }
}

TEST(ModbusStops, AreKnownInEveryForm) {
    EXPECT_TRUE(Session::asks_stop(std::vector<std::uint8_t>{5, 0, 1, 0xFF, 0}));
    EXPECT_TRUE(Session::asks_stop(std::vector<std::uint8_t>{5, 0, 3, 0xFF, 0}));
    EXPECT_TRUE(Session::asks_stop(std::vector<std::uint8_t>{15, 0, 0, 0, 8, 1, 0x04}));
    EXPECT_TRUE(Session::asks_stop(std::vector<std::uint8_t>{6, 0, 0, 0, 6}));
    EXPECT_FALSE(Session::asks_stop(std::vector<std::uint8_t>{5, 0, 1, 0, 0})) << "level 0";
    EXPECT_FALSE(Session::asks_stop(std::vector<std::uint8_t>{5, 0, 0, 0xFF, 0})) << "run";
    EXPECT_FALSE(Session::asks_stop(std::vector<std::uint8_t>{15, 0, 0, 0, 9, 2, 0x04, 0})) << "no such coil";
    EXPECT_FALSE(Session::asks_stop(std::vector<std::uint8_t>{6, 0, 1, 0, 2})) << "a number";
    EXPECT_FALSE(Session::asks_stop(std::vector<std::uint8_t>{3, 0, 0, 0, 2})) << "a read";
    EXPECT_FALSE(Session::asks_stop(std::vector<std::uint8_t>{6, 0, 0, 0})) << "damaged";
}

}  // namespace
}  // namespace nplc::modbus
