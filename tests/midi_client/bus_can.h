#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/can_client.h"
#include "sim/midi_ends.h"

namespace nplc::midi_client {

/// Virtual modules on a CAN bus of 125 kbit/s in virtual time, from a master's end.
class BusCan final : public host::CanClient {
  public:
    using Frame = base::CanFrame;

    explicit BusCan(const std::vector<std::uint8_t>& addresses,
                    registers::midi::Model model = registers::midi::Model::mac34_1)
        : bus_(125'000) {
        for (const std::uint8_t address : addresses)
            modules.emplace_back(model, sim::MidiOptions{.can = true, .address = address});
        for (sim::MidiModule& module : modules) ends_.emplace_back(module);
    }

    const std::string& name() const override { return name_; }
    bool write(const ports::CanFrame& frame) override {
        sent.push_back(frame);
        bus_.send(frame, kMaster);
        return takes;
    }
    std::optional<ports::CanFrame> read(base::Microseconds wait) override {
        const sim::Time end = now_ + wait;
        settle();
        while (received_.empty() && now_ < end) {
            now_ = std::min({end, now_ + std::chrono::microseconds{250}, bus_.next_event().value_or(end)});
            settle();
        }
        if (received_.empty()) return std::nullopt;
        const Frame frame = received_.front();
        received_.pop_front();
        return frame;
    }
    ports::CanState state() override { return state_now; }
    bool gone() const override { return false; }
    base::Instant now() const override {
        return base::Instant{std::chrono::duration_cast<base::Microseconds>(now_)};
    }

    std::deque<sim::MidiModule> modules;
    std::vector<ports::CanFrame> sent;
    std::function<bool(std::size_t module, const Frame&)> loses{};  ///< true: the module does not receive it
    std::function<void()> on_step{};
    /// The master receives it, whichever node sent it.
    void tell(const Frame& frame) { received_.push_back(frame); }
    std::function<bool(const Frame&)> master_misses{};
    bool takes = true;
    ports::CanState state_now = ports::CanState::active;

  private:
    static constexpr int kMaster = -1;

    void settle() {
        for (sim::MidiModule& module : modules) module.advance(now_);
        while (const auto heard = bus_.take(now_)) {
            for (std::size_t i = 0; i < ends_.size(); ++i) {
                const bool own = heard->sender == static_cast<int>(i);
                if (!own && !(loses && loses(i, heard->frame))) ends_[i].receive(heard->frame);
            }
            if (heard->sender != kMaster && !(master_misses && master_misses(heard->frame)))
                received_.push_back(heard->frame);
        }
        for (std::size_t i = 0; i < ends_.size(); ++i) {
            while (const auto frame = ends_[i].transmit()) bus_.send(*frame, static_cast<int>(i));
        }
        if (on_step) on_step();
    }

    std::string name_ = "can:sim";
    sim::CanBus bus_;
    std::deque<sim::MidiCanEnd> ends_;
    std::deque<Frame> received_;
    sim::Time now_{0};
};

}  // namespace nplc::midi_client
