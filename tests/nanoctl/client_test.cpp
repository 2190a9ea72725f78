// The client on the firmware's own user port, in virtual time.

#include <gtest/gtest.h>

#include <iostream>

#include "base/crc32.h"
#include "gateway_unit.h"
#include "nanoctl/forces.h"
#include "nanoctl/reconnecting.h"
#include "nanoctl/status.h"
#include "nanoctl/stopping.h"
#include "nanoctl/texts.h"
#include "nanoctl/transfer.h"
#include "store/settings.h"
#include "store_bench.h"

namespace nplc::nanoctl {
namespace {

using gw::Command;
using mactalk_client::LineError;
using mactalk_client::Master;
using mactalk_client::SimWire;

const Progress kQuiet = [](std::size_t, std::size_t) {};

struct Bench {
    explicit Bench(std::uint64_t seed = 1, unsigned busy_polls = 1)
        : unit(busy_polls),
          wire(unit, 19'200, seed),
          master(wire, {.attempts = 10}),
          gateway(master, gw::kDefaultAddress) {}

    template <class Call>
    gw::Result refusal(Call call) {
        try {
            call();
        } catch (const Refused& refused) {
            return refused.result();
        }
        return gw::Result::done;
    }
    Status status() { return Status(gateway.read_block(gw::STATUS)); }
    void run_a_table() {
        upload(gateway, store::table_of(20, 1), kQuiet);
        gateway.activate();
        gateway.command(Command::run);
        master.pause(std::chrono::milliseconds{50});
    }
    base::Microseconds time_of_stop(Command command) {
        const base::Instant begun = wire.now();
        stop_machine(gateway, command);
        return wire.now() - begun;
    }

    GatewayUnit unit;
    SimWire wire;
    Master master;
    GatewayClient gateway;
};

std::vector<std::uint8_t> table(std::size_t terms, std::uint8_t seed = 1) {
    return store::table_of(terms, seed);
}

TEST(Client, KnowsAGatewayFromAMotor) {
    Bench bench;
    bench.gateway.identify();
    GatewayClient motor(bench.master, 254);
    EXPECT_THROW(motor.identify(), WrongDevice);
}

TEST(Client, UploadsActivatesAndReadsBack) {
    Bench bench;
    const auto sent = table(100);
    std::size_t last = 0;
    upload(bench.gateway, sent, [&](std::size_t done, std::size_t all) {
        EXPECT_GE(done, last);
        EXPECT_EQ(all, sent.size());
        last = done;
    });
    EXPECT_EQ(last, sent.size());
    EXPECT_EQ(bench.gateway.read(gw::STORED_CRC), base::crc32(sent));
    EXPECT_EQ(bench.gateway.read(gw::TABLE_BYTES), 0U) << "stored is not active";
    EXPECT_EQ(download(bench.gateway, kQuiet), std::vector<std::uint8_t>());
    bench.gateway.activate();
    EXPECT_EQ(download(bench.gateway, kQuiet), sent);
    bench.unit.start();
    EXPECT_EQ(download(bench.gateway, kQuiet), sent) << "after a power-up";
}

TEST(Client, TellsWhatTheGatewayRefusesAndWhy) {
    Bench bench;
    EXPECT_EQ(bench.refusal([&] { bench.gateway.command(Command::run); }), gw::Result::no_table);
    EXPECT_EQ(bench.refusal([&] { bench.gateway.command(Command::hold); }), gw::Result::not_running);
    EXPECT_EQ(bench.refusal([&] { bench.gateway.activate(); }), gw::Result::nothing_stored);
    EXPECT_EQ(bench.refusal([&] { bench.gateway.write(gw::UPTIME, 1); }), gw::Result::read_only);
    EXPECT_EQ(bench.refusal([&] { bench.gateway.write(gw::BREAK_HIGH, 1U << 31); }), gw::Result::bad_value);
    EXPECT_EQ(bench.refusal([&] { upload(bench.gateway, std::vector<std::uint8_t>(9000), kQuiet); }),
              gw::Result::no_space);
    auto wrong = table(50);
    wrong[8 * 7 + 3] = 0x3F;
    try {
        upload(bench.gateway, wrong, kQuiet);
        FAIL();
    } catch (const Refused& refused) {
        EXPECT_EQ(refused.result(), gw::Result::bad_next_step);
        EXPECT_EQ(refused.detail(), 7);
        EXPECT_NE(std::string(refused.what()).find("(term 7)"), std::string::npos) << refused.what();
    }
    upload(bench.gateway, table(20), kQuiet);
    bench.unit.board.motor_registers[12] = 100;
    EXPECT_EQ(bench.refusal([&] { bench.gateway.activate(); }), gw::Result::moving);
}

TEST(Client, RunsHoldsBreaksAndForces) {
    Bench bench;
    // Step 0: IN0 -> step 1 with OUT0; step 1: IN0 off -> step 0 without.
    const std::vector<std::uint8_t> two{0xC0, 0x01, 0x01, 1, 0x80, 0x01, 0, 0, 0xC1, 0x00, 0x01, 0,
                                        0x80, 0x00, 0,    0, 0x3F, 0,    0, 0, 0,    0,    0,    0};
    upload(bench.gateway, two, kQuiet);
    bench.gateway.activate();
    bench.gateway.command(Command::run);
    bench.master.pause(std::chrono::milliseconds{50});
    EXPECT_EQ(bench.status().run_state, gw::RunState::running);
    bench.gateway.write(gw::BREAK_LOW, 1U << 1);
    bench.gateway.write(gw::FORCE_IN, 0x0101);
    bench.master.pause(std::chrono::milliseconds{50});
    const Status held = bench.status();
    EXPECT_EQ(held.run_state, gw::RunState::held);
    EXPECT_TRUE(held.has(gw::kAtBreakpoint));
    EXPECT_TRUE(held.has(gw::kForcedInputs));
    EXPECT_EQ(held.step, 1);
    EXPECT_EQ(held.outputs, 1);
    EXPECT_EQ(held.inputs & 1, 1);
    EXPECT_EQ(held.terminals & 1, 0);
    const Fired fired = read_fired(bench.gateway);
    EXPECT_EQ(fired.step, 0);
    EXPECT_EQ(fired.terms, std::vector<std::uint16_t>{0});
    bench.master.pause(std::chrono::seconds{6});
    EXPECT_FALSE(bench.status().has(gw::kForcedInputs)) << "after 5 s of silence";
    bool seen = false;
    for (const LogEntry& entry : read_log(bench.gateway))
        seen = seen || entry.event == static_cast<int>(gw::Event::breakpoint);
    EXPECT_TRUE(seen);
}

TEST(Client, AStopIsSentBeforeAnythingIsAsked) {
    for (const Command command : {Command::stop, Command::safe, Command::hold}) {
        Bench bench;
        bench.run_a_table();
        const std::size_t before = bench.wire.sent().size();
        const Status status = stop_machine(bench.gateway, command);
        EXPECT_EQ(status.run_state, command == Command::hold ? gw::RunState::held : gw::RunState::stopped);
        const auto code = static_cast<std::uint8_t>(command);
        const std::vector<std::uint8_t> begin{0x52, 0x52, 0x52, 128, 127, 48, 207, 4, 251, code};
        EXPECT_TRUE(
            std::equal(begin.begin(), begin.end(), bench.wire.sent().begin() + static_cast<long>(before)));
    }
}

TEST(Client, AStopIsRepeatedOnABadLineUntilItIsConfirmed) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Bench bench(seed);
        bench.run_a_table();
        bench.wire.set_faults({.drop = 0.002, .damage = 0.002, .framing = 0.002});
        bench.unit.board.stop_takes = std::chrono::milliseconds{200};
        const auto command = seed % 2 == 0 ? Command::stop : Command::hold;
        EXPECT_LT(bench.time_of_stop(command), std::chrono::seconds{5}) << "seed " << seed;
    }
}

TEST(Client, AStopThatIsNotConfirmedSaysThatTheMachineMayStillBeRunning) {
    Bench bench;
    bench.run_a_table();
    bench.wire.from_unit().cut();
    try {
        stop_machine(bench.gateway, Command::stop);
        FAIL();
    } catch (const NotConfirmed& error) {
        EXPECT_NE(std::string(error.what()).find("THE MACHINE MAY STILL BE RUNNING"), std::string::npos);
    }
    bench.wire.from_unit().restore();
    EXPECT_EQ(bench.status().run_state, gw::RunState::stopped) << "it was carried out all the same";
    bench.gateway.command(Command::run);
    bench.wire.to_unit().cut();
    bench.gateway.set_goes_on([] { return false; });
    try {
        stop_machine(bench.gateway, Command::stop);
        FAIL();
    } catch (const Interrupted& error) {
        EXPECT_NE(std::string(error.what()).find("THE MACHINE MAY STILL BE RUNNING"), std::string::npos);
    }
}

// The sequence does not run, and writes of a client have set the motor in motion.
TEST(Client, AStopOfAStoppedSequenceIsSentUntilItHasArrived) {
    for (const Command command : {Command::stop, Command::safe}) {
        Bench bench;
        bench.run_a_table();
        stop_machine(bench.gateway, Command::stop);
        const int before = bench.unit.board.stops;
        bench.unit.ignores = 10;
        EXPECT_EQ(stop_machine(bench.gateway, command).run_state, gw::RunState::stopped);
        EXPECT_GT(bench.unit.board.stops, before);
    }
}

TEST(Client, AHoldBehindAnUnconfirmedStopSaysThatTheMachineMayStillBeRunning) {
    Bench bench;
    bench.run_a_table();
    bench.unit.board.stop_takes = std::chrono::seconds{60};
    EXPECT_THROW(stop_machine(bench.gateway, Command::stop), NotConfirmed);
    EXPECT_THROW(stop_machine(bench.gateway, Command::hold), NotConfirmed);
}

// As a step, a scan or a breakpoint leaves it.
TEST(Client, AHeldSequenceWhoseMotorHasNotConfirmedItsStopIsInDoubt) {
    for (const motor::Link link : {motor::Link::up, motor::Link::down}) {
        Bench bench;
        bench.run_a_table();
        bench.unit.board.link_state = link;
        bench.unit.board.stop_is_confirmed = false;
        bench.gateway.command(Command::hold);
        while (bench.status().run_state != gw::RunState::held)
            bench.master.pause(std::chrono::milliseconds{20});
        EXPECT_NE(doubt_of_stop(bench.gateway).find(kMayStillRun), std::string::npos);
        bench.unit.board.stop_is_confirmed = true;
        EXPECT_EQ(doubt_of_stop(bench.gateway), "");
    }
}

TEST(Client, AMotorThatCannotBeToldIsNotTakenForStopped) {
    Bench bench;
    bench.run_a_table();
    bench.unit.board.link_state = motor::Link::down;
    bench.unit.board.stop_is_confirmed = false;
    EXPECT_THROW(stop_machine(bench.gateway, Command::stop), NotConfirmed);
    bench.unit.board.stop_is_confirmed = true;
    bench.unit.board.link_state = motor::Link::up;
    EXPECT_EQ(stop_machine(bench.gateway, Command::stop).run_state, gw::RunState::stopped);
    EXPECT_EQ(bench.refusal([&] { stop_machine(bench.gateway, Command::hold); }), gw::Result::not_running);
}

TEST(Client, AStopConfirmedWhileTheLinkIsDownIsDone) {
    Bench bench;
    bench.run_a_table();
    bench.unit.board.link_state = motor::Link::down;
    bench.unit.board.stop_takes = std::chrono::milliseconds{300};
    EXPECT_EQ(stop_machine(bench.gateway, Command::stop).run_state, gw::RunState::stopped);
}

/// A connection on the wire that the other end closes after some writes.
class Connection final : public host::ByteClient {
  public:
    Connection(SimWire& wire, int writes) : wire_(wire), writes_(writes) {}
    const std::string& name() const override { return wire_.name(); }
    bool write(std::span<const std::uint8_t> bytes) override { return writes_-- > 0 && wire_.write(bytes); }
    std::optional<std::size_t> read(std::span<std::uint8_t> out, base::Microseconds wait) override {
        if (writes_ <= 0) return std::nullopt;
        return wire_.read(out, wait);
    }
    base::Instant now() const override { return wire_.now(); }

