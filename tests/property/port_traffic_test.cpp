// Random messages on the user's port beside a running sequence: the sequence does what it does without them,
// and the motor executes what was ordered.

#include "port_traffic.h"

#include <gtest/gtest.h>

#include "order_audit.h"

namespace nplc::property {
namespace {

using namespace std::chrono_literals;
using Traffic = PortTraffic::Traffic;

/// A read under way when the order comes, at 19200 baud: 1Fh twice and its echo, a request of 5 bytes, its
/// answer of 13, an echo, 7Eh three times and an echo. An echo is two equal status bytes after the one on the
/// line: 2 + 3 + 5 + 13 + 3 + 3 + 3 = 32 characters of 0.52 ms, and 3 of pause; polls and edges for the rest.
constexpr sim::Time kLongestAccess = 22ms;

void check(std::uint64_t seed, Traffic traffic) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    PortTraffic alone(seed, Traffic::none);
    alone.run();
    PortTraffic beside(seed, traffic);
    beside.run();
    EXPECT_EQ(beside.trace(), alone.trace());
    ASSERT_EQ(beside.ordered().size(), alone.ordered().size());
    for (std::size_t i = 0; i < alone.ordered().size(); ++i) {
        EXPECT_EQ(beside.ordered()[i].order, alone.ordered()[i].order) << i;
        EXPECT_LE(beside.ordered()[i].at - alone.ordered()[i].at, kLongestAccess) << i;
    }
    sim::OrderAuditor auditor(protocol::fastmac::RegisterCode::format_list);
    for (const auto& each : beside.ordered()) auditor.ordered(each.order);
    for (const sim::Order& order : beside.world().mac().orders()) auditor.executed(order);
    const auto result = auditor.finish(beside.world().on_their_way());
    EXPECT_TRUE(result.unordered.empty()) << result.unordered.count << " executed and not ordered";
    EXPECT_TRUE(result.missing.empty()) << result.missing.count << " ordered and not executed";
    const auto with = beside.executed();
    const auto without = alone.executed();
    ASSERT_EQ(with.size(), without.size());
    for (std::size_t i = 0; i < without.size(); ++i) EXPECT_LE(with[i] - without[i], kLongestAccess) << i;
    EXPECT_EQ(beside.world().driver().counters().link_losses, 0U);
    EXPECT_GT(beside.answered(), 1000U) << "the port was hardly asked";
}

TEST(PortTraffic, ReadsLeaveTheSequenceAlone) {
    for (std::uint64_t seed = 1; seed <= NPLC_TRAFFIC_RUNS; ++seed) check(seed, Traffic::reads);
}

TEST(PortTraffic, SoDoesWhateverIsSent) {
    for (std::uint64_t seed = 1; seed <= NPLC_TRAFFIC_RUNS; ++seed) check(seed, Traffic::anything);
}

}  // namespace
}  // namespace nplc::property
