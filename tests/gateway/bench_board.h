#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "gateway/gateway.h"

namespace nplc::gateway {

/// A board whose pins and motor are the test's own variables. Starts at a time other than 0.
struct BenchBoard final : ports::DigitalInputs,
                          ports::DigitalOutputs,
                          ports::Watchdog,
                          motor::Motor,
                          Observer {
    std::uint8_t read() override { return in; }
    void write(std::uint8_t levels) override {
        out = levels;
        out_since = now;
        ++writes;
    }
    void feed() override { ++feeds; }

    void poll(base::Instant) override { ++polls; }
    void begin_orders(base::Instant) override { begun = sent.size() + static_cast<std::size_t>(stops); }
    bool orders_complete() const override { return is_settled; }
    bool has_room() const override { return room != 0; }
    bool can_execute(const motor::Order& order) const override { return order.reg != missing_register; }
    void send(const motor::Order& order) override {
        sent.push_back(order);
        if (room > 0) --room;
    }
    void stop() override {
        ++stops;
        stop_confirmed_at = now + stop_takes;
    }
    bool stop_confirmed() const override { return stop_is_confirmed && now >= stop_confirmed_at; }
    void give_up_stop() override { stop_is_confirmed = true; }
    bool begin_access(const motor::Access& wanted) override {
        if (!motor::link_is_usable(link_state)) return false;
        if (access != motor::AccessState::none && access != motor::AccessState::done &&
            access != motor::AccessState::failed)
            return false;
        accesses.push_back(wanted);
        access = access_answers;
        if (access == motor::AccessState::done) ++motor_counters.accesses;
        if (access == motor::AccessState::failed) ++motor_counters.access_fails;
        return true;
    }
    motor::AccessState access_state() const override { return access; }
    std::uint32_t access_value() const override {
        const auto found = motor_registers.find(accesses.back().reg);
        return found == motor_registers.end() ? 0 : found->second;
    }
    void drop_access() override { access = motor::AccessState::none; }
    motor::Counters counters() const override { return motor_counters; }
    bool longwords_only() const override { return is_mac800; }
    bool in_position() const override { return in_pos; }
    bool error() const override { return err || link_state != motor::Link::up; }
    std::uint8_t fault_number() const override { return fault; }
    motor::Link link() const override { return link_state; }

    void ordered(base::Instant, const sequencer::MotorOrder&) override { ++orders_seen; }
    void scanned(base::Instant, const sequencer::State& before, sequencer::InputImage image,
                 const sequencer::State& after) override {
        scans_seen.push_back({before, image, after});
    }

    Gateway::Ports ports() { return {*this, *this, *this, *this}; }

    /// Polls every 250 us.
    void run(Gateway& gateway, base::Microseconds duration) {
        const auto end = now + duration;
        while (now < end) {
            now += base::Microseconds(250);
            poll(now);
            gateway.poll(now);
        }
    }

    struct Scan {
        sequencer::State before;
        sequencer::InputImage image;
        sequencer::State after;
    };

    base::Instant now{base::Milliseconds(1234)};
    std::uint8_t in = 0;
    std::uint8_t out = 0xFF;
    base::Instant out_since{};
    int writes = 0;
    int feeds = 0;
    int stops = 0;
    int polls = 0;          ///< of the motor
    std::size_t begun = 0;  ///< orders and stops given when begin_orders() was called last
    int room = 8;
    int missing_register = -1;
    int orders_seen = 0;
    bool is_settled = true;
    bool stop_is_confirmed = true;
    base::Microseconds stop_takes{};  ///< from each stop() to its confirmation
    base::Instant stop_confirmed_at{};
    bool in_pos = false;
    bool err = false;
    std::uint8_t fault = 0;
    motor::Link link_state = motor::Link::up;
    std::vector<motor::Order> sent;
    motor::AccessState access = motor::AccessState::none;
    motor::AccessState access_answers = motor::AccessState::done;  ///< at once
    std::vector<motor::Access> accesses;
    std::map<int, std::uint32_t> motor_registers;
    motor::Counters motor_counters;
    bool is_mac800 = false;
    std::vector<Scan> scans_seen;
};

using namespace std::chrono_literals;

/// A table written down byte by byte; STATE C0h: neither timer nor counter is looked at.
class Bytes {
  public:
    Bytes(std::initializer_list<sequencer::TermBytes> terms) {
        for (const auto& term : terms) bytes_.insert(bytes_.end(), term.begin(), term.end());
        bytes_.insert(bytes_.end(), {0x3F, 0, 0, 0, 0, 0, 0, 0});
    }
    operator std::span<const std::uint8_t>() const { return bytes_; }  // NOLINT: as the call takes it

  private:
    std::vector<std::uint8_t> bytes_;
};

}  // namespace nplc::gateway