  private:
    SimWire& wire_;
    int writes_;
};

struct ConnectedAgain : Bench {
    /// `lives`: writes that each connection takes; then there is none to be had.
    explicit ConnectedAgain(std::vector<int> lives)
        : again(
              std::make_unique<Connection>(wire, lives.front()),
              [this, lives, next = std::size_t{1}]() mutable {
                  host::ByteClient::Opened opened;
                  if (next < lives.size()) opened.client = std::make_unique<Connection>(wire, lives[next++]);
                  return opened;
              },
              [this](base::Microseconds time) {
                  std::array<std::uint8_t, 64> lost{};
                  const base::Instant end = wire.now() + time;
                  while (wire.now() < end) static_cast<void>(wire.read(lost, end - wire.now()));
              },
              kLongestStop) {}

    Reconnecting again;
    Master client{again, {.attempts = 10}};
    GatewayClient stopper{client, gw::kDefaultAddress};
};

TEST(Client, AStopIsSentAgainOnAnotherConnectionWhenItsOwnWasClosed) {
    for (const std::vector<int>& lives :
         {std::vector<int>{0, 0, 0, 100}, {1, 1, 100}, {2, 100}, {0, 1, 2, 100}}) {
        ConnectedAgain bench(lives);
        bench.run_a_table();
        EXPECT_EQ(stop_machine(bench.stopper, Command::stop).run_state, gw::RunState::stopped);
    }
}

TEST(Client, WhoseConnectionsAreAllClosedIsToldAfterTenSeconds) {
    ConnectedAgain bench({0, 0, 1});
    const base::Instant begun = bench.wire.now();
    EXPECT_THROW(stop_machine(bench.stopper, Command::stop), NotConfirmed);
    EXPECT_GE(bench.wire.now() - begun, std::chrono::seconds{9});
    EXPECT_LE(bench.wire.now() - begun, std::chrono::seconds{11});
}

/// A wire whose far end stops to answer, or on which others are heard.
class DisturbedWire final : public host::ByteClient {
  public:
    explicit DisturbedWire(SimWire& wire) : wire_(wire) {}
    const std::string& name() const override { return wire_.name(); }
    bool write(std::span<const std::uint8_t> bytes) override { return swallows(bytes) || wire_.write(bytes); }
    std::optional<std::size_t> read(std::span<std::uint8_t> out, base::Microseconds wait) override {
        const auto count = wire_.read(out, others_talk ? std::chrono::milliseconds{1} : wait);
        if (!others_talk || count != std::size_t{0} || out.empty()) return count;
        out.front() = 0x11;  // of an accept
        return 1;
    }
    base::Instant now() const override { return wire_.now(); }

