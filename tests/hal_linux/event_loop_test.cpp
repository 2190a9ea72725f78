#include "hal_linux/event_loop.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "hal_linux/byte_server.h"
#include "hal_linux/real_time.h"
#include "hal_linux/steady_clock.h"

namespace nplc::hal_linux {
namespace {

constexpr base::Instant kPast{base::Microseconds(1)};

struct EventLoopTest : testing::Test {
    EventLoopTest() {
        constexpr int kSignals[]{SIGUSR1};
        auto opened = EventLoop::open(kSignals);
        EXPECT_EQ(opened.error, "");
        loop = std::move(opened.loop);
        EXPECT_EQ(::pipe(pipe), 0);
    }
    ~EventLoopTest() override {
        ::close(pipe[0]);
        ::close(pipe[1]);
    }
    std::vector<std::uint32_t> look() {
        const auto marks = loop->wait(kPast);
        return {marks.begin(), marks.end()};
    }

    std::unique_ptr<EventLoop> loop;
    int pipe[2]{};
};

TEST_F(EventLoopTest, ADeadlineEndsTheSleepAndNotBefore) {
    SteadyClock clock;
    const base::Instant deadline = clock.now() + base::Milliseconds(5);
    EXPECT_TRUE(loop->wait(deadline).empty());
    EXPECT_GE(clock.now(), deadline);
    EXPECT_TRUE(look().empty()) << "a deadline that is past only looks";
}

TEST_F(EventLoopTest, WhatIsReadableIsToldUntilItIsRead) {
    ASSERT_TRUE(loop->watch(pipe[0], 7));
    EXPECT_TRUE(look().empty());
    ASSERT_EQ(::write(pipe[1], "x", 1), 1);
    const auto marks = loop->wait(base::kNever);
    EXPECT_EQ(std::vector<std::uint32_t>(marks.begin(), marks.end()), std::vector<std::uint32_t>{7});
    EXPECT_EQ(look(), std::vector<std::uint32_t>{7});
    ASSERT_TRUE(loop->watch(pipe[0], 8)) << "a new mark";
    EXPECT_EQ(look(), std::vector<std::uint32_t>{8});
}

// A pseudo-terminal without a client hangs up all the time; whoever watches it must sleep all the same.
TEST_F(EventLoopTest, AHangUpIsToldOnce) {
    const std::string path = testing::TempDir() + "event_loop_test." + std::to_string(::getpid());
    const auto opened = ByteServer::open("pty:" + path);
    ASSERT_EQ(opened.error, "");
    ASSERT_TRUE(loop->watch(opened.server->descriptor(), 1, EventLoop::Wakes::at_news));
    look();
    EXPECT_TRUE(look().empty());
}

TEST_F(EventLoopTest, ASignalWakesAndKillsNobody) {
    EXPECT_FALSE(loop->signal());
    ASSERT_EQ(::raise(SIGUSR1), 0);
    EXPECT_TRUE(loop->wait(base::kNever).empty());
    EXPECT_EQ(loop->signal(), SIGUSR1);
    EXPECT_FALSE(loop->signal());
}

TEST(RealTime, WhatCannotBeHadIsSaid) {
    EXPECT_TRUE(set_up_real_time({}).empty());
    const auto missed = set_up_real_time({.cpus = {1023}});
    ASSERT_EQ(missed.size(), 1U);
    EXPECT_NE(missed[0].find("not on 1023 alone"), std::string::npos) << missed[0];
}

}  // namespace
}  // namespace nplc::hal_linux
