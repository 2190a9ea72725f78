#include "order_audit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace nplc::sim {
namespace {

constexpr std::uint8_t kStop = 0x65, kGo = 0x41, kNop = 0x60, kUseFlexMac = 0x7F;

Order executed(std::uint8_t command) {
    Order order;
    order.command = command;
    return order;
}

Order executed(std::uint8_t reg, std::uint32_t value) {
    Order order;
    order.flexmac = true;
    order.reg = reg;
    order.message.value = value;
    return order;
}

SentOrder ordered(std::uint8_t command) {
    return {.command = command};
}

OrderAudit audit(const std::vector<SentOrder>& wanted, const std::vector<Order>& done,
                 const OrderAuditor::OnTheirWay& on_their_way = {},
                 protocol::fastmac::RegisterCode code = protocol::fastmac::RegisterCode::format_list) {
    OrderAuditor auditor(code);
    for (const SentOrder& order : wanted) auditor.ordered(order);
    for (const Order& order : done) auditor.executed(order);
    return auditor.finish(on_their_way);
}

TEST(OrderAudit, EqualListsShowNothing) {
    const OrderAudit found = audit({ordered(kGo), {.is_register_write = true, .reg = 65, .value = 300}},
                                   {executed(kGo), executed(65, 300)});
    EXPECT_TRUE(found.missing.empty());
    EXPECT_TRUE(found.unordered.empty());
}

TEST(OrderAudit, WhatConcernsTheLinkIsLeftOut) {
    const OrderAudit found =
        audit({ordered(kNop)}, {executed(kNop), executed(kNop), executed(kUseFlexMac), executed(2, 0)});
    EXPECT_TRUE(found.missing.empty());
    EXPECT_TRUE(found.unordered.empty());
}

TEST(OrderAudit, OneLostAndOneStrangeAreFound) {
    const OrderAudit found =
        audit({ordered(kGo), ordered(kStop), ordered(kGo)}, {executed(kGo), executed(0x61), executed(kGo)});
    EXPECT_EQ(found.missing.first, (std::vector<SentOrder>{ordered(kStop)}));
    EXPECT_EQ(found.unordered.first, (std::vector<SentOrder>{ordered(0x61)}));
}

TEST(OrderAudit, ADoubleExecutionIsStrange) {
    const OrderAudit found = audit({ordered(kGo)}, {executed(kGo), executed(kGo)});
    EXPECT_TRUE(found.missing.empty());
    EXPECT_EQ(found.unordered.first, (std::vector<SentOrder>{ordered(kGo)}));
}

// P2 in position mode: 10 00001 by the format list; P is 11xxx in the example's older code, so 10 11001.
TEST(OrderAudit, TheOlderCodeIsTheSameOrder) {
    const auto older = protocol::fastmac::RegisterCode::older_example;
    EXPECT_TRUE(audit({ordered(0x41)}, {executed(0x59)}, {}, older).missing.empty());
    EXPECT_FALSE(audit({ordered(0x41)}, {executed(0x41)}, {}, older).missing.empty());
}

// The first go was lost, the second one and what follows it have not been sent yet.
TEST(OrderAudit, WhatIsOnItsWayIsNotMissing) {
    const OrderAudit found =
        audit({ordered(kGo), ordered(kStop), ordered(kGo), ordered(kNop), ordered(kStop)}, {executed(kStop)},
              {2, 3, 4});
    EXPECT_EQ(found.missing.first, (std::vector<SentOrder>{ordered(kGo)}));
    EXPECT_EQ(found.under_way.first, (std::vector<SentOrder>{ordered(kGo), ordered(kStop)}));
    EXPECT_TRUE(found.unordered.empty());
}

TEST(OrderAudit, WhatTheMotorHasAlreadyIsNotOnItsWay) {
    const OrderAudit found = audit({ordered(kGo), ordered(kStop)}, {executed(kGo)}, {0, 1});
    EXPECT_TRUE(found.missing.empty());
    EXPECT_EQ(found.under_way.first, (std::vector<SentOrder>{ordered(kStop)}));
}

TEST(OrderAudit, AnotherValueIsAnotherOrder) {
    const OrderAudit found =
        audit({{.is_register_write = true, .reg = 65, .value = 300}}, {executed(65, 301)});
    EXPECT_EQ(found.missing.count, 1U);
    EXPECT_EQ(found.unordered.count, 1U);
}

/// Directly by the definition, at a cost of the product of both lengths.
std::size_t longest_common(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (const std::uint8_t x : a) {
        std::size_t diagonal = 0;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t above = row[j + 1];
            row[j + 1] = x == b[j] ? diagonal + 1 : std::max(above, row[j]);
            diagonal = above;
        }
    }
    return row.back();
}

/// Of every so many orders one is lost, one changed and one executed twice; up to 30 are on their way.
TEST(OrderAudit, ALongDisturbedRunIsJudgedAsIfAllWereCompared) {
    std::mt19937 dice(7);
    for (const unsigned rarely : {20U, 200U, 1000U}) {
        OrderAuditor auditor(protocol::fastmac::RegisterCode::format_list);
        std::vector<std::uint8_t> wanted;
        std::vector<std::uint8_t> done;
        OrderAuditor::OnTheirWay on_their_way;
        const auto execute = [&](std::uint8_t command) {
            done.push_back(command);
            auditor.executed(executed(command));
        };
        for (std::size_t number = 0; number < 6000; ++number) {
            wanted.push_back(static_cast<std::uint8_t>(0x40 + dice() % 30));
            auditor.ordered(ordered(wanted.back()));
            on_their_way.push_back(number);
            while (on_their_way.size() > dice() % 30) {
                const std::uint8_t command = wanted[on_their_way.front()];
                on_their_way.pop_front();
                const bool is_lost = dice() % rarely == 0;
                if (!is_lost) execute(dice() % rarely == 0 ? std::uint8_t{0x61} : command);
                if (dice() % rarely == 0) execute(command);
            }
            auditor.settle(on_their_way);
        }
        const OrderAudit found = auditor.finish(on_their_way);
        const std::size_t common = longest_common(wanted, done);
        EXPECT_EQ(found.missing.count + found.under_way.count, wanted.size() - common) << rarely;
        EXPECT_EQ(found.unordered.count, done.size() - common) << rarely;
        EXPECT_GT(found.missing.count, 0U);
        EXPECT_LE(found.missing.first.size(), OrderList::kKept);
    }
}

TEST(OrderAudit, AnythingThatGoesOnForMillionsOfOrdersIsCounted) {
    constexpr std::size_t kMany = 2'000'000;
    OrderAuditor never_executed(protocol::fastmac::RegisterCode::format_list);
    OrderAuditor never_ordered(protocol::fastmac::RegisterCode::format_list);
    OrderAuditor clean(protocol::fastmac::RegisterCode::format_list);
    for (std::size_t i = 0; i < kMany; ++i) {
        never_executed.ordered(ordered(kGo));
        never_executed.settle({});
        clean.ordered(ordered(kGo));
        clean.executed(executed(kGo));
        clean.settle({});
    }
    constexpr std::size_t kFewer = 100'000;
    for (std::size_t i = 0; i < kFewer; ++i) {
        never_ordered.ordered(ordered(kStop));
        never_ordered.executed(executed(kGo));
        never_ordered.settle({i});
    }
    EXPECT_EQ(never_executed.finish({}).missing.count, kMany);
    EXPECT_EQ(never_ordered.finish({}).unordered.count, kFewer);
    EXPECT_TRUE(clean.finish({}).missing.empty());
}

}  // namespace
}  // namespace nplc::sim
