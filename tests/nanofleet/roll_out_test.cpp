// A roll-out without a broker: gateways that obey, fail, are silent, or get an order from another sender.
#include "nanofleet/roll_out.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "nanofleet/fleet.h"
#include "orders/topics.h"

namespace nplc::nanofleet {
namespace {

using orders::State;
using Kind = Outcome::Kind;

/// Broker and gateways: what is published is retained; a gateway takes an order at once, and ends it by
/// turns().
class Plant {
  public:
    explicit Plant(std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            targets.push_back(fmt::format("hall/cell{}/x", i));
            report(targets.back(), {.table_sha256 = "old"});
        }
    }

    void report(const std::string& target, orders::Report report) {
        report.target = target;
        if (report.time == 0) report.time = now;
        reports[target] = report;
        roster.take(orders::report_topic(target), orders::write_report(report));
    }
    RollOut::Publish publish() {
        return [this](const std::string& topic, const std::string& payload) {
            roster.take(topic, payload);
            ++published;
            if (const auto target = orders::target_of(topic, "order")) take(*target, payload);
        };
    }
    void take(const std::string& target, const std::string& text) {
        const auto order = orders::read_order(text).order;
        ASSERT_TRUE(order);
        EXPECT_TRUE(orders::is_signed(order->message, order->signature, orders::public_key_of(seed)));
        orders::Report next = reports[target];
        EXPECT_GT(order->order.counter, next.counter);
        next.counter = order->order.counter;
        next.order_sha256 = orders::hex(orders::sha256(text));
        next.state = State::fetching;
        next.time = now;
        report(target, next);
        under_way.push_back(target);
    }
    /// All that are under way end so.
    void end(State state) {
        for (const std::string& target : under_way) {
            orders::Report next = reports[target];
            next.state = state;
            next.time = now;
            if (state == State::confirmed) next.table_sha256 = orders::hex(orders::sha256(artifact));
            report(target, next);
        }
        under_way.clear();
    }
    RollOut begin() {
        return RollOut(
            {.targets = targets, .artifact = artifact, .name = "new", .key = {.name = "k", .seed = seed}});
    }
    void look(RollOut& roll_out) { roll_out.look(roster, now, publish()); }
    /// To the end, all gateways obeying; how many were under way at once at the most.
    std::vector<std::size_t> finish(RollOut& roll_out) {
        std::vector<std::size_t> stages;
        for (int i = 0; i < 20 && !roll_out.is_over(); ++i) {
            look(roll_out);
            if (!under_way.empty()) stages.push_back(under_way.size());
            end(State::confirmed);
            now += 1'000;
        }
        return stages;
    }

