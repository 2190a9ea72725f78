#pragma once

#include <algorithm>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "host/byte_client.h"
#include "sim/serial_line.h"

namespace nplc::mactalk_client {

/// What hangs on the other end of a SimWire.
class Unit {
  public:
    virtual ~Unit() = default;
    virtual void receive(std::uint8_t byte, bool framing_error, base::Instant now) = 0;
    virtual std::optional<std::uint8_t> transmit(base::Instant now) = 0;
    virtual void poll(base::Instant /*now*/) {}
};

/// A line in virtual time that loses and damages characters. The unit is polled every 250 us and after each
/// character.
class SimWire final : public host::ByteClient {
  public:
    SimWire(Unit& unit, std::uint32_t baud, std::uint64_t seed)
        : unit_(unit), to_unit_(baud, seed), from_unit_(baud, seed + 1) {}

    const std::string& name() const override { return name_; }
    bool write(std::span<const std::uint8_t> bytes) override {
        waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
        sent_.insert(sent_.end(), bytes.begin(), bytes.end());
        return true;
    }
    std::optional<std::size_t> read(std::span<std::uint8_t> out, base::Microseconds wait) override {
        const sim::Time end = now_ + wait;
        settle();
        while (received_.empty() && now_ < end) step(end);
        const std::size_t count = std::min(out.size(), received_.size());
        std::copy_n(received_.begin(), count, out.begin());
        received_.erase(received_.begin(), received_.begin() + static_cast<std::ptrdiff_t>(count));
        return count;
    }
    base::Instant now() const override {
        return base::Instant{std::chrono::duration_cast<base::Microseconds>(now_)};
    }

    void set_faults(const sim::LineFaults& faults) {
        to_unit_.set_faults(faults);
        from_unit_.set_faults(faults);
    }
    sim::LineDirection& to_unit() { return to_unit_; }
    sim::LineDirection& from_unit() { return from_unit_; }
    const std::vector<std::uint8_t>& sent() const { return sent_; }

  private:
    static constexpr sim::Time kPoll = std::chrono::microseconds{250};

    void step(sim::Time end) {
        sim::Time next = std::min(end, next_poll_);
        const auto consider = [&](std::optional<sim::Time> time) {
            if (time) next = std::min(next, *time);
        };
        consider(to_unit_.next_arrival());
        consider(from_unit_.next_arrival());
        if (!waiting_.empty()) consider(to_unit_.busy_until());
        now_ = std::max(now_, next);
        settle();
    }

    /// All that happens now.
    void settle() {
        if (!waiting_.empty() && to_unit_.free(now_)) {
            to_unit_.start(waiting_.front(), now_);
            waiting_.pop_front();
        }
        while (const auto byte = to_unit_.take(now_)) {
            unit_.receive(byte->value, byte->framing_error, now());
            next_poll_ = now_;
        }
        while (const auto byte = from_unit_.take(now_)) {
            if (!byte->framing_error) received_.push_back(byte->value);
        }
        if (now_ >= next_poll_) {
            unit_.poll(now());
            next_poll_ = now_ + kPoll;
        }
        if (!from_unit_.free(now_)) return;
        if (const auto byte = unit_.transmit(now())) from_unit_.start(*byte, now_);
    }

    Unit& unit_;
    sim::LineDirection to_unit_;
    sim::LineDirection from_unit_;
    std::string name_ = "sim:line";
    sim::Time now_{0};
    sim::Time next_poll_{0};
    std::deque<std::uint8_t> waiting_;
    std::deque<std::uint8_t> received_;
    std::vector<std::uint8_t> sent_;
};

}  // namespace nplc::mactalk_client
