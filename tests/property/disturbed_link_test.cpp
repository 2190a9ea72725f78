// Random sequences on a disturbed line, with a motor that loses its supply: the motor executes what was
// ordered, in that order, nothing twice and nothing else; and the link comes back. Damaged characters are
// left out here: what they can do is in firmware/motor's README and held by tests/e2e.

#include <gtest/gtest.h>

#include "order_audit.h"
#include "random_tables.h"
#include "sim/world.h"

namespace nplc::property {
namespace {

using namespace std::chrono_literals;
using sim::Time;

/// Four steps that send whatever a table can hold, link commands too; so do their conditions that name ERROR.
std::vector<std::uint8_t> sending_table(Dice& dice) {
    std::vector<std::uint8_t> bytes;
    const unsigned terms = 6 + dice.below(12);
    for (unsigned i = 0; i < terms; ++i) {
        const auto put = [&](unsigned byte) { bytes.push_back(static_cast<std::uint8_t>(byte)); };
        const bool is_flex = dice.one_in(3);
        put(0xC0 | dice.below(4));
        put((dice.one_in(3) ? 0x80 : 0) | dice.below(4));
        put((is_flex ? 0x80 : 0) | dice.below(4));
        if (is_flex) {
            constexpr std::uint8_t kRegisters[]{3, 5, 6, 7, 33, 34, 49, 51, 65, 66, 73, 77, 85};
            const bool longword = dice.one_in(3);
            put((longword ? 0x80U : 0U) | kRegisters[dice.below(std::size(kRegisters))]);
            for (int n = 0; n < 4; ++n) put(dice.below(256));
        } else {
            put(dice.below(4));
            put(dice.one_in(4) ? 0x80 : dice.below(128));
            put(dice.below(16));
            put(0);
            put(0);
        }
    }
    bytes.insert(bytes.end(), {0x3F, 0, 0, 0, 0, 0, 0, 0});
    return bytes;
}

class DisturbedRun {
  public:
    explicit DisturbedRun(std::uint64_t seed) : dice_(seed), world_(sending_table(dice_), options(seed)) {}

    void run() {
        for (int event = 0; event < 40; ++event) {
            disturb();
            go_on(Time(1'000'000 * static_cast<std::int64_t>(1 + dice_.below(60))));
        }
        world_.cut_line(false);
        world_.power_motor(true);
        world_.spoil_line({.drop = 0, .damage = {}, .framing = 0, .delay = 0, .longest_delay = {}});
        go_on(300ms);
    }

    void check() {
        EXPECT_TRUE(world_.take_snapshot().link_up) << "the link has not come back";
        sim::OrderAuditor auditor(protocol::fastmac::RegisterCode::format_list);
        for (const sim::SentOrder& order : ordered_) auditor.ordered(order);
        for (const sim::Order& order : world_.mac().orders()) auditor.executed(order);
        const auto result = auditor.finish(world_.on_their_way());
        EXPECT_EQ(result.unordered.count, result.unordered.first.size());
        for (const sim::SentOrder& order : result.unordered.first)
            EXPECT_TRUE(is_rest_of_a_blind_stop(order))
                << int{order.command} << ", register " << int{order.reg} << ": executed and not ordered";
        for (const sim::Order& order : world_.mac().orders()) {
            if (!order.flexmac || order.reg == 2) continue;  // 2: the gateway's own stop
            EXPECT_TRUE(was_ordered_lately(order)) << "register " << int{order.reg} << " is written late";
        }
        EXPECT_EQ(world_.board().bites(), 0U);
    }

  private:
    static sim::WorldOptions options(std::uint64_t seed) {
        constexpr std::uint32_t kBaud[]{9'600, 19'200, 115'200};
        return {.baud = kBaud[seed % 3], .seed = seed, .faults = {}, .gateway = {}};
    }

    void disturb() {
        switch (dice_.below(10)) {
            case 0:
                return world_.cut_line(true);
            case 1:
            case 2:
                return world_.cut_line(false);
            case 3:
                return cycle_power();
            case 4:
                return spoil(0.05, 0, 0);
            case 5:
                return spoil(0, 0.02, 0);
            case 6:
                return spoil(0, 0, 0.02);
            case 7:
                return spoil(0, 0, 0);
            default:
                return world_.toggle_input(dice_.below(2));
        }
    }

    void spoil(double drop, double delay, double framing) {
        world_.spoil_line(
            {.drop = drop, .damage = {}, .framing = framing, .delay = delay, .longest_delay = {}});
    }

    /// A motor that is switched on in the middle of a blind stop, with rapid communication as always then,
    /// takes its bytes 00h and 02h for commands: INIT(P1) and INIT(P3), which leave it without power, as the
    /// stop does.
    static bool is_rest_of_a_blind_stop(const sim::SentOrder& order) {
        return !order.is_register_write && (order.command == 0x00 || order.command == 0x02);
    }

    /// Within the second before it was executed: a full queue with resends takes less.
    bool was_ordered_lately(const sim::Order& executed) const {
        for (std::size_t i = 0; i < ordered_.size(); ++i) {
            const auto age = executed.at.time_since_epoch() - ordered_at_[i];
            if (ordered_[i].is_register_write && ordered_[i].reg == executed.reg &&
                ordered_[i].value == executed.message.value && age >= 0ms && age < 1s) {
                return true;
            }
        }
        return false;
    }

    /// Off for longer than the driver's limit of silence: 20 ms and up to 40 ms by which the line is late.
    void cycle_power() {
        world_.power_motor(false);
        go_on(Time(1'000'000 * static_cast<std::int64_t>(65 + dice_.below(50))));
        world_.power_motor(true);
    }

    void go_on(Time duration) {
        const Time end = world_.now() + duration;
        while (world_.now() < end) {
            world_.step(end);
            const auto orders = world_.take_snapshot().orders;
            ordered_.insert(ordered_.end(), orders.begin(), orders.end());
            ordered_at_.resize(ordered_.size(), world_.now());
        }
    }

    Dice dice_;
    sim::World world_;
    std::vector<sim::SentOrder> ordered_;
    std::vector<Time> ordered_at_;
};

TEST(DisturbedLink, TheMotorExecutesWhatWasOrderedAndNothingElse) {
    for (std::uint64_t seed = 1; seed <= NPLC_DISTURBED_RUNS; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        DisturbedRun run(seed);
        run.run();
        run.check();
        if (HasFailure()) return;
    }
}

}  // namespace
}  // namespace nplc::property
