#include "duel.h"

#include <algorithm>
#include <vector>

#include "naive_sequencer.h"
#include "sequencer/engine.h"
#include "sequencer/state.h"

namespace nplc::property {
namespace {

using sequencer::Engine;
using sequencer::InputImage;
using sequencer::MotorOrder;
using sequencer::ScanEffect;
using sequencer::State;
using sequencer::Table;
using Orders = std::vector<MotorOrder>;

naive::Refusal refusal_of(base::Error error) {
    switch (error) {
        case base::Error::table_ragged:
            return naive::Refusal::ragged;
        case base::Error::table_no_end:
            return naive::Refusal::no_end;
        case base::Error::no_space:
            return naive::Refusal::too_long;
        case base::Error::bad_next_step:
            return naive::Refusal::next_step_63;
        case base::Error::bad_register:
            return naive::Refusal::register_0;
        default:
            return naive::Refusal::none;
    }
}

std::string compare_load(const naive::Judgement& expected, const Table::LoadResult& loaded) {
    if (loaded.ok != (expected.refusal == naive::Refusal::none)) return "loaded or refused";
    if (loaded.ok) return static_cast<int>(loaded.table.size()) == expected.terms ? "" : "number of terms";
    if (refusal_of(loaded.fault.error) != expected.refusal) return "reason of the refusal";
    return loaded.fault.term == expected.term ? "" : "term of the refusal";
}

bool same(const State& state, const naive::Sequencer& naive) {
    return state.step == naive.step && state.outputs == naive.outputs && state.timer == naive.timer &&
           state.counter == naive.counter;
}

bool same(const MotorOrder& order, const naive::Order& naive) {
    if (order.is_register_write != naive.flex) return false;
    if (!order.is_register_write) return order.command == naive.number && order.value == 0;
    return order.reg == naive.number && order.longword == naive.longword && order.value == naive.value;
}

bool same(const Orders& orders, const std::vector<naive::Order>& naive) {
    return std::ranges::equal(orders, naive, [](const auto& a, const auto& b) { return same(a, b); });
}

std::string text(const State& s) {
    return "step " + std::to_string(s.step) + " outputs " + std::to_string(s.outputs) + " timer " +
           std::to_string(s.timer) + " counter " + std::to_string(s.counter);
}

class Duel {
  public:
    Duel(const Table& table, naive::Sequencer naive, Dice& dice, Seen& seen)
        : table_(table), naive_(std::move(naive)), engine_(table), dice_(dice), seen_(seen) {}

    std::string run(int scans) {
        for (int i = 0; i < scans; ++i) {
            if (dice_.one_in(8)) restore();
            if (!dice_.one_in(3)) image_ = random_image();
            const std::string difference = scan();
            if (!difference.empty()) {
                return difference + "\n  scan " + std::to_string(i) + ", HW_INP " + std::to_string(image_) +
                       "\n  before: " + text(before_) + "\n  naive:  " + naive_.text() +
                       "\n  engine: " + text(engine_.state());
            }
        }
        return {};
    }

  private:
    InputImage random_image() {
        const InputImage image = dice_.byte() & 0x7F;
        return dice_.one_in(8) ? static_cast<InputImage>(image | 0x80) : image;
    }

    std::uint16_t small_or_any() {
        return static_cast<std::uint16_t>(dice_.one_in(2) ? dice_.below(4) : dice_.below(65536));
    }

    void restore() {
        State state;
        state.step = static_cast<std::uint8_t>(table_.empty() || dice_.one_in(16)
                                                   ? dice_.below(63)
                                                   : table_.term(dice_.below(size()))[0] & 0x3F);
        state.outputs = dice_.byte() & 0x0F;
        state.timer = small_or_any();
        state.counter = small_or_any();
        engine_.restore(state);
        naive_.step = state.step;
        naive_.outputs = state.outputs;
        naive_.timer = state.timer;
        naive_.counter = state.counter;
    }

    unsigned size() const { return static_cast<unsigned>(table_.size()); }

