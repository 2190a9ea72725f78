// A USB adapter between the gateway and its motor: a minute of moves on a late line loses no link, leaves out
// no order and executes none twice.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "order_audit.h"
#include "program.h"
#include "sim/world.h"

namespace nplc::property {
namespace {

using namespace std::chrono_literals;
using sim::Time;

/// What comes from the motor, every character `late` and held back until the next multiple of `together`.
sim::action::SpoilLine line(Time late, Time together = {}) {
    sim::action::SpoilLine line;
    line.to_motor = false;
    line.late = late;
    line.together = together;
    return line;
}

struct Course {
    motor::Counters counters;
    std::uint64_t arrivals = 0;  ///< moves that ended
    Time echo{};
    bool was_in_position_away = false;  ///< a step of waiting was left far from its target
};

Course minute(const sim::action::SpoilLine& spoiled, sim::Polling polling) {
    sim::Program program = sim::load_program(NPLC_LATE_LINE);
    sim::World world(program.table, {.baud = 19'200, .faults = {}, .gateway = {}, .polling = polling});
    EXPECT_TRUE(world.load_result().ok) << world.why_not();
    world.spoil_line(spoiled);
    sim::OrderAuditor auditor(protocol::fastmac::RegisterCode::format_list);
    Course course;
    std::string last;
    while (world.now() < 60s) {
        world.step(std::min<Time>(60s, world.now() + 1ms));
        const auto snapshot = world.take_snapshot();
        for (const sim::SentOrder& order : snapshot.orders) auditor.ordered(order);
        for (const sim::Order& order : world.take_executed()) auditor.executed(order);
        const std::string step = program.names.step(world.gateway().state().step);
        if (step == last) continue;
        last = step;
        if (step != "AtRight" && step != "AtLeft") continue;
        ++course.arrivals;
        const std::int32_t target = step == "AtRight" ? 9'830 : 0;  // 12 mm / 5 mm x 4096
        if (std::abs(snapshot.p_ist - target) > 100) course.was_in_position_away = true;
    }
    const auto result = auditor.finish(world.on_their_way());
    EXPECT_TRUE(result.unordered.empty()) << result.unordered.count << " orders executed and not ordered";
    course.counters = world.driver().counters();
    course.echo = world.driver().echo_time();
    return course;
}

int whole_ms(std::optional<Time> time) {
    return static_cast<int>(time.value_or(Time{}) / 1ms);
}

void expect_no_loss(const sim::action::SpoilLine& spoiled) {
    for (const auto polling : {sim::Polling::steadily, sim::Polling::at_need}) {
        const Course course = minute(spoiled, polling);
        EXPECT_EQ(course.counters.link_losses, 0U);
        EXPECT_EQ(course.counters.discarded, 0U);
        EXPECT_GT(course.arrivals, 100U);
        EXPECT_FALSE(course.was_in_position_away);
        std::printf(
            "%2d ms late, held back up to %2d ms: %u losses, %u moves in a minute, echo time %.1f ms\n",
            whole_ms(spoiled.late), whole_ms(spoiled.together),
            static_cast<unsigned>(course.counters.link_losses), static_cast<unsigned>(course.arrivals),
            static_cast<double>(course.echo / 1us) / 1000);
    }
}

TEST(LateLine, LosesNoLinkAtAConstantDelay) {
    for (const auto late : {0ms, 4ms, 8ms, 10ms, 12ms, 16ms, 20ms, 25ms, 30ms}) {
        SCOPED_TRACE(std::to_string(late.count()) + " ms late");
        expect_no_loss(line(late));
    }
}

TEST(LateLine, LosesNoLinkWhereCharactersComeTogether) {
    for (const auto together : {2ms, 4ms, 8ms, 12ms, 16ms}) {
        SCOPED_TRACE("together every " + std::to_string(together.count()) + " ms");
        expect_no_loss(line({}, together));
    }
}

TEST(LateLine, LosesNoLinkWithBothUpToFortyMilliseconds) {
    for (const auto together : {4ms, 8ms, 16ms, 24ms}) {
        SCOPED_TRACE("together every " + std::to_string(together.count()) + " ms");
        expect_no_loss(line(38ms - together, together));
    }
}

TEST(LateLine, LosesNoLinkAtADelayThatVaries) {
    for (const auto longest : {4ms, 8ms, 10ms, 12ms, 16ms, 30ms}) {
        SCOPED_TRACE("up to " + std::to_string(longest.count()) + " ms");
        sim::action::SpoilLine varies = line({});
        varies.delay = 1.0;
        varies.longest_delay = longest;
        expect_no_loss(varies);
    }
}

TEST(LateLine, IsNotUsedAboveFortyMilliseconds) {
    const Course course = minute(line(50ms), sim::Polling::steadily);
    EXPECT_EQ(course.counters.orders, 0U);
    EXPECT_GT(course.echo, 40ms) << "what the user is told";
}

}  // namespace
}  // namespace nplc::property
