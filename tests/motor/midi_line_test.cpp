// The serial link and the driver against bytes written down from 000 §II, §III and §VI by hand, and against
// everything that can come instead.

#include <cstdio>
#include <string>

#include "midi_bench.h"
#include "scripted_line.h"

namespace nplc::motor {
namespace {

using Kind = MidiOutcome::Kind;

/// `\x02` Stx, `\x03` Etx, `\x06` Ack, `\x13` Xoff, `\x15` Nack, `\x17` Xonerror, `\x1A` Xon.
const std::string kStatus =
    "\x02"
    "01400210000000000A3"
    "\x03";
const std::string kNoTrip =
    "\x06\x13\x02"
    "011"
    "00"
    "1"
    "00000000"
    "11"
    "\x03\x1A";
const std::string kDone = "\x06\x13\x1A";
/// 000, the example: 300 rpm of a MAC23.
const std::string kRun =
    "\x02"
    "01400150000000320AB"
    "\x03";

struct MidiLineTest : testing::Test {
    ScriptedLine line;
    MidiV24Link link{line, {}};
    base::Instant now{1s};

    std::string sent() {
        const Bytes bytes = line.take();
        return {bytes.begin(), bytes.end()};
    }
    MidiOutcome hear(const std::string& text) {
        MidiOutcome last;
        for (const char c : text) {
            line.received.push_back({static_cast<std::uint8_t>(c), false});
            now += base::Microseconds(261);
            const MidiOutcome outcome = link.poll(now);
            if (outcome.kind != Kind::none) last = outcome;
        }
        return last;
    }
    void ask() { link.begin({.is_query = true, .number = midi::GET_STATUS}, now); }
    void run() { link.begin({.number = midi::RUN, .data = 0x320}, now); }
    Kind command_hears(const std::string& text) {
        run();
        return hear(text).kind;
    }
    Kind query_hears(const std::string& text) {
        ask();
        return hear(text).kind;
    }
};

TEST_F(MidiLineTest, TheManualsBytes) {
    run();
    EXPECT_EQ(sent(), kRun);
    EXPECT_EQ(hear(kDone).kind, Kind::accepted);
    ask();
    EXPECT_EQ(sent(), kStatus);
    const MidiOutcome outcome = hear(
        "\x06\x13\x02"
        "011"
        "00"
        "1"
        "08000080"
        "21"
        "\x03\x1A");
    EXPECT_EQ(outcome.kind, Kind::value);
    EXPECT_EQ(outcome.value, 0x0800'0080U);
    // 28h AFh, Imax: 2 x 30h + 32h + 38h + 41h + 46h + 8 x 30h = 2D1h.
    link.begin({.is_query = true, .number = midi::GET_RAM, .sub_index = midi::kImaxAddress}, now);
    EXPECT_EQ(sent(),
              "\x02"
              "0140028AF00000000D1"
              "\x03");
}

TEST_F(MidiLineTest, EveryAnswerAndEveryNonsense) {
    EXPECT_EQ(command_hears("\x06\x13\x17"), Kind::refused);
    EXPECT_EQ(command_hears("\x06\x13\x18"), Kind::refused);
    EXPECT_EQ(command_hears("\x15"), Kind::not_taken);
    EXPECT_EQ(command_hears("\x06\x15"), Kind::unclear);
    now += 5ms;
    EXPECT_EQ(command_hears("\x1A"), Kind::unclear) << "Ack and Xoff are missing";
    now += 5ms;
    EXPECT_EQ(command_hears(kNoTrip), Kind::unclear) << "a value for a command";
    now += 5ms;
    EXPECT_EQ(query_hears(kDone), Kind::unclear) << "no value for a query";
    now += 5ms;
    EXPECT_EQ(query_hears("\x06\x13\x02"
                          "011"
                          "01"
                          "1"
                          "00000000"
                          "12"
                          "\x03\x1A"),
              Kind::unclear)
        << "another module's";
    now += 5ms;
    EXPECT_EQ(query_hears("\x06\x13\x02"
                          "011"
                          "00"
                          "2"
                          "00000000"
                          "12"
                          "\x03\x1A"),
              Kind::unclear)
        << "another query's";
    now += 5ms;
    EXPECT_EQ(query_hears("\x06\x13\x02"
                          "011"
                          "00"
                          "1"
                          "00000000"
                          "12"
                          "\x03\x1A"),
              Kind::unclear)
        << "wrong sum";
    now += 5ms;
    EXPECT_EQ(query_hears(kNoTrip), Kind::value);
}

TEST_F(MidiLineTest, SilenceEndsInBoundedTime) {
    run();
    // 21 characters there, 21 back, 100 ms.
    EXPECT_EQ(link.next_poll(now), now + 42 * base::Microseconds(261) + 100ms);
    now = link.next_poll(now);
    EXPECT_EQ(link.poll(now).kind, Kind::unclear);
    EXPECT_FALSE(link.busy());
}

TEST_F(MidiLineTest, AfterAnUnclearAnswerTheLineMustFallSilent) {
    EXPECT_EQ(command_hears("\x1A"), Kind::unclear);
    sent();
    ask();
    EXPECT_EQ(sent(), "");
    EXPECT_EQ(hear(kDone).kind, Kind::none) << "late, and nobody's";
    EXPECT_EQ(sent(), "");
    now += 5ms;
    EXPECT_EQ(link.poll(now).kind, Kind::none);
    EXPECT_EQ(sent(), kStatus);
    EXPECT_EQ(hear(kNoTrip).kind, Kind::value);
}

TEST_F(MidiLineTest, ALineThatNeverFallsSilentTakesNothing) {
    EXPECT_EQ(command_hears("\x1A"), Kind::unclear);
    sent();
    run();
    MidiOutcome outcome;
    for (int i = 0; i < 1'000 && outcome.kind == Kind::none; ++i) outcome = hear("U");
    EXPECT_EQ(outcome.kind, Kind::not_taken);
    EXPECT_EQ(sent(), "");
}

TEST_F(MidiLineTest, AFramingErrorSpoilsTheAnswer) {
    run();
    line.received.push_back({0x06, true});
    EXPECT_EQ(hear(kDone).kind, Kind::unclear);
}

/// The driver on this line: it must have started.
struct MidiScriptTest : MidiLineTest {
    MidiMotor driver{link, {.model = midi::Model::mac23}};

    /// Polls at the driver's own deadlines until it sends a request; answers its text without frame, length
    /// and sum.
    std::string request() {
        for (int i = 0; i < 10'000; ++i) {
            driver.poll(now);
            const std::string text = sent();
            if (!text.empty()) return text.substr(4, 14);
            now = std::min(driver.next_poll(now), now + base::Microseconds(10'000));
        }
        return {};
    }
    void answer(const std::string& text) {
        for (const char c : text) {
            line.received.push_back({static_cast<std::uint8_t>(c), false});
            now += base::Microseconds(261);
        }
        driver.poll(now);
        unanswered_ = sent();
    }
    /// The next request, sent already or not.
    std::string next() {
        if (unanswered_.empty()) return request();
        return std::exchange(unanswered_, {}).substr(4, 14);
    }
    std::string value(char digit, const std::string& data) {
        std::string fields = std::string("00") + digit + data;
        unsigned sum = 0;
        for (const char c : fields) sum += static_cast<unsigned char>(c);
        constexpr char kHex[] = "0123456789ABCDEF";
        return "\x06\x13\x02"
               "011" +
               fields + kHex[sum >> 4 & 15] + kHex[sum & 15] + "\x03\x1A";
    }
    /// Answers queries as a healthy module at rest does, until something else is sent; that is answered to.
    std::string until_command(int most = 400) {
        for (int i = 0; i < most; ++i) {
            const std::string text = next();
            if (text.empty() || text[2] != '2') return text;
            if (text[3] == '0') answer(value('0', position));
            if (text[3] == '1') answer(value('1', status));
            if (text[3] == '5') answer(value('5', speeds));
            if (text[3] == '6') answer(value('6', "01801000"));
            if (text[3] == '7') answer(value('7', busy ? "00000000" : "00000800"));
            if (text[3] == '8') answer(value('8', "80000000"));
            if (driver.error()) return {};
        }
        return {};
    }
    void start() {
        EXPECT_EQ(until_command(), "");
        EXPECT_EQ(driver.link(), Link::up);
        EXPECT_TRUE(driver.orders_complete());
    }
    void turn() {
        driver.send(word(registers::V_SOLL, 629));  // 503316.48 / 629 = 800.2
        driver.send(word(registers::MODE_REG, 1));
        EXPECT_EQ(until_command(), "00150000000320");
    }

    std::string position = "00000000";
    std::string status = "00000000";
    std::string speeds = "05000320";
    bool busy = false;

  private:
    std::string unanswered_;
};

TEST_F(MidiScriptTest, StartsByAskingWhatTheModuleHas) {
    EXPECT_EQ(next(), "00210000000000");
    answer(kNoTrip);
    EXPECT_EQ(driver.link(), Link::starting);
    EXPECT_EQ(next(), "0028AF00000000");
    answer(value('8', "80000000"));
    EXPECT_EQ(next(), "00250000000000");
    answer(value('5', "05000320"));
    EXPECT_EQ(next(), "00260000000000");
    answer(value('6', "01801000"));
    EXPECT_EQ(next(), "00200000000000");
    answer(value('0', "00000000"));
    EXPECT_EQ(driver.link(), Link::up);
}

TEST_F(MidiScriptTest, TheManualsExampleFromASequence) {
    start();
    turn();
    answer(kDone);
    EXPECT_FALSE(driver.error());
}

TEST_F(MidiScriptTest, ANackIsAnsweredByTheSameCommandThreeTimesAtMost) {
    start();
    turn();
    for (int i = 0; i < 2; ++i) {
        answer("\x15");
        EXPECT_EQ(next(), "00150000000320");
    }
    EXPECT_EQ(driver.counters().resent, 2U);
    answer("\x15");
    EXPECT_EQ(driver.link(), Link::down);
    EXPECT_EQ(driver.fault(), MidiFault::link_lost);
    EXPECT_TRUE(driver.error());
}

TEST_F(MidiScriptTest, AMotionOfWhichNobodyKnowsIsNotSentAgainWhenTheShaftTurns) {
    start();
    turn();
    answer("\x1A");  // the rest of the answer was lost
    EXPECT_FALSE(driver.orders_complete());
    EXPECT_EQ(next(), "00210000000000") << "first a query";
    answer(kNoTrip);
    int place = 0;
    for (int i = 0; i < 60; ++i) {
        const std::string text = next();
        ASSERT_EQ(text[2], '2') << text;
        if (text[3] == '0') answer(value('0', "0000100" + std::to_string(place++ % 10)));
        if (text[3] == '1') answer(kNoTrip);
        if (text[3] == '7') answer(value('7', "00000800"));
    }
    EXPECT_TRUE(driver.orders_complete());
    EXPECT_FALSE(driver.error());
}

TEST_F(MidiScriptTest, AndIsSentAgainWhenItStands) {
    start();
    turn();
    answer("\x1A");
    EXPECT_EQ(until_command(), "00150000000320");
    answer("\x1A");
    EXPECT_EQ(until_command(), "00150000000320");
    answer("\x1A");
    EXPECT_EQ(until_command(), "00150000000320");
    answer("\x1A");
    // Not for ever: one error, and a stop.
    EXPECT_EQ(until_command(), "");
    EXPECT_TRUE(driver.error());
    EXPECT_EQ(driver.fault(), MidiFault::unclear);
}

TEST_F(MidiScriptTest, AMoveOfWhichNobodyKnows) {
    start();
    driver.send(longword(registers::P_SOLL, 4'096));
    driver.send(word(registers::MODE_REG, 2));
    EXPECT_EQ(until_command(), "001300000007D0");
    answer("\x06\x13");
    busy = true;  // it was taken
    EXPECT_EQ(until_command(), "");
    EXPECT_FALSE(driver.error());
    EXPECT_FALSE(driver.in_position());
    for (int i = 1; i <= 10; ++i) {
        char digits[9];
        std::snprintf(digits, sizeof digits, "%08X", 200U * static_cast<unsigned>(i));
        position = digits;
        EXPECT_EQ(until_command(4), "");
    }
    busy = false;
    EXPECT_EQ(until_command(), "");
    EXPECT_TRUE(driver.in_position());
    EXPECT_EQ(driver.counters().resent, 0U);
}

TEST_F(MidiScriptTest, ARefusalWithoutATripIsTriedAgainAndThenOneError) {
    start();
    turn();
    int times = 0;
    int stops = 0;
    for (std::string text = "00150000000320"; !text.empty() && times < 200; text = until_command()) {
        const bool is_run = text == "00150000000320";
        EXPECT_TRUE(is_run || text == "00180000000000") << text;
        (is_run ? times : stops) += 1;
        answer(is_run ? "\x06\x13\x17" : kDone);
    }
    EXPECT_TRUE(driver.error());
    EXPECT_EQ(driver.fault(), MidiFault::refused);
    EXPECT_EQ(times, 51);
    EXPECT_GT(stops, 0) << "a motion that nobody knows of is ended";
    EXPECT_EQ(until_command(), "");
}

TEST_F(MidiScriptTest, ARefusedTorqueIsOneErrorAndNotTriedForEver) {
    start();
    driver.send(word(registers::T_SOLL, 512));
    EXPECT_EQ(until_command(), "000C0000000040");
    answer("\x06\x13\x17");
    EXPECT_EQ(until_command(), "");
    EXPECT_EQ(driver.fault(), MidiFault::refused);
    driver.send(fast(kResetError));
    EXPECT_EQ(until_command(), "");
    EXPECT_FALSE(driver.error());
}

TEST_F(MidiScriptTest, AStopThatIsRefusedBecomesAnEmergencyStop) {
    start();
    driver.stop();
    EXPECT_EQ(until_command(), "00170000000000");
    answer("\x06\x13\x17");
    EXPECT_EQ(until_command(), "00180000000000");
    answer(kDone);
    EXPECT_EQ(until_command(), "");
    EXPECT_TRUE(driver.orders_complete());
    EXPECT_FALSE(driver.error());
}

/// 000 §VI 0Dh gives period 0 no speed: a ramp cannot be worked out from it, nor is a move begun with it.
TEST_F(MidiScriptTest, AModuleWithoutASpeedIsAnErrorAtTheMove) {
    speeds = "05000000";
    start();
    driver.send(word(registers::A_SOLL, 160));
    driver.send(longword(registers::P_SOLL, 4'096));
    driver.send(word(registers::MODE_REG, 2));
    EXPECT_EQ(until_command(), "");
    EXPECT_EQ(driver.fault(), MidiFault::bad_value);
    EXPECT_EQ(driver.limitation(), registers::midi::Limitation::no_speed);
    driver.send(fast(kResetError));
    driver.send(word(registers::V_SOLL, 629));
    driver.send(word(registers::MODE_REG, 2));
    EXPECT_EQ(until_command(), "000D0000000320");
}

/// 003 §IV: positions have 31 bits; positions that a module reports beyond them are used all the same.
TEST_F(MidiScriptTest, ThePositionsThatAModuleSaysAreOnlyNumbers) {
    start();
    for (const char* place : {"7FFFFFFF", "80000000", "7FFFFFFF", "3FFFFFFF", "C0000000"}) {
        position = place;
        ASSERT_TRUE(driver.begin_access({.reg = registers::V_IST}));
        EXPECT_EQ(until_command(), "");
        EXPECT_EQ(driver.access_state(), AccessState::done);
    }
}

TEST_F(MidiScriptTest, SilenceInMidRunIsALostLink) {
    start();
    turn();
    answer(kDone);
    const base::Instant begun = now;
    while (driver.link() == Link::up && now < begun + 5s) request();
    EXPECT_EQ(driver.link(), Link::down);
    EXPECT_LT(now - begun, 500ms);
    EXPECT_TRUE(driver.orders_complete());
    EXPECT_FALSE(driver.in_position());
    driver.send(word(registers::V_SOLL, 800));
    EXPECT_EQ(driver.counters().discarded, 1U);
}

TEST_F(MidiScriptTest, TheFirstAfterALossIsTheStop) {
    start();
    turn();
    answer(kDone);
    while (driver.link() == Link::up) request();
    driver.stop();
    EXPECT_EQ(until_command(), "") << "ERROR stands";
    std::string text = next();
    for (int i = 0; i < 10 && text[2] == '2'; ++i) {
        const char digit = text[3];
        answer(value(digit, digit == '8' ? "80000000" : "00000000"));
        text = next();
    }
    EXPECT_EQ(text, "00170000000000");
}

}  // namespace
}  // namespace nplc::motor
