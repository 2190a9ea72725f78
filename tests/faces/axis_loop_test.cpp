// The loop's side of a model on a gateway whose board is the test's own.
#include "faces/axis_loop.h"

#include <gtest/gtest.h>

#include <map>

#include "port_bench.h"

namespace nplc::faces {
namespace {

namespace gw = registers::gateway;
using gateway::Bytes;
using gateway::PortBench;
using namespace std::chrono_literals;

/// Step 0 goes to step 1, which stays (STATE C0h and C1h, FAST_DIS, no switch from 1).
const Bytes kTable{{0xC0, 0, 0, 0x01, 0x80, 0, 0, 0}, {0xC1, 0, 0, 0x3E, 0x80, 1, 0, 0}};

struct Bench {
    explicit Bench(const LoopSettings& settings = {}) : loop(model, settings) {
        EXPECT_TRUE(port.upload_and_activate(kTable));
    }

    void poll() {
        port.poll();
        loop.poll(*port.controller, port.board.now, port.board.now);
    }
    void run(base::Microseconds time) {
        for (const auto end = now() + time; now() < end;) poll();
    }
    base::Instant now() const { return port.board.now; }
    AxisImage image() {
        run(20ms);
        static_cast<void>(model.image(now()));
        run(20ms);
        return model.image(now());
    }
    /// How it ended within `time`.
    std::optional<Completion> tell(CommandDesk::Client& client, const Command& command,
                                   base::Microseconds time = 100ms) {
        const auto id = client.submit(command);
        for (const auto end = now() + time; now() < end;) {
            poll();
            if (const auto ended = client.take()) {
                EXPECT_EQ(ended->id, id.value_or(0));
                return ended;
            }
        }
        return std::nullopt;
    }
    Result result(CommandDesk::Client& client, const Command& command, base::Microseconds time = 100ms) {
        const auto ended = tell(client, command, time);
        return ended ? ended->result : Result::busy;
    }
    Command order(gw::Command command) const { return Command::of(command, now()); }