    std::uint64_t now = 1'764'000'000'000;
    std::vector<std::uint8_t> artifact = std::vector<std::uint8_t>(5'000, 7);
    orders::Seed seed{1, 2, 3};
    std::vector<std::string> targets;
    std::map<std::string, orders::Report> reports;
    std::vector<std::string> under_way;
    Roster roster;
    std::size_t published = 0;
};

TEST(RollOutStages, OneThenATenthThenAll) {
    Plant plant(25);
    RollOut roll_out = plant.begin();
    roll_out.publish_pieces(plant.publish());
    EXPECT_EQ(plant.published, 2U);
    EXPECT_EQ(plant.finish(roll_out), (std::vector<std::size_t>{1, 2, 22}));
    EXPECT_TRUE(roll_out.is_over());
    EXPECT_EQ(roll_out.count(Kind::done), 25U);
}

TEST(RollOutStages, TheFirstThatFailsEndsIt) {
    Plant plant(25);
    RollOut roll_out = plant.begin();
    plant.look(roll_out);
    plant.end(State::rolled_back);
    for (int i = 0; i < 5; ++i) plant.look(roll_out);
    EXPECT_TRUE(roll_out.is_over());
    EXPECT_TRUE(roll_out.was_stopped());
    EXPECT_EQ(roll_out.count(Kind::failed), 1U);
    EXPECT_EQ(roll_out.count(Kind::waits), 24U);
    EXPECT_EQ(plant.published, 1U);
}

TEST(RollOutStages, BegunAgainItGoesOnWhereItEnded) {
    Plant plant(25);
    {
        RollOut killed = plant.begin();
        plant.look(killed);
        plant.end(State::confirmed);
        for (int i = 0; i < 3; ++i) plant.look(killed);
        EXPECT_EQ(plant.under_way.size(), 2U);
    }
    RollOut roll_out = plant.begin();
    const std::size_t before = plant.published;
    for (int i = 0; i < 3; ++i) plant.look(roll_out);
    EXPECT_EQ(plant.published, before) << "two are under way, and nobody is ordered twice";
    plant.end(State::confirmed);
    EXPECT_EQ(plant.finish(roll_out), (std::vector<std::size_t>{22}));
    EXPECT_EQ(roll_out.count(Kind::done), 25U);
    EXPECT_EQ(plant.published, 25U);
}

TEST(RollOutStages, WhoFailedBeforeIsOrderedAgainOnlyIfTold) {
    Plant plant(1);
    RollOut first = plant.begin();
    plant.look(first);
    plant.end(State::failed);
    plant.look(first);
    RollOut second = plant.begin();
    plant.look(second);
    EXPECT_EQ(second.count(Kind::failed), 1U);
    EXPECT_EQ(plant.published, 1U);
    RollOut third({.targets = plant.targets,
                   .artifact = plant.artifact,
                   .name = "new",
                   .key = {.name = "k", .seed = plant.seed},
                   .again = true});
    plant.finish(third);
    EXPECT_EQ(third.count(Kind::done), 1U);
    EXPECT_EQ(plant.published, 2U);
}

TEST(RollOutStages, SilentOnesAreLeftOutAndNamed) {
    Plant plant(20);
    orders::Report old{.table_sha256 = "old"};
    old.time = plant.now - 301'000;
    plant.report(plant.targets[0], old);
    plant.targets.push_back("hall/never/x");
    RollOut roll_out = plant.begin();
    EXPECT_EQ(plant.finish(roll_out), (std::vector<std::size_t>{1, 2, 16}));
    EXPECT_TRUE(roll_out.is_over());
    EXPECT_FALSE(roll_out.was_stopped());
    EXPECT_EQ(roll_out.count(Kind::silent), 2U);
    EXPECT_EQ(roll_out.outcomes()[0].text, "it has not reported for 301 s");
    EXPECT_EQ(roll_out.outcomes()[20].text, "it has never reported");
}

TEST(RollOutStages, SomebodyElsesOrderAndPatience) {
    Plant plant(2);
    RollOut roll_out = plant.begin();
    plant.look(roll_out);
    orders::Report other = plant.reports[plant.targets[0]];
    other.counter = 40;
    other.order_sha256 = "other";
    plant.report(plant.targets[0], other);
    plant.look(roll_out);
    EXPECT_EQ(roll_out.outcomes()[0].kind, Kind::failed);
    EXPECT_EQ(roll_out.outcomes()[0].text, "somebody else has given order 40");

    Plant slow(1);
    RollOut waits = slow.begin();
    slow.look(waits);
    slow.now += 600'001;
    slow.look(waits);
    EXPECT_EQ(waits.outcomes()[0].kind, Kind::failed);
    EXPECT_EQ(waits.outcomes()[0].text, "not done within 600 s: fetching");
}

TEST(RollOutStages, WhatRunsAlreadyIsNotOrdered) {
    Plant plant(3);
    for (const std::string& target : plant.targets)
        plant.report(target, {.table_sha256 = orders::hex(orders::sha256(plant.artifact))});
    RollOut roll_out = plant.begin();
    plant.finish(roll_out);
    EXPECT_EQ(roll_out.count(Kind::done), 3U);
    EXPECT_EQ(plant.published, 0U);
}

constexpr const char* kFleet = R"([broker]
address = "[::1]:8883"
ca_file = "ca.pem"

[[group]]
name = "cutters"
table = "cutter.bin"
proof = "/proofs/cutter.proof"
gateways = ["hall2/cell1/x", "hall2/cell2/x"]
)";

TEST(FleetFile, IsReadWithItsFilesBesideIt) {
    const FleetReading reading = read_fleet(kFleet, "plant");
    ASSERT_EQ(reading.error, "");
    EXPECT_EQ(reading.fleet.broker.host, "::1");
    EXPECT_EQ(reading.fleet.broker.port, 8883);
    EXPECT_EQ(reading.fleet.broker.ca_file, "plant/ca.pem");
    const Group* group = reading.fleet.find("cutters");
    ASSERT_NE(group, nullptr);
    EXPECT_EQ(group->table, "plant/cutter.bin");
    EXPECT_EQ(group->proof, "/proofs/cutter.proof");
    EXPECT_EQ(group->gateways.size(), 2U);
    EXPECT_EQ(reading.fleet.find("others"), nullptr);
}

TEST(FleetFile, AMistakeIsNamedWithItsLine) {
    const auto error_of = [](std::string_view from, std::string_view to) {
        std::string text = kFleet;
        text.replace(text.find(from), from.size(), to);
        return read_fleet(text, "").error;
    };
    EXPECT_EQ(error_of("hall2/cell2/x", "hall2/cell1/x"), "9: hall2/cell1/x stands here twice");
    EXPECT_EQ(error_of("hall2/cell2/x", "hall2/x"),
              "9: a gateway is GROUP/NODE/AXIS, such as \"hall2/cell4/x\"");
    EXPECT_EQ(error_of("proof", "prove"), "8: there is no key `prove` here");
    EXPECT_EQ(error_of("table = \"cutter.bin\"\n", ""), "5: `table` is missing here");
    EXPECT_EQ(error_of("[::1]:8883", "broker"),
              "1: `address` is no broker; write HOST:PORT such as \"192.168.10.2:1883\"");
    EXPECT_EQ(error_of("ca_file = \"ca.pem\"", "password_file = \"p\""),
              "1: `password_file` is of no use without `user`");
    EXPECT_EQ(error_of("ca_file = \"ca.pem\"", "certificate_file = \"c.pem\"\nkey_file = \"k.pem\""),
              "1: `certificate_file` is for TLS, which takes a ca_file too");
    EXPECT_EQ(error_of("name = ", "name = = ").substr(0, 2), "6:");
    EXPECT_EQ(read_fleet("", "").error, "1: there must be a table [broker] with its `address`");
}

}  // namespace
}  // namespace nplc::nanofleet