    std::string scan() {
        before_ = engine_.state();
        ++seen_.scans;
        const std::vector<naive::Order> expected = naive_.scan(image_);
        note(expected);
        if (std::string difference = check_conditions(); !difference.empty()) return difference;

        std::uint32_t halted_ms = 0;
        Orders orders;
        const ScanEffect effect =
            dice_.one_in(2) ? engine_.scan(image_, [&](const MotorOrder& order) { orders.push_back(order); })
                            : halting_scan(orders, halted_ms);
        if (!naive_.timer_was_preset) naive_.adjust_timer(halted_ms);
        if (!same(orders, expected)) return "orders of Engine";
        if (!same(engine_.state(), naive_)) return "state of Engine after the scan";
        if (std::string d = check_effect(effect, expected.size(), halted_ms); !d.empty()) return d;

        const std::uint32_t ms = dice_.one_in(4) ? dice_.below(70'000) : dice_.below(3);
        engine_.elapse(ms);
        naive_.adjust_timer(ms);
        return same(engine_.state(), naive_) ? "" : "state after the time that passed";
    }

    /// The scan in its single steps; a third of them halt between orders for up to 3 ms each, as a full queue
    /// makes them do.
    ScanEffect halting_scan(Orders& orders, std::uint32_t& halted_ms) {
        const bool halts = dice_.one_in(3);
        engine_.begin(image_);
        while (const auto order = engine_.next()) {
            orders.push_back(*order);
            const std::uint32_t ms = halts ? dice_.below(4) : 0;
            engine_.elapse(ms);
            halted_ms += ms;
        }
        return engine_.finish();
    }

    void note(const std::vector<naive::Order>& expected) {
        if (!naive_.true_terms.empty()) ++seen_.fired;
        if (naive_.true_terms.size() > 1) ++seen_.several_true;
        seen_.orders += expected.size();
    }

    std::string check_conditions() const {
        for (unsigned i = 0; i < size(); ++i) {
            const sequencer::TermView term = table_.term(i);
            const bool fires = sequencer::step_of(term) == before_.step &&
                               sequencer::is_true(term, sequencer::key_of(image_, before_));
            const bool fired = std::ranges::count(naive_.true_terms, static_cast<int>(i)) == 1;
            if (fires != fired) return "the condition of term " + std::to_string(i);
        }
        return {};
    }

    std::string check_effect(const ScanEffect& effect, std::size_t orders, std::uint32_t halted_ms) {
        State unscanned = before_;
        sequencer::elapse(unscanned, halted_ms);
        const bool changed = naive_.timer_was_preset || !same(unscanned, naive_);
        if (effect.changed != changed) return "ScanEffect::changed";
        if (effect.sent != (orders != 0)) return "ScanEffect::sent";
        if (effect.timer_preset != naive_.timer_was_preset) return "ScanEffect::timer_preset";
        if (effect.any() || halted_ms != 0) return {};
        return check_idle_repeat();
    }

    /// The same key again, with whatever the timer still has: nothing may happen.
    std::string check_idle_repeat() {
        ++seen_.idle_repeats;
        State state = before_;
        if (state.timer != 0) state.timer = static_cast<std::uint16_t>(1 + dice_.below(65535));
        Engine again(table_);
        again.restore(state);
        bool sent = false;
        const ScanEffect effect = again.scan(image_, [&](const MotorOrder&) { sent = true; });
        const bool idle = !sent && !effect.any() && again.state() == state;
        return idle ? "" : "a repeat of a scan without effect";
    }

    const Table& table_;
    naive::Sequencer naive_;
    Engine engine_;
    Dice& dice_;
    Seen& seen_;
    InputImage image_ = 0;
    State before_;
};

std::string hex(const std::vector<std::uint8_t>& bytes) {
    static constexpr char kDigits[] = "0123456789ABCDEF";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        out += i % 8 == 0 ? "\n    " : " ";
        out += kDigits[bytes[i] / 16];
        out += kDigits[bytes[i] % 16];
    }
    return out;
}

}  // namespace

std::string duel(Shape shape, std::uint64_t seed, int scans, Seen& seen) {
    Dice dice(seed);
    const std::vector<std::uint8_t> bytes = random_table(shape, dice);
    const auto loaded = Table::load(bytes);
    std::string difference = compare_load(naive::judge(bytes, 1024), loaded);
    if (difference.empty() && !loaded.ok) {
        ++seen.refused;
        return {};
    }
    if (difference.empty()) {
        Duel one(loaded.table, naive::Sequencer(bytes), dice, seen);
        difference = one.run(scans);
    }
    if (difference.empty()) return {};
    return "seed " + std::to_string(seed) + ": " + difference + "\n  table:" + hex(bytes);
}

}  // namespace nplc::property
