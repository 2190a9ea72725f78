#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>

#include "sequencer/engine.h"
#include "variables.h"

/// The four ways to run one logic. Each takes an image and lets 1 ms pass; all hand their orders to the same
/// Sink.
namespace nplc::bench {

/// Remembers what it was given, in order, in one number.
struct Sink {
    std::uint64_t hash = 0;
    void operator()(const MotorOrder& order) {
        hash = hash * 31 + (order.is_register_write ? 65536U * order.reg + order.value : order.command);
    }
};

template <class Code>
class SwitchMachine {
  public:
    void scan(std::uint8_t image) {
        Code::scan(state_, image, sink_);
        sequencer::elapse(state_, 1);
    }
    const State& state() const { return state_; }
    std::uint64_t hash() const { return sink_.hash; }

  private:
    State state_;
    Sink sink_;
};

/// IEC ST, compiled.
template <class Code>
class CaseMachine {
  public:
    void scan(std::uint8_t image) {
        inputs_ = kSpread[image];
        Code::scan(vars_, inputs_, sink_);
        if (vars_.timer != 0) --vars_.timer;
    }
    State state() const {
        const auto& out = vars_.out;
        return {.step = static_cast<std::uint8_t>(vars_.step),
                .outputs = static_cast<std::uint8_t>(out[0] | out[1] << 1 | out[2] << 2 | out[3] << 3),
                .timer = vars_.timer,
                .counter = vars_.counter};
    }
    std::uint64_t hash() const { return sink_.hash; }

  private:
    Variables vars_;
    Bools inputs_{};
    Sink sink_;
};

/// All terms of the table in each scan, as 001 §6.1.9 reads.
class WalkMachine {
  public:
    explicit WalkMachine(std::span<const std::uint8_t> bytes) : bytes_(bytes.data()) {}
    void scan(std::uint8_t image) {
        const sequencer::Key key = sequencer::key_of(image, state_);
        sequencer::Pending pending;
        for (const std::uint8_t* at = bytes_; (at[0] & 0x3F) != 0x3F; at += 8) {
            if ((at[0] & 0x3F) != state_.step) continue;
            const sequencer::TermView term(at, 8);
            if (!sequencer::is_true(term, key)) continue;
            const bool is_flex = (term[2] & 0x80) != 0;
            if (!is_flex) pending.fold(term);
            if (is_flex || (term[4] & 0x80) == 0) sink_(sequencer::order_of(term));
        }
        apply(pending, state_);
        sequencer::elapse(state_, 1);
    }
    const State& state() const { return state_; }
    std::uint64_t hash() const { return sink_.hash; }

  private:
    const std::uint8_t* bytes_;
    State state_;
    Sink sink_;
};

class InPlaceMachine {
  public:
    explicit InPlaceMachine(const sequencer::Table& table) : engine_(table) {}
    void scan(std::uint8_t image) {
        engine_.scan(image, sink_);
        engine_.elapse(1);
    }
    const State& state() const { return engine_.state(); }
    std::uint64_t hash() const { return sink_.hash; }

  private:
    sequencer::Engine engine_;
    Sink sink_;
};

class Loaded {
  public:
    explicit Loaded(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
        const auto loaded = sequencer::Table::load(bytes);
        if (!loaded.ok) throw std::runtime_error("the generated table is refused");
        table_ = loaded.table;
    }
    Loaded(const Loaded&) = delete;
    Loaded& operator=(const Loaded&) = delete;

    WalkMachine walk() const { return WalkMachine(bytes_); }
    InPlaceMachine in_place() const { return InPlaceMachine(table_); }

  private:
    std::span<const std::uint8_t> bytes_;
    sequencer::Table table_;
};

}  // namespace nplc::bench
