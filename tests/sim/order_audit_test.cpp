#include "order_audit.h"

#include <gtest/gtest.h>

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
    EXPECT_EQ(found.missing, (std::vector<SentOrder>{ordered(kStop)}));
    EXPECT_EQ(found.unordered, (std::vector<SentOrder>{ordered(0x61)}));
}

TEST(OrderAudit, ADoubleExecutionIsStrange) {
    const OrderAudit found = audit({ordered(kGo)}, {executed(kGo), executed(kGo)});
    EXPECT_TRUE(found.missing.empty());
    EXPECT_EQ(found.unordered, (std::vector<SentOrder>{ordered(kGo)}));
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
    EXPECT_EQ(found.missing, (std::vector<SentOrder>{ordered(kGo)}));
    EXPECT_EQ(found.under_way, (std::vector<SentOrder>{ordered(kGo), ordered(kStop)}));
    EXPECT_TRUE(found.unordered.empty());
}

TEST(OrderAudit, WhatTheMotorHasAlreadyIsNotOnItsWay) {
    const OrderAudit found = audit({ordered(kGo), ordered(kStop)}, {executed(kGo)}, {0, 1});
    EXPECT_TRUE(found.missing.empty());
    EXPECT_EQ(found.under_way, (std::vector<SentOrder>{ordered(kStop)}));
}

TEST(OrderAudit, AnotherValueIsAnotherOrder) {
    const OrderAudit found =
        audit({{.is_register_write = true, .reg = 65, .value = 300}}, {executed(65, 301)});
    EXPECT_EQ(found.missing.size(), 1U);
    EXPECT_EQ(found.unordered.size(), 1U);
}

}  // namespace
}  // namespace nplc::sim