    std::function<bool(std::span<const std::uint8_t>)> swallows = [](auto) { return false; };
    bool others_talk = false;

  private:
    SimWire& wire_;
};

struct Disturbed : testing::Test {
    /// The time until it reports that the stop is not confirmed.
    base::Microseconds time_until_told() {
        const base::Instant begun = bench.wire.now();
        EXPECT_THROW(stop_machine(stopper, Command::stop), NotConfirmed);
        return bench.wire.now() - begun;
    }

    Bench bench;
    DisturbedWire wire{bench.wire};
    Master client{wire, {.patience = std::chrono::milliseconds{500}, .attempts = 10}};
    GatewayClient stopper{client, gw::kDefaultAddress};
};

TEST_F(Disturbed, AMotorThatDoesNotConfirmIsToldThoughNoMoreAnswersCome) {
    bench.run_a_table();
    bench.unit.board.stop_is_confirmed = false;
    int looks = 0;
    stopper.set_goes_on([&] {
        if (++looks == 3) bench.wire.from_unit().cut();
        return true;
    });
    EXPECT_LT(time_until_told(), std::chrono::milliseconds{2'000}) << "1 s for the motor, and 1 s";
}

// 50h: register 1, IDENTITY, is read last.
TEST_F(Disturbed, AStopThatIsDoneDoesNotWaitLongForTheGatewaysName) {
    bench.run_a_table();
    wire.swallows = [](std::span<const std::uint8_t> bytes) {
        return bytes[0] == 0x50 && bytes[3] == 128 && bytes[5] == gw::IDENTITY;
    };
    EXPECT_LT(time_until_told(), std::chrono::milliseconds{1'500});
}

TEST_F(Disturbed, WhereOthersTalkWithoutAPauseItEndsAtItsDeadline) {
    bench.run_a_table();
    stop_machine(bench.gateway, Command::stop);
    bench.wire.from_unit().cut();
    wire.others_talk = true;
    const base::Microseconds time = time_until_told();
    EXPECT_GE(time, kLongestStop);
    EXPECT_LT(time, kLongestStop + std::chrono::seconds{1});
}

// Longer than the look at STATUS takes: what is asked again and again would never be confirmed.
TEST(Client, TheMotorsConfirmationIsWaitedForAndAskedForOnce) {
    Bench bench;
    bench.run_a_table();
    bench.unit.board.stop_takes = std::chrono::milliseconds{300};
    const int stops = bench.unit.board.stops;
    const base::Microseconds time = bench.time_of_stop(Command::stop);
    EXPECT_GE(time, std::chrono::milliseconds{300});
    EXPECT_LT(time, std::chrono::milliseconds{1000}) << "virtual time, with the looks at 19200 baud";
    EXPECT_EQ(bench.unit.board.stops, stops + 1);
    bench.unit.board.stop_is_confirmed = false;
    EXPECT_THROW(stop_machine(bench.gateway, Command::stop), NotConfirmed);
    EXPECT_EQ(bench.refusal([&] { bench.gateway.command(Command::run); }), gw::Result::stop_unconfirmed);
    bench.gateway.command(Command::give_up_stop);
    bench.gateway.command(Command::run);
}

TEST(Client, ARunWaitsASecondForTheMotorToConfirmTheStopBefore) {
    Bench bench;
    bench.run_a_table();
    bench.unit.board.stop_takes = std::chrono::milliseconds{600};
    bench.gateway.command(Command::stop);
    EXPECT_TRUE(bench.status().has(gw::kStopUnconfirmed));
    bench.gateway.command(Command::run);
    EXPECT_EQ(bench.status().run_state, gw::RunState::running);
    bench.unit.board.stop_is_confirmed = false;
    bench.gateway.command(Command::stop);
    const base::Instant begun = bench.wire.now();
    EXPECT_EQ(bench.refusal([&] { bench.gateway.command(Command::run); }), gw::Result::stop_unconfirmed);
    EXPECT_GE(bench.wire.now() - begun, GatewayClient::kConfirmationWait);
}

TEST(Client, AStopOnItsWayIsNoAlarmAndOneThatIsNotConfirmedIs) {
    Bench bench;
    bench.run_a_table();
    bench.unit.board.stop_takes = std::chrono::milliseconds{600};
    bench.gateway.command(Command::stop);
    StopConfirmation confirmation;
    const Status on_its_way = bench.status();
    EXPECT_TRUE(on_its_way.has(gw::kStopUnconfirmed));
    EXPECT_FALSE(confirmation.is_overdue(on_its_way));
    EXPECT_FALSE(status_after_stop(bench.gateway).has(gw::kStopUnconfirmed)) << "it is waited for";
    EXPECT_FALSE(confirmation.is_overdue(bench.status()));

    bench.unit.board.stop_is_confirmed = false;
    bench.gateway.command(Command::stop);
    EXPECT_FALSE(confirmation.is_overdue(bench.status())) << "another stop, another second";
    EXPECT_TRUE(status_after_stop(bench.gateway).has(gw::kStopUnconfirmed));
    EXPECT_TRUE(confirmation.is_overdue(bench.status()));

    bench.unit.board.link_state = motor::Link::down;
    EXPECT_TRUE(StopConfirmation{}.is_overdue(bench.status())) << "the motor could not be told";
}

TEST(Client, AStopThatIsNotConfirmedSaysForHowLong) {
    Bench bench;
    bench.run_a_table();
    bench.unit.board.stop_takes = std::chrono::milliseconds{100};
    stop_machine(bench.gateway, Command::stop);
    EXPECT_EQ(stop_unconfirmed_ms(bench.gateway, bench.status()), 0U);
    bench.gateway.command(Command::run);
    bench.unit.board.stop_is_confirmed = false;
    bench.gateway.command(Command::stop);
    bench.master.pause(std::chrono::milliseconds{12'000});
    const std::uint32_t time = stop_unconfirmed_ms(bench.gateway, bench.status());
    EXPECT_GE(time, 12'000U);
    EXPECT_LT(time, 12'500U) << "virtual time, with the messages at 19200 baud";
    EXPECT_NE(unconfirmed_text(12'345).find("STOP NOT CONFIRMED by the motor for 12.3 s: it may be moving"),
              std::string::npos);
    EXPECT_NE(unconfirmed_text(0).find("by the motor: it may be moving"), std::string::npos);
    bench.gateway.command(Command::give_up_stop);
    EXPECT_EQ(stop_unconfirmed_ms(bench.gateway, bench.status()), 0U);
}

TEST(Client, AHoldThatDroppedOrdersSaysThatItCannotGoOnAndWhy) {
    Bench bench;
    bench.run_a_table();
    EXPECT_EQ(stop_remark(stop_machine(bench.gateway, Command::hold)), "");
    bench.gateway.command(Command::run);
    bench.unit.board.is_settled = false;
    const Status held = [&] {
        bench.gateway.command(Command::hold);
        bench.master.pause(std::chrono::milliseconds{600});
        bench.unit.board.is_settled = true;
        return stop_machine(bench.gateway, Command::hold);
    }();
    EXPECT_EQ(held.run_state, gw::RunState::held);
    const std::string remark = stop_remark(held);
    EXPECT_NE(remark.find("cannot go on from here"), std::string::npos) << remark;
    EXPECT_NE(remark.find("orders that waited for it for longer than 500 ms were dropped"), std::string::npos)
        << remark;
    try {
        bench.gateway.command(Command::run);
        FAIL();
    } catch (const Refused& refused) {
        EXPECT_EQ(refused.result(), gw::Result::cannot_go_on);
        EXPECT_NE(std::string(refused.what()).find("dropped orders"), std::string::npos) << refused.what();
    }
}

TEST(Client, KeptForcesThatAreEndedElsewhereAreNotRenewed) {
    Bench bench;
    bench.run_a_table();
    const Forces kept{.in = 0x0101, .out = 0};
    const auto force = [&] {
        bench.gateway.write(gw::FORCE_IN, 0x0301);
        EXPECT_EQ(renew_forces(bench.gateway, kept), std::nullopt) << "more may be forced";
        bench.master.pause(std::chrono::milliseconds{4'000});
        EXPECT_EQ(renew_forces(bench.gateway, kept), std::nullopt);
        bench.master.pause(std::chrono::milliseconds{4'000});
        EXPECT_EQ(renew_forces(bench.gateway, kept), std::nullopt) << "renewed: it lasts 5 s";
    };
    force();
    bench.gateway.write(gw::FORCE_IN, 0);
    EXPECT_EQ(renew_forces(bench.gateway, kept).value_or(""), "the forces were ended elsewhere");
    force();
    stop_machine(bench.gateway, Command::safe);
    EXPECT_EQ(renew_forces(bench.gateway, kept).value_or(""), "the forces were ended by a safe command");
    force();
    bench.gateway.write(gw::FORCE_IN, 0x0300);
    EXPECT_EQ(renew_forces(bench.gateway, kept).value_or(""), "the forces were changed elsewhere");
    force();
    bench.master.pause(std::chrono::milliseconds{6'000});
    EXPECT_EQ(renew_forces(bench.gateway, kept).value_or(""),
              "the forces were ended by the gateway: they were not renewed in time");
}

TEST(Client, AStopWithAVirtualMotorTellsNoMotor) {
    Bench bench;
    bench.run_a_table();
    EXPECT_EQ(stop_remark(stop_machine(bench.gateway, Command::stop)), "");
    bench.gateway.write(gw::register_of(store::Setting::virtual_motor), 1);
    for (const Command command : {Command::stop, Command::safe, Command::hold}) {
        bench.gateway.command(Command::run);
        bench.master.pause(std::chrono::milliseconds{50});
        EXPECT_EQ(stop_remark(stop_machine(bench.gateway, command)),
                  "; no motor is told: virtual_motor is on");
        stop_machine(bench.gateway, Command::stop);
    }
}

TEST(Client, SettingsOutliveAResetIfKept) {
    Bench bench;
    const auto reg = gw::register_of(store::Setting::safe_outputs);
    bench.gateway.write(reg, 5);
    bench.gateway.reset();
    EXPECT_EQ(bench.gateway.read(reg), 0U);
    bench.gateway.write(reg, 5);
    bench.gateway.command(Command::keep_settings, std::chrono::seconds{2});
    bench.gateway.reset();
    EXPECT_EQ(bench.gateway.read(reg), 5U);
    EXPECT_EQ(bench.refusal([&] { bench.gateway.write(reg, 16); }), gw::Result::bad_value);
}

TEST(Client, ASlowStorageIsWaitedFor) {
    Bench bench(1, 40);  // an erasure or programming takes 10 ms
    const auto sent = table(300);
    upload(bench.gateway, sent, kQuiet);
    EXPECT_EQ(bench.gateway.read(gw::STORED_CRC), base::crc32(sent));
}

TEST(Client, AMovingMotorIsNotWaitedForWithoutEnd) {
    Bench bench;
    upload(bench.gateway, table(20), kQuiet);
    bench.unit.board.motor_registers[12] = 100;
    const base::Instant begun = bench.wire.now();
    EXPECT_EQ(bench.refusal([&] { bench.gateway.activate(); }), gw::Result::moving);
    const auto waited = bench.wire.now() - begun;
    EXPECT_GE(waited, GatewayClient::kStillWait);
    EXPECT_LE(waited, 2 * GatewayClient::kStillWait) << "in virtual time";
}

TEST(Client, WhatTakesLongEndsWhenTheUserHasHadEnough) {
    Bench bench;
    const auto old = table(20);
    upload(bench.gateway, old, kQuiet);
    bool goes_on = true;
    bench.gateway.set_goes_on([&] { return goes_on; });
    EXPECT_THROW(
        upload(bench.gateway, table(200, 2), [&](std::size_t done, std::size_t) { goes_on = done < 500; }),
        Interrupted);
    EXPECT_FALSE(bench.status().has(gw::kUpload)) << "aborted";
    EXPECT_EQ(bench.gateway.read(gw::STORED_CRC), base::crc32(old));
    bench.unit.board.motor_registers[12] = 100;
    EXPECT_THROW(bench.gateway.activate(), Interrupted);
    bench.unit.board.motor_registers[12] = 0;
    goes_on = true;
    bench.gateway.activate();
    EXPECT_THROW(download(bench.gateway, [&](std::size_t, std::size_t) { goes_on = false; }), Interrupted);
}

TEST(Client, AnUploadThatAnotherClientDisturbedIsRefused) {
    Bench bench;
    bool taken = false;
    EXPECT_EQ(bench.refusal([&] {
        upload(bench.gateway, table(100), [&](std::size_t done, std::size_t all) {
            if (done < all || taken) return;
            taken = true;
            bench.gateway.command(Command::upload_begin);
        });
    }),
              gw::Result::wrong_check);
}

struct BadLine : testing::TestWithParam<std::uint64_t> {};

TEST_P(BadLine, TablesArriveWholeAndCommandsAreDoneOnce) {
    Bench bench(GetParam());
    bench.wire.set_faults({.drop = 0.0005, .damage = 0.001, .framing = 0.0005});
    const auto sent = table(150, static_cast<std::uint8_t>(GetParam()));
    upload(bench.gateway, sent, kQuiet);
    bench.gateway.activate();
    EXPECT_EQ(download(bench.gateway, kQuiet), sent) << "seed " << GetParam();
    bench.gateway.command(Command::clear_log);
    bench.gateway.command(Command::run);
    bench.gateway.command(Command::stop);
    bench.wire.set_faults({});
    unsigned starts = 0;
    for (const LogEntry& entry : read_log(bench.gateway))
        starts += entry.event == static_cast<int>(gw::Event::started) ? 1U : 0U;
    EXPECT_LE(starts, 1U) << "seed " << GetParam();
    const auto& counters = bench.master.counters();
    std::cout << "seed " << GetParam() << ": " << counters.questions << " questions, " << counters.timeouts
              << " time-outs\n";
}

INSTANTIATE_TEST_SUITE_P(Seeds, BadLine, testing::Range<std::uint64_t>(1, 21));

TEST(Client, ALineThatIsCutEndsTheUploadAndTheOldTableStays) {
    Bench bench;
    const auto old = table(20);
    upload(bench.gateway, old, kQuiet);
    try {
        upload(bench.gateway, table(200, 2), [&](std::size_t done, std::size_t) {
            if (done > 500) bench.wire.to_unit().cut();
        });
        FAIL();
    } catch (const LineError& error) {
        EXPECT_NE(std::string(error.what()).find("the stored table is as it was"), std::string::npos)
            << error.what();
    }
    bench.wire.to_unit().restore();
    EXPECT_EQ(bench.gateway.read(gw::STORED_CRC), base::crc32(old));
    const auto next = table(30, 3);
    upload(bench.gateway, next, kQuiet);
    EXPECT_EQ(bench.gateway.read(gw::STORED_CRC), base::crc32(next));
}

TEST(Client, AnUploadWhoseEndIsNotSeenClaimsNothing) {
    Bench bench(1, 200);
    const std::vector<std::uint8_t> commit{0x52, 0x52, 0x52, 128, 127, 48, 207, 4, 251, 17, 238};
    bench.gateway.set_goes_on([&] {
        const auto& sent = bench.wire.sent();
        if (std::search(sent.begin(), sent.end(), commit.begin(), commit.end()) != sent.end())
            bench.wire.from_unit().cut();
        return true;
    });
    try {
        upload(bench.gateway, table(20), kQuiet);
        FAIL();
    } catch (const LineError& error) {
        EXPECT_NE(std::string(error.what()).find("the old table or the new one"), std::string::npos)
            << error.what();
    }
}

TEST(NanoctlNames, AnInvertedInputIsListedByItsName) {
    seqc::SymbolFile file;
    file.symbols.inputs = {"Start", "IN1", "Estop", "IN3", "IN4", "IN5"};
    file.symbols.inverted_inputs = 0x04;
    const Names names(file);
    EXPECT_EQ(signals_text(0x00, 6, names, true), "Estop");
    EXPECT_EQ(signals_text(0x05, 6, names, true), "Start");
    EXPECT_EQ(names.wire(2), "NOT Estop");
    EXPECT_EQ(names.wire(0), "Start");
    EXPECT_EQ(Names().wire(2), "IN2");
    EXPECT_EQ(signals_text(0x04, 6, Names(), true), "IN2");
}

}  // namespace
}  // namespace nplc::nanoctl
