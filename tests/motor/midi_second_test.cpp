// Two drives at one address (000 §IV: addresses are distinct), frame by frame and byte by byte: what the
// driver receives from them, and what it must not take for them.

#include <string>

#include "midi_bench.h"
#include "midi_can_fixture.h"
#include "scripted_line.h"

namespace nplc::motor {
namespace {

/// The driver on CAN; `drives` of them answer each frame, the second one late.
struct TwoOnCan : MidiCanLineTest {
    MidiMotor driver{link, {.model = midi::Model::mac34_1}};
    unsigned drives = 2;
    base::Microseconds late{400};
    std::vector<std::pair<base::Instant, std::string>> coming;
    Frames commands;

    static std::string answer_to(const std::string& frame) {
        const std::string number = frame.substr(7, 2);
        const std::string about = frame.substr(7, 8);
        if (frame.substr(4, 2) == "23") return "585 60 " + about + " 00 00 00 00";
        if (number == "05") return "585 42 " + about + " 05 00 00 A0";
        if (number == "06") return "585 42 " + about + " 10 80 10 00";
        if (number == "07") return "585 42 " + about + " 50 78 00 00";  // busy
        if (number == "08") return "585 42 " + about + " 80 00 00 00";
        return "585 42 " + about + " 00 00 00 00";
    }
    void take_sent() {
        for (const std::string& frame : bus.take()) {
            if (frame.substr(4, 2) == "23") commands.push_back(frame);
            for (unsigned i = 0; i < drives; ++i)
                coming.emplace_back(now + base::Microseconds{500} + i * late, answer_to(frame));
        }
    }
    void pass(base::Microseconds time) {
        for (const base::Instant end = now + time; now < end; now += base::Microseconds{100}) {
            std::erase_if(coming, [&](const auto& one) {
                if (one.first > now) return false;
                hear(one.second);
                return true;
            });
            driver.poll(now);
            take_sent();
        }
    }
    void order_move() {
        driver.send(word(registers::V_SOLL, 1'258));
        driver.send(longword(registers::P_SOLL, 4'096));
        driver.send(word(registers::MODE_REG, 2));
    }
    std::size_t moves() const {
        return static_cast<std::size_t>(std::count_if(
            commands.begin(), commands.end(),
            [](const auto& frame) { return frame.substr(7, 2) == "13" || frame.substr(7, 2) == "15"; }));
    }
};

struct FreshOnCan final : TwoOnCan {
    void TestBody() override {}
};

TEST_F(TwoOnCan, AreRefusedAtTheStart) {
    for (const int microseconds : {0, 400, 3'000, 20'000, 90'000}) {
        SCOPED_TRACE(microseconds);
        FreshOnCan fresh;
        fresh.late = base::Microseconds{microseconds};
        for (int i = 0; i < 60; ++i) {
            fresh.pass(base::Milliseconds{10});
            if (i % 10 == 0) fresh.order_move();
        }
        EXPECT_EQ(fresh.moves(), 0U);
        EXPECT_EQ(fresh.driver.link(), Link::down);
        EXPECT_TRUE(fresh.driver.error());
        EXPECT_EQ(fresh.driver.fault(), MidiFault::several);
    }
}

TEST_F(TwoOnCan, OneThatJoinsLaterStopsBoth) {
    drives = 1;
    pass(base::Milliseconds{500});
    ASSERT_EQ(driver.link(), Link::up);
    order_move();
    pass(base::Milliseconds{100});
    ASSERT_EQ(moves(), 1U);
    EXPECT_FALSE(driver.error());
    drives = 2;
    commands.clear();
    pass(base::Milliseconds{150});
    EXPECT_EQ(driver.fault(), MidiFault::several) << text_of(driver.fault());
    EXPECT_EQ(driver.link(), Link::down);
    ASSERT_FALSE(commands.empty());
    EXPECT_EQ(commands.front(), "605 23 18 20 00 00 00 00 00");
    pass(base::Milliseconds{2'000});
    EXPECT_EQ(driver.link(), Link::down) << "as long as two answer";
    drives = 1;
    pass(base::Milliseconds{1'000});
    EXPECT_EQ(driver.link(), Link::unacknowledged);
    EXPECT_EQ(driver.fault(), MidiFault::several);
    driver.send(fast(kResetError));
    pass(base::Milliseconds{50});
    EXPECT_FALSE(driver.error());
    EXPECT_EQ(moves(), 0U) << "no motion is taken up again";
}

// Each request is answered once, if late: a module that was held up, then answers all that has waited.
TEST_F(TwoOnCan, LateAnswersOfOneAreNoSecond) {
    drives = 1;
    pass(base::Milliseconds{500});
    for (const int held_up : {120, 250, 2'000}) {
        SCOPED_TRACE(held_up);
        const base::Instant until = now + base::Milliseconds{held_up};
        while (now < until) {
            pass(base::Microseconds{100});
            for (auto& one : coming) one.first = until;
        }
        pass(base::Milliseconds{1'000});
        EXPECT_NE(driver.fault(), MidiFault::several);
        EXPECT_NE(driver.link(), Link::down);
        driver.send(fast(kResetError));
        pass(base::Milliseconds{100});
        EXPECT_FALSE(driver.error());
    }
}

TEST_F(TwoOnCan, WhatAnotherMasterIsAnsweredIsNoSecond) {
    drives = 1;
    for (int i = 0; i < 500; ++i) {
        hear("605 40 00 20 00 00 00 00 00");
        hear("585 42 00 20 00 00 00 00 07");
        hear("605 40 04 20 00 00 00 00 00");
        hear("585 42 04 20 00 00 00 07 04");
        pass(base::Milliseconds{1});
    }
    EXPECT_EQ(driver.link(), Link::up);
    EXPECT_FALSE(driver.error());
}

// A node whose frame was disturbed in its last bit sends it again, and the others have it twice.
TEST_F(TwoOnCan, AFrameThatTheBusRepeatsIsNoSecond) {
    drives = 1;
    pass(base::Milliseconds{500});
    for (int i = 0; i < 20; ++i) {
        hear("585 42 01 20 00 00 00 00 00");
        pass(base::Milliseconds{100});
    }
    EXPECT_FALSE(driver.error());
    EXPECT_EQ(driver.link(), Link::up);
}

TEST(OneOnCan, AtAddress1SeesWhatIsAskedOfAll) {
    ScriptedCan bus;
    const MidiCanLink link{bus, {.address = 1}};
    ASSERT_EQ(bus.filters.size(), 3U);
    EXPECT_EQ(bus.filters[2].id, 0x600U);
    EXPECT_EQ(bus.filters[2].mask, 0x7FEU);
}

/// The driver on a serial line; what comes back is the test's.
struct TwoOnALine : testing::Test {
    ScriptedLine line;
    MidiV24Link link{line, {}};
    MidiMotor driver{link, {.model = midi::Model::mac34_1}};
    base::Instant now{1s};
    std::vector<std::pair<base::Instant, std::uint8_t>> coming;
    std::string request;
    std::vector<std::string> commands;
    /// What two drives make of one's answer: each character with its place.
    std::function<std::string(const std::string&)> heard = [](const std::string& one) { return one; };

    static std::string whole(const std::string& fields) {
        unsigned sum = 0;
        for (const char c : fields) sum += static_cast<unsigned char>(c);
        constexpr char kHex[] = "0123456789ABCDEF";
        return "\x02"
               "011" +
               fields + kHex[sum >> 4 & 15] + kHex[sum & 15] + "\x03";
    }
    static std::string answer_to(const std::string& frame) {
        const std::string index = frame.substr(6, 2);
        if (index[0] != '2') return "\x06\x13\x1A";
        std::string data = "00000000";
        if (index == "25") data = "050000A0";
        if (index == "26") data = "10801000";
        if (index == "27") data = "50780000";  // busy
        if (index == "28") data = "80000000";
        return "\x06\x13" + whole("00" + index.substr(1) + data) + "\x1A";
    }
    void pass(base::Microseconds time) {
        constexpr base::Microseconds kCharacter{261};
        for (const base::Instant end = now + time; now < end; now += kCharacter) {
            if (!coming.empty() && coming.front().first <= now) {
                line.received.push_back({coming.front().second, false});
                coming.erase(coming.begin());
            }
            driver.poll(now);
            for (const std::uint8_t byte : line.take()) {
                request += static_cast<char>(byte);
                if (byte != 3) continue;
                if (request.substr(6, 1) != "2") commands.push_back(request.substr(6, 2));
                for (const char c : heard(answer_to(request)))
                    coming.emplace_back(now + 2 * kCharacter, static_cast<std::uint8_t>(c));
                request.clear();
            }
        }
    }
    void expect_refused(MidiFault fault) {
        EXPECT_EQ(driver.fault(), fault) << text_of(driver.fault());
        EXPECT_EQ(driver.link(), Link::down);
        EXPECT_EQ(std::count(commands.begin(), commands.end(), "15"), 0);
        EXPECT_EQ(std::count(commands.begin(), commands.end(), "13"), 0);
    }
    void run() {
        driver.send(word(registers::V_SOLL, 1'258));
        driver.send(word(registers::MODE_REG, 1));
    }
};

std::string twice(const std::string& answer) {
    return answer + answer;
}
std::string mixed(const std::string& answer) {
    std::string both;
    for (const char c : answer) both += std::string(2, c);
    return both;
}
/// On the wires a 0 wins over a 1; the second one begins two characters later.
std::string together(const std::string& answer) {
    std::string both = answer + std::string(2, '\xFF');
    for (std::size_t i = 0; i < answer.size(); ++i) both[i + 2] = static_cast<char>(both[i + 2] & answer[i]);
    return both;
}

struct FreshOnALine final : TwoOnALine {
    void TestBody() override {}
};

TEST_F(TwoOnALine, AreRefusedAtTheStart) {
    for (const auto both : {&twice, &mixed}) {
        FreshOnALine fresh;
        fresh.heard = both;
        for (int i = 0; i < 10; ++i) {
            fresh.pass(base::Milliseconds{100});
            fresh.run();
        }
        fresh.expect_refused(MidiFault::several);
    }
}

TEST_F(TwoOnALine, OneThatJoinsLaterStopsBoth) {
    for (const auto& [both, fault] :
         {std::pair{&twice, MidiFault::several}, std::pair{&mixed, MidiFault::several},
          std::pair{&together, MidiFault::unreadable}}) {
        FreshOnALine fresh;
        fresh.pass(base::Milliseconds{500});
        ASSERT_EQ(fresh.driver.link(), Link::up);
        fresh.run();
        fresh.pass(base::Milliseconds{300});
        ASSERT_EQ(fresh.commands.back(), "15");
        fresh.commands.clear();
        fresh.heard = both;
        fresh.pass(base::Milliseconds{600});
        fresh.expect_refused(fault);
        ASSERT_FALSE(fresh.commands.empty());
        EXPECT_EQ(fresh.commands.front(), "18");
    }
}

}  // namespace
}  // namespace nplc::motor
