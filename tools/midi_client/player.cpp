#include "midi_client/player.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "registers/midi_scale.h"

namespace nplc::midi_client {

namespace midi = registers::midi;
using Kind = Answer::Kind;

namespace {

constexpr std::int64_t kTicksPerMicrosecond = midi::kTicksPerSecond / 1'000'000;
constexpr std::size_t kProbes = kFifo + 1;
constexpr base::Microseconds kAskAgain{2'000};
constexpr base::Microseconds kSettling{300'000};
constexpr unsigned kStarts = 3;

base::Microseconds time_of(std::int64_t ticks) {
    return base::Microseconds{ticks / kTicksPerMicrosecond};
}

Segment pause_of(base::Microseconds time) {
    constexpr std::int64_t kPeriod = 8'000;
    const std::int64_t ticks = time.count() * kTicksPerMicrosecond;
    return {.pause = true,
            .steps = static_cast<std::int32_t>((ticks + kPeriod - 1) / kPeriod),
            .period = kPeriod};
}

/// The pauses that show that a module waits: while one passes, each axis must get another segment. Not
/// shorter than a busy computer may be held up.
Segment probe_for(const Link& link, std::size_t axes, base::Microseconds reserve) {
    constexpr base::Microseconds kShortest{200'000};
    return pause_of(
        std::max(kShortest, link.exchange_time() * static_cast<std::int64_t>(2 * axes) + reserve));
}

/// Long enough to fill all FIFOs twice.
Segment lead_in_for(const Link& link, std::size_t axes) {
    return pause_of(link.exchange_time() * static_cast<std::int64_t>(2 * axes * kProbes) +
                    base::Microseconds{500'000});
}

Plan with_probes(const Plan& plan, const Segment& probe) {
    Plan whole = plan;
    for (AxisPlan& axis : whole.axes) axis.segments.insert(axis.segments.begin(), kProbes, probe);
    return whole;
}

/// A module that has restarted would execute the next order at once, from its present position.
void look_for_boots(Link& link, const std::vector<std::uint8_t>& addresses) {
    for (const std::uint8_t address : addresses) {
        if (link.take_boot(address))
            throw NotPlayed(fmt::format(
                "axis {} started anew by itself: look at its supply and its security input", address));
    }
}

/// 003 §V.8: to address 0 all modules would move.
void look_for_everyone(const Link& link, const std::vector<std::uint8_t>& addresses) {
    for (const std::uint8_t address : addresses) {
        if (address == link.everyone())
            throw NotPlayed(fmt::format("axis {}: that is the address of all modules", address));
    }
}

/// After another master's SYNC the module starts each move as soon as it is prepared.
void look_for_foreign_sync(Link& link) {
    if (link.take_foreign_sync())
        throw NotPlayed(
            "another master on the bus sends SYNC (080h, 003 §V.4), which starts each axis as soon as its "
            "move is prepared, not all together: switch that SYNC off, or move one axis after the other; "
            "paths and circles that begin where the axes stand need no SYNC");
}

void forget_boots(Link& link, const std::vector<std::uint8_t>& addresses) {
    for (const std::uint8_t address : addresses) static_cast<void>(link.take_boot(address));
}

class Player {
  public:
    Player(Master& master, const Plan& plan, const PlayOptions& options)
        : master_(master),
          options_(options),
          probe_(probe_for(master.link(), plan.axes.size(), options.reserve)),
          plan_(with_probes(plan, probe_)),
          lead_(lead_in_for(master.link(), plan.axes.size())),
          feed_(plan_, lead_.ticks()),
          by_18h_(plan.axes.size()) {
        for (const AxisPlan& axis : plan.axes) {
            goals_.push_back(master.position(axis.address) + axis.displacement());
            addresses_.push_back(axis.address);
        }
    }

    void run() {
        const std::int64_t message = master_.link().exchange_time().count() * kTicksPerMicrosecond;
        const std::int64_t reserve = options_.reserve.count() * kTicksPerMicrosecond;
        if (std::string why = feeding_problem(plan_, lead_.ticks(), message, reserve); !why.empty())
            throw NotPlayed(why);
        forget_boots(link(), addresses_);
        for (const std::uint8_t address : addresses_) master_.expect_alone(address);
        look_at_axes();
        begin();
        for (std::size_t axis = 0; axis < plan_.axes.size(); ++axis) fill(axis);
        while (const auto next = feed_.next()) send(*next);
        finish();
    }

    const std::vector<std::uint8_t>& addresses() const { return addresses_; }

  private:
    Link& link() { return master_.link(); }

    void look() {
        if (options_.goes_on && !options_.goes_on()) throw Interrupted("interrupted");
        look_for_boots(link(), addresses_);
    }

    void look_at_axes() {
        for (const std::uint8_t address : addresses_) {
            const std::string why = obstacles(master_.status(address) & midi::kTrips);
            if (!why.empty()) throw NotPlayed(fmt::format("axis {} cannot move: {}", address, why));
        }
    }

    /// A general message that came damaged to the one that answers may have reached the others: all stop, and
    /// it is sent again. Nothing turns yet.
    void begin() {
        for (unsigned i = 0; i < kStarts; ++i) {
            began_ = link().now();
            const Answer answer = link().ask(
                {.address = link().everyone(), .number = midi::PAUSE, .data = segment_data(lead_)});
            began_latest_ = link().now();
            if (answer.kind == Kind::accepted) return;
            if (answer.kind == Kind::refused)
                throw NotPlayed(
                    "the module that answers for all refuses a segment: does it move, or has it a fault? "
                    "`macreg midi why` tells");
            if (!master_.stop_hard(addresses_).empty()) break;
        }
        throw NotPlayed(
            fmt::format("no answer to a message for all modules: one of them must have address {} ({})",
                        link().is_can() ? 1 : 0, link().is_can() ? "003 §V.8" : "000 §IV"));
    }

    /// Until the FIFO is full; one that never is shows that the module missed the general message.
    void fill(std::size_t axis) {
        for (std::size_t i = 0; i < kProbes; ++i) {
            look();
            const Answer answer = offer(axis, probe_);
            if (answer.kind == Kind::refused) {
                by_18h_[axis] = answer.by_18h;
                explain_refusal(axis);
                if (i + 1 < kFifo)
                    throw NotPlayed(
                        fmt::format("axis {} refuses segments: is another motion of it under way? `macreg "
                                    "midi stop` stops it",
                                    addresses_[axis]));
                return;
            }
            feed_.taken(axis);
        }
        throw NotPlayed(fmt::format(
            "axis {} did not take part in the common start; try again, and look for noise on the line",
            addresses_[axis]));
    }

    Answer offer(std::size_t axis, const Segment& segment) {
        const Answer answer = master_.try_command(
            addresses_[axis], segment.pause ? midi::PAUSE : midi::SEGMENT, segment_data(segment));
        const bool as_before = feed_.sent(axis) < kProbes || answer.by_18h == by_18h_[axis];
        if (answer.kind == Kind::accepted || (answer.kind == Kind::refused && as_before)) return answer;
        throw NotPlayed(
            fmt::format("{}: no clear answer from axis {}: whether it has its segment is not known, so all "
                        "axes were stopped",
                        link().name(), addresses_[axis]));
    }

    /// A full FIFO is no trouble; a fault or an end-stop is.
    void explain_refusal(std::size_t axis) {
        const std::string why = obstacles(master_.status(addresses_[axis]));
        if (!why.empty()) throw NotPlayed(fmt::format("axis {} stopped: {}", addresses_[axis], why));
    }

    void send(const Feed::Next& next) {
        wait_until(began_latest_ + time_of(next.free));
        // From this time on its FIFO may be empty, by any of the clocks.
        const base::Instant deadline = began_ + time_of(next.deadline);
        for (bool asked = false;; asked = true) {
            look();
            const Answer answer = offer(next.axis, next.segment);
            if (link().now() > deadline)
                throw NotPlayed(
                    fmt::format("axis {} ran out of segments: the line or this computer was too slow; use "
                                "longer segments",
                                addresses_[next.axis]));
            if (answer.kind == Kind::accepted) break;
            if (asked) explain_refusal(next.axis);
            link().pause(kAskAgain);
        }
        feed_.taken(next.axis);
    }

    void wait_until(base::Instant when) {
        while (link().now() < when) {
            look();
            tell_progress();
            link().pause(std::min<base::Microseconds>(base::Microseconds{20'000}, when - link().now()));
        }
    }

    void tell_progress() {
        if (!options_.progress) return;
        const double done = static_cast<double>((link().now() - began_).count());
        options_.progress(std::min(done / static_cast<double>(time_of(feed_.end()).count()), 1.0));
    }

    void finish() {
        wait_until(began_latest_ + time_of(feed_.end()));
        look();
        const base::Instant last = link().now() + kSettling;
        for (std::size_t axis = 0; axis < addresses_.size(); ++axis) {
            std::int32_t position = master_.position(addresses_[axis]);
            while (position != goals_[axis] && link().now() < last) {
                link().pause(kAskAgain);
                position = master_.position(addresses_[axis]);
            }
            if (position == goals_[axis]) continue;
            const std::string why = obstacles(master_.status(addresses_[axis]));
            throw NotPlayed(fmt::format("axis {} ended at {}, not at {} increments{}", addresses_[axis],
                                        position, goals_[axis], why.empty() ? "" : ": " + why));
        }
    }

    Master& master_;
    const PlayOptions& options_;
    Segment probe_;
    Plan plan_;
    Segment lead_;
    Feed feed_;
    std::vector<bool> by_18h_;  ///< how this axis says that its FIFO is full
    std::vector<std::int64_t> goals_;
    std::vector<std::uint8_t> addresses_;
    base::Instant began_{};
    base::Instant began_latest_{};
};

std::string joined(const std::vector<std::uint8_t>& addresses) {
    return fmt::format("{}", fmt::join(addresses, ", "));
}

/// Carries out `what`; whatever ends it early, the axes are stopped first.
template <class What>
void with_stop(Master& master, const std::vector<std::uint8_t>& addresses, const What& what) {
    const auto stop = [&]() -> std::string {
        const auto failed = master.stop_hard(addresses);
        if (failed.empty()) return {};
        return fmt::format("; STILL MOVING, perhaps: no answer to the stop from axis {}", joined(failed));
    };
    try {
        what();
    } catch (const NotPlayed& error) {
        throw NotPlayed(error.what() + stop());
    } catch (const LineError& error) {
        throw LineError(error.kind(), error.what() + stop());
    } catch (const Interrupted& error) {
        throw Interrupted(error.what() + stop());
    } catch (const std::runtime_error& error) {
        throw NotPlayed(error.what() + stop());
    }
}

/// A module that starts anew in between has forgotten the 10h and would go at once.
void prepare(Master& master, const Target& target) {
    master.command(target.address, midi::WAIT_SYNC);
    look_for_boots(master.link(), {target.address});
    master.command(target.address, midi::GO_TO, static_cast<std::uint32_t>(target.position));
}

/// How far from its target a module may stand that has reached it: its tolerance, and what standby swings
/// (003 §VII 02h).
std::int64_t slack_of(Master& master, std::uint8_t address) {
    constexpr std::int64_t kStandby = 5;
    return std::max<std::int64_t>(master.query(address, midi::GET_SETTINGS) & 0xFF, kStandby);
}

}  // namespace

std::string obstacles(std::uint32_t status) {
    constexpr std::uint32_t kStops =
        midi::kTrips | midi::kAtUpperInput | midi::kAtLowerInput | midi::kAtUpperStop | midi::kAtLowerStop;
    std::string text;
    for (const midi::Bit& bit : midi::status_bits()) {
        if ((status & kStops & bit.mask) != 0)
            text += fmt::format("{}{}", text.empty() ? "" : "; ", bit.text);
    }
    return text;
}

void play(Master& master, const Plan& plan, const PlayOptions& options) {
    for (const AxisPlan& axis : plan.axes) look_for_everyone(master.link(), {axis.address});
    Player player(master, plan, options);
    with_stop(master, player.addresses(), [&] { player.run(); });
}

void go_together(Master& master, const std::vector<Target>& targets, const PlayOptions& options) {
    std::vector<std::uint8_t> addresses;
    for (const Target& one : targets) addresses.push_back(one.address);
    look_for_everyone(master.link(), addresses);
    with_stop(master, addresses, [&] {
        forget_boots(master.link(), addresses);
        static_cast<void>(master.link().take_foreign_sync());
        for (const std::uint8_t address : addresses) master.expect_alone(address);
        look_for_foreign_sync(master.link());
        for (const Target& one : targets) prepare(master, one);
        look_for_foreign_sync(master.link());
        look_for_boots(master.link(), addresses);
        if (master.link().synchronise().kind != Kind::accepted)
            throw NotPlayed(
                "the common start was not confirmed: one module on the line must have address 00 (000 §IV)");
        const auto look = [&](std::int32_t) { look_for_boots(master.link(), addresses); };
        for (const Target& one : targets) await_arrival(master, one, options.goes_on, look);
    });
}

void await_arrival(Master& master, const Target& target, const std::function<bool()>& goes_on,
                   const std::function<void(std::int32_t)>& seen) {
    constexpr base::Microseconds kLongestStandstill{1'500'000};
    const std::int64_t slack = slack_of(master, target.address);
    std::optional<std::int32_t> before;
    base::Instant changed = master.link().now();
    for (;;) {
        if (goes_on && !goes_on()) throw Interrupted("interrupted");
        const bool busy = master.busy(target.address);
        const std::int32_t position = master.position(target.address);
        if (seen) seen(position);
        if (position == target.position) return;
        const base::Instant now = master.link().now();
        if (position != before) changed = now;
        before = position;
        look_for_boots(master.link(), {target.address});
        const std::string why = obstacles(master.status(target.address));
        if (!why.empty())
            throw NotPlayed(fmt::format("axis {} stopped at {} increments: {}", target.address,
                                        master.position(target.address), why));
        // Within its tolerance it is not busy any more, and may still creep nearer.
        if (now - changed > kLongestStandstill) {
            if (!busy && std::abs(std::int64_t{position} - target.position) <= slack) return;
            throw NotPlayed(
                fmt::format("axis {} stands at {} increments and does not reach {}: is the shaft held, the "
                            "torque too low, or the move stopped by someone else?",
                            target.address, position, target.position));
        }
        master.pause(base::Microseconds{20'000}, goes_on);
    }
}

}  // namespace nplc::midi_client