    PortBench port;
    AxisModel model{"x"};
    AxisLoop loop;
    Bell bell{[] {}};
    std::unique_ptr<CommandDesk::Client> plc = model.join(Side::plant, "PLC", bell);
    std::unique_ptr<CommandDesk::Client> panel = model.join(Side::person, "panel", bell);
};

TEST(AxisLoop, TakesImagesOnlyWhileSomebodyAsks) {
    Bench bench;
    bench.run(50ms);
    EXPECT_EQ(bench.model.image_number(), 0U);
    EXPECT_EQ(bench.model.image(bench.now()).number, 0U);
    bench.run(10ms);
    const std::uint64_t first = bench.model.image_number();
    EXPECT_NE(first, 0U);
    // One every 10 ms for the second after the last question.
    bench.run(2'000ms);
    EXPECT_NEAR(static_cast<double>(bench.model.image_number() - first), 99, 2);
}

/// As the MQTT face does, which publishes the axis at the start.
TEST(AxisLoop, CausesAskedForBeforeTheMotorAnswersAreKnownSoonAfter) {
    Bench bench;
    const auto finds = [&bench](base::Microseconds within) {
        std::shared_ptr<const Findings> found;
        for (const auto end = bench.now() + within; bench.now() < end && found == nullptr;) {
            bench.run(200ms);
            static_cast<void>(bench.model.image_with_why(bench.now(), &found));
        }
        return found != nullptr;
    };
    ASSERT_EQ(bench.result(*bench.plc, bench.order(gw::Command::run)), Result::done);
    bench.port.board.link_state = motor::Link::starting;
    finds(1s);
    bench.port.board.link_state = motor::Link::up;
    EXPECT_TRUE(finds(6s));

    Bench other;
    other.port.board.access_answers = motor::AccessState::failed;
    std::shared_ptr<const Findings> found;
    for (int i = 0; i < 10; ++i) {
        other.run(200ms);
        static_cast<void>(other.model.image_with_why(other.now(), &found));
        EXPECT_EQ(found, nullptr);
    }
    other.port.board.access_answers = motor::AccessState::done;
    for (int i = 0; i < 30 && found == nullptr; ++i) {
        other.run(200ms);
        static_cast<void>(other.model.image_with_why(other.now(), &found));
    }
    EXPECT_NE(found, nullptr) << "what failed is read again";
}

TEST(AxisLoop, AStopIsDoneWhenTheMotorHasConfirmedIt) {
    for (const gw::Command stop : {gw::Command::stop, gw::Command::safe, gw::Command::hold}) {
        Bench bench;
        ASSERT_EQ(bench.result(*bench.plc, bench.order(gw::Command::run)), Result::done);
        bench.run(20ms);
        bench.port.board.stop_takes = 300ms;
        EXPECT_FALSE(bench.tell(*bench.panel, bench.order(stop), 290ms));
        bench.run(20ms);
        const auto ended = bench.panel->take();
        ASSERT_TRUE(ended);
        EXPECT_EQ(ended->result, Result::done);
        EXPECT_FALSE(bench.port.gateway->stop_unconfirmed());
    }
}

TEST(AxisLoop, AStopThatNobodyConfirmsIsSaidAfterASecond) {
    for (const gw::Command stop : {gw::Command::stop, gw::Command::safe}) {
        Bench bench;
        ASSERT_EQ(bench.result(*bench.plc, bench.order(gw::Command::run)), Result::done);
        bench.run(20ms);
        bench.port.board.stop_is_confirmed = false;
        const auto first = bench.plc->submit(bench.order(stop));
        EXPECT_FALSE(bench.tell(*bench.panel, bench.order(stop), 990ms));
        EXPECT_FALSE(bench.plc->take());
        bench.run(20ms);
        for (CommandDesk::Client* client : {bench.plc.get(), bench.panel.get()}) {
            const auto ended = client->take();
            ASSERT_TRUE(ended);
            EXPECT_EQ(ended->result, Result::stop_unconfirmed);
        }
        EXPECT_TRUE(first);
        // Nothing else waits for it meanwhile.
        EXPECT_EQ(bench.result(*bench.plc, bench.order(gw::Command::run)), Result::stop_unconfirmed);
    }
}

TEST(AxisLoop, ShowsTheRegistersOfOneInstant) {
    Bench bench;
    ASSERT_EQ(bench.result(*bench.plc, bench.order(gw::Command::run)), Result::done);
    const AxisImage image = bench.image();
    EXPECT_EQ(image[gw::IDENTITY], gw::kIdentity);
    EXPECT_EQ(image[gw::STEP], 1U);
    EXPECT_EQ(image.run_state(), gw::RunState::running);
    EXPECT_EQ(image[gw::OUTPUTS] & 0xF, 1U);
    EXPECT_EQ(image[gw::TABLE_BYTES], 24U);
    EXPECT_EQ(image[gw::FIRED_STEP], 1U);
    EXPECT_EQ(image.setting(gw::Setting::debounce), 3'000U);
    EXPECT_NEAR(image[gw::UPTIME], *bench.port.read(gw::UPTIME), 11);
    const auto table = bench.model.table();
    EXPECT_EQ(table->bytes.size(), 24U);
    EXPECT_EQ(table->crc, image[gw::TABLE_CRC]);
    const auto key = static_cast<sequencer::Key>(image[gw::FIRED_KEY]);
    EXPECT_FALSE(table->fired(0, 1, key));
    EXPECT_TRUE(table->fired(1, 1, key));
    EXPECT_FALSE(table->fired(3, 1, key));
}

/// Whether a face asks or not.
TEST(AxisLoop, CountsScansAndEvents) {
    Bench bench;
    ASSERT_EQ(bench.result(*bench.plc, bench.order(gw::Command::run)), Result::done);
    bench.run(2'000ms);
    const std::uint32_t scans = bench.port.controller->sequence().scans();
    ASSERT_EQ(bench.result(*bench.plc, bench.order(gw::Command::stop)), Result::done);
    const Tally tally = bench.image().tally;
    std::uint64_t counted = 0;
    for (const std::uint64_t one : tally.scans) counted += one;
    EXPECT_GT(counted, 0U);
    EXPECT_LE(counted, scans + 1);
    EXPECT_EQ(tally.events[static_cast<std::size_t>(gw::Event::started)], 1U);
    EXPECT_EQ(tally.events[static_cast<std::size_t>(gw::SafeReason::stop_command)], 1U);
}

/// The person who reads the fired terms in two blocks is not disturbed.
TEST(AxisLoop, LeavesThePersonsPortItsOwn) {
    Bench bench;
    EXPECT_FALSE(bench.port.write(gw::STEP, 1));
    const std::uint32_t result = bench.port.result();
    EXPECT_EQ(result, PortBench::result_of(Result::read_only, gw::STEP));
    static_cast<void>(bench.port.read(gw::FIRED_SCAN));
    const auto fired = bench.port.read(gw::FIRED_SCAN + 2);
    ASSERT_EQ(bench.result(*bench.plc, bench.order(gw::Command::run)), Result::done);
    static_cast<void>(bench.image());
    EXPECT_EQ(bench.port.result(), result);
    EXPECT_EQ(bench.port.read(gw::FIRED_SCAN + 2), fired);
}

TEST(AxisLoop, AnImageAfterACommandShowsWhatItDid) {
    Bench bench;
    static_cast<void>(bench.image());
    ASSERT_EQ(bench.result(*bench.plc, Command::own(gw::BREAK_LOW, 8, bench.now())), Result::done);
    EXPECT_EQ(bench.model.image(bench.now())[gw::BREAK_LOW], 8U);
}

TEST(AxisLoop, TellsOfTheWritesThatItCarriesOut) {
    Bench bench;
    std::vector<std::uint32_t> told;
    bench.loop.tell_writes([&](const Command& one) {
        if (one.reg == gw::COMMAND) told.push_back(one.value);
    });
    const auto value = [](gw::Command one) { return static_cast<std::uint32_t>(one); };
    ASSERT_EQ(bench.result(*bench.panel, bench.order(gw::Command::run)), Result::done);
    ASSERT_EQ(bench.result(*bench.panel, bench.order(gw::Command::stop)), Result::done);
    EXPECT_EQ(bench.result(*bench.plc, bench.order(gw::Command::run)), Result::seat_taken);
    EXPECT_EQ(told, (std::vector<std::uint32_t>{value(gw::Command::run), value(gw::Command::stop)}));
}

TEST(AxisLoop, SaysNoAsTheUsersPortDoes) {
    Bench bench;
    EXPECT_EQ(bench.result(*bench.plc, Command::own(gw::STEP, 1, bench.now())), Result::read_only);
    EXPECT_EQ(bench.result(*bench.plc, Command::own(250, 1, bench.now())), Result::no_register);
    EXPECT_EQ(bench.result(*bench.plc, Command::own(gw::COMMAND, 99, bench.now())), Result::bad_value);
    EXPECT_EQ(bench.result(*bench.plc, bench.order(gw::Command::hold)), Result::not_running);
    ASSERT_EQ(bench.result(*bench.plc, bench.order(gw::Command::run)), Result::done);
    bench.run(10ms);
    EXPECT_EQ(bench.result(*bench.plc, bench.order(gw::Command::run)), Result::not_stopped);
    EXPECT_EQ(bench.result(*bench.plc, Command::own(gw::register_of(gw::Setting::debounce), 5, bench.now())),
              Result::not_stopped);
}

TEST(AxisLoop, OneClientOperates) {
    Bench bench;
    ASSERT_EQ(bench.result(*bench.plc, bench.order(gw::Command::run)), Result::done);
    const auto refused = bench.tell(*bench.panel, Command::own(gw::FORCE_IN, 0x0101, bench.now()));
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->result, Result::seat_taken);
    EXPECT_EQ(refused->detail, 0);
    const AxisImage image = bench.image();
    EXPECT_EQ(image.holder, bench.plc->number());
    EXPECT_STREQ(image.holder_name.data(), "PLC");
    // Everybody stops.
    EXPECT_EQ(bench.result(*bench.panel, bench.order(gw::Command::stop)), Result::done);
    EXPECT_EQ(bench.image().run_state(), gw::RunState::stopped);
    bench.plc.reset();
    EXPECT_EQ(bench.result(*bench.panel, Command::own(gw::BREAK_LOW, 8, bench.now())), Result::done);
}

TEST(AxisLoop, TheSeatIsTakenAndLeftByName) {
    Bench bench;
    Command seat = bench.order(gw::Command::run);
    seat.kind = Command::Kind::take_seat;
    EXPECT_EQ(bench.result(*bench.panel, seat), Result::done);
    EXPECT_EQ(bench.result(*bench.plc, bench.order(gw::Command::run)), Result::seat_taken);
    seat.kind = Command::Kind::leave_seat;
    EXPECT_EQ(bench.result(*bench.panel, seat), Result::done);
    EXPECT_EQ(bench.result(*bench.plc, bench.order(gw::Command::run)), Result::done);
}

TEST(AxisLoop, TheSeatIsTakenOverAndItsHolderIsTold) {
    Bench bench;
    ASSERT_EQ(bench.result(*bench.plc, bench.order(gw::Command::run)), Result::done);
    Command seat = bench.order(gw::Command::run);
    seat.kind = Command::Kind::take_seat;
    EXPECT_EQ(bench.result(*bench.panel, seat), Result::seat_taken);
    seat.kind = Command::Kind::take_over_seat;
    EXPECT_EQ(bench.result(*bench.panel, seat), Result::done);
    EXPECT_EQ(bench.image().holder, bench.panel->number());
    const auto refused = bench.tell(*bench.plc, bench.order(gw::Command::run));
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->result, Result::seat_taken);
    EXPECT_EQ(refused->detail, gw::kSeatTakenOver);
}

/// No client takes over from the other side of the local/remote switch.
TEST(AxisLoop, TakingOverKeepsToTheSideThatMayOperate) {
    Bench bench({.remote_input = 5});
    bench.run(10ms);
    Command seat = bench.order(gw::Command::run);
    seat.kind = Command::Kind::take_over_seat;
    EXPECT_EQ(bench.result(*bench.plc, seat), Result::seat_taken);
    EXPECT_EQ(bench.result(*bench.panel, seat), Result::done);
}

TEST(AxisLoop, AnInputSwitchesBetweenPersonsAndThePlant) {
    Bench bench({.remote_input = 5});
    bench.run(10ms);
    const auto local = bench.tell(*bench.plc, bench.order(gw::Command::run));
    ASSERT_TRUE(local);
    EXPECT_EQ(local->result, Result::seat_taken);
    EXPECT_EQ(local->detail, 1);
    bench.port.board.in = 1U << 5;
    bench.run(10ms);
    EXPECT_EQ(bench.result(*bench.plc, bench.order(gw::Command::run)), Result::done);
    const auto remote = bench.tell(*bench.panel, Command::own(gw::BREAK_LOW, 8, bench.now()));
    EXPECT_EQ(remote->detail, 2);
    EXPECT_EQ(bench.result(*bench.panel, bench.order(gw::Command::stop)), Result::done);
}

/// 1 s is the most that a command may have waited.
TEST(AxisLoop, LateIsNever) {
    Bench bench;
    const Command old = Command::of(gw::Command::run, bench.now() - 1'001ms);
    EXPECT_EQ(bench.result(*bench.plc, old), Result::too_late);
    EXPECT_EQ(bench.image().run_state(), gw::RunState::stopped);
    const Command old_stop = Command::of(gw::Command::stop, bench.now() - 5'000ms);
    EXPECT_EQ(bench.result(*bench.plc, old_stop), Result::done);
}

TEST(AxisLoop, WhoHasLeftStartsNothing) {
    Bench bench;
    ASSERT_TRUE(bench.plc->submit(bench.order(gw::Command::run)));
    bench.plc.reset();
    bench.run(50ms);
    EXPECT_EQ(bench.image().run_state(), gw::RunState::stopped);
}

/// An activation waits for the motor to stand still; a stop ends it for whoever began it.
TEST(AxisLoop, AStopEndsWhatWaits) {
    Bench bench;
    bench.port.board.motor_registers[registers::V_IST] = 5;
    ASSERT_TRUE(bench.plc->submit(bench.order(gw::Command::activate)));
    bench.poll();
    EXPECT_FALSE(bench.plc->take());
    EXPECT_EQ(bench.result(*bench.panel, bench.order(gw::Command::stop)), Result::done);
    EXPECT_EQ(bench.plc->take()->result, Result::too_late);
}

/// A person's activation that waits is refused by a stop from a face, and the person can read why.
TEST(AxisLoop, AStopEndsAPersonsWriteToo) {
    Bench bench;
    bench.port.board.access_answers = motor::AccessState::waiting;
    bench.port.ask({.kind = gateway::mactalk::Kind::write,
                    .address = gw::kDefaultAddress,
                    .reg = gw::COMMAND,
                    .length = 4,
                    .value = static_cast<std::uint32_t>(gw::Command::activate)});
    bench.poll();
    bench.port.line.sent.clear();
    EXPECT_EQ(bench.result(*bench.panel, bench.order(gw::Command::stop)), Result::done);
    bench.run(10ms);
    EXPECT_TRUE(bench.port.line.sent.empty());
    EXPECT_EQ(bench.port.result(), PortBench::result_of(Result::too_late, gw::COMMAND));
}

TEST(AxisLoop, ReadsAndWritesTheMotorByThePortsRules) {
    Bench bench;
    bench.port.board.motor_registers[registers::P_IST] = 4'711;
    const auto read = bench.tell(*bench.plc, Command::motor_read(registers::P_IST, true, bench.now()));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->result, Result::done);
    EXPECT_EQ(read->value, 4'711U);
    EXPECT_EQ(bench.result(*bench.plc, Command::motor_write(registers::V_SOLL, false, 9, bench.now())),
              Result::done);
    EXPECT_EQ(bench.port.board.accesses.back(),
              (motor::Access{.is_write = true, .reg = registers::V_SOLL, .value = 9}));
    ASSERT_EQ(bench.result(*bench.plc, bench.order(gw::Command::run)), Result::done);
    bench.run(10ms);
    EXPECT_EQ(bench.result(*bench.plc, Command::motor_write(registers::V_SOLL, false, 8, bench.now())),
              Result::not_allowed);
    bench.port.board.link_state = motor::Link::down;
    EXPECT_EQ(bench.result(*bench.plc, Command::motor_read(registers::P_IST, true, bench.now())),
              Result::link_down);
}

/// Neither takes the other one's answer: a motor that turns is not said to stand, and V_IST is no position.
TEST(AxisLoop, AnActivationHasTheMotorForItself) {
    Bench bench({.motor_period = 1ms});
    bench.port.board.motor_registers[registers::P_IST] = 4'711;
    bench.port.board.motor_registers[registers::V_IST] = 500;
    for (int turn = 0; turn < 100; ++turn) {
        bench.run(turn % 10 * 250us);
        EXPECT_EQ(bench.result(*bench.panel, bench.order(gw::Command::activate)), Result::moving);
        const AxisImage image = bench.model.image(bench.now());
        const MotorValue& position = image.motor[static_cast<std::size_t>(MotorItem::position)];
        EXPECT_TRUE(!position.is_known || position.value == 4'711) << position.value;
    }
}

TEST(AxisLoop, KnowsTheMotorsValuesAndHowOldTheyAre) {
    Bench bench;
    bench.port.board.motor_registers[registers::P_IST] = static_cast<std::uint32_t>(-12'345);
    bench.port.board.motor_registers[registers::V_IST] = 0xFFF9;  // -7 in 16 bits
    EXPECT_EQ(bench.image().of_motor(MotorItem::velocity).quality(bench.now(), 1s), Quality::unknown);
    for (int i = 0; i < 50; ++i) static_cast<void>(bench.image());
    AxisImage image = bench.image();
    EXPECT_EQ(image.of_motor(MotorItem::position).value, -12'345);
    EXPECT_EQ(image.of_motor(MotorItem::position).quality(bench.now(), 1s), Quality::good);
    EXPECT_EQ(image.of_motor(MotorItem::velocity).value, -7);
    bench.port.board.link_state = motor::Link::down;
    for (int i = 0; i < 50; ++i) image = bench.image();
    EXPECT_EQ(image.of_motor(MotorItem::position).value, -12'345);
    EXPECT_EQ(image.of_motor(MotorItem::position).quality(bench.now(), 1s), Quality::old);
    EXPECT_GT(bench.now() - image.motor_contact, 1s);
}

/// The line is for the sequence and the operators: one register every 100 ms, and none without a request.
/// Another motor may answer next, or the same one after its power was off.
TEST(AxisLoop, OfALostMotorNothingIsGood) {
    static constexpr base::Microseconds kLongest{20'000'000};
    Bench bench;
    const auto looks = [&bench](base::Microseconds time, const auto& come) {
        std::shared_ptr<const Findings> why;
        for (const auto end = bench.now() + time; bench.now() < end;) {
            bench.run(10ms);
            const AxisImage image = bench.model.image_with_why(bench.now(), &why);
            if (come(image, why)) return true;
        }
        return false;
    };
    const auto knows = [&bench](const AxisImage& image, MotorItem item) {
        return image.of_motor(item).quality(bench.now(), kLongest) == Quality::good;
    };
    const auto knows_all = [&knows](const AxisImage& image, const auto& why) {
        return why != nullptr && knows(image, MotorItem::mode) && knows(image, MotorItem::target);
    };
    ASSERT_TRUE(looks(10s, knows_all));
    bench.port.board.link_state = motor::Link::down;
    ASSERT_TRUE(
        looks(30ms, [](const AxisImage& image, const auto&) { return !image.is_set(gw::kLinkDelivers); }));
    looks(100ms, [&](const AxisImage& image, const auto&) {
        for (std::size_t i = 0; i < kMotorItems; ++i) {
            EXPECT_NE(image.motor[i].quality(bench.now(), kLongest), Quality::good) << i;
        }
        EXPECT_EQ(image.of_motor(MotorItem::mode).quality(bench.now(), kLongest), Quality::old);
        return false;
    });
    bench.port.board.access_answers = motor::AccessState::failed;
    bench.port.board.link_state = motor::Link::up;
    EXPECT_FALSE(looks(1s, [&](const AxisImage& image, const auto& why) {
        return why != nullptr && image.is_set(gw::kLinkDelivers);
    })) << "it was not read since";
    EXPECT_FALSE(
        looks(1s, [&](const AxisImage& image, const auto&) { return knows(image, MotorItem::mode); }));
    bench.port.board.access_answers = motor::AccessState::done;
    EXPECT_TRUE(looks(10s, knows_all));
}

TEST(AxisLoop, ReadsTheMotorSeldom) {
    Bench bench;
    static_cast<void>(bench.image());
    bench.port.board.accesses.clear();
    for (int i = 0; i < 25; ++i) static_cast<void>(bench.image());
    EXPECT_NEAR(static_cast<double>(bench.port.board.accesses.size()), 10, 1);
    bench.run(2s);
    bench.port.board.accesses.clear();
    bench.run(2s);
    EXPECT_TRUE(bench.port.board.accesses.empty());
}

/// The same number of reads, so that the sequence's orders wait no more often.
TEST(AxisLoop, ReadsTheTorqueAsOftenAsThePositionForATrend) {
    const auto reads = [](Bench& bench, bool has_trend) {
        bench.port.board.accesses.clear();
        for (const auto end = bench.now() + 14s; bench.now() < end;) {
            if (has_trend) bench.model.want_trend(bench.now());
            static_cast<void>(bench.image());
        }
        std::map<unsigned, int> count;
        for (const motor::Access& access : bench.port.board.accesses) ++count[access.reg];
        count[0] = static_cast<int>(bench.port.board.accesses.size());
        return count;
    };
    Bench bench;
    reads(bench, false);  // the first pass over all
    auto usual = reads(bench, false);
    auto trend = reads(bench, true);
    EXPECT_LT(usual[registers::VF_OUT] * 3, usual[registers::P_IST]);
    EXPECT_NEAR(trend[registers::VF_OUT], trend[registers::P_IST], 1);
    EXPECT_NEAR(trend[registers::VF_OUT], trend[registers::V_IST], 1);
    EXPECT_GE(trend[registers::VF_OUT], 35);
    EXPECT_NEAR(trend[0], usual[0], 1);
    EXPECT_GE(trend[registers::ERR_STAT], 2) << "the others have their turns";
    bench.run(2s);
    EXPECT_LT(reads(bench, false)[registers::VF_OUT] * 3, usual[registers::P_IST]);
}

}  // namespace
}  // namespace nplc::faces
