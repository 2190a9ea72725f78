#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "host/byte_client.h"
#include "midi_rack.h"

namespace nplc::midi_client {

/// Virtual modules on a serial line in virtual time, from the client's end.
class RackWire final : public host::ByteClient {
  public:
    explicit RackWire(const std::vector<sim::MidiUnit>& units) : rack(units, 0) {}

    const std::string& name() const override { return name_; }
    bool write(std::span<const std::uint8_t> bytes) override {
        sent.emplace_back(bytes.begin(), bytes.end());
        if (on_write) on_write();
        rack.send(bytes);
        return true;
    }
    std::optional<std::size_t> read(std::span<std::uint8_t> out, base::Microseconds wait) override {
        const sim::Time end = rack.now() + wait + hold_back;
        take();
        while (received_.empty() && rack.now() < end) {
            rack.advance(std::min(end, rack.now() + std::chrono::microseconds{250}));
            if (on_step) on_step();
            take();
        }
        const std::size_t count = std::min(out.size(), received_.size());
        std::copy_n(received_.begin(), count, out.begin());
        received_.erase(received_.begin(), received_.begin() + static_cast<std::ptrdiff_t>(count));
        return count;
    }
    base::Instant now() const override {
        return base::Instant{std::chrono::duration_cast<base::Microseconds>(rack.now())};
    }

    sim::MidiRack rack;
    std::vector<std::vector<std::uint8_t>> sent;
    std::function<void()> on_write{};  ///< before each message
    std::function<void()> on_step{};   ///< after each 250 us
    sim::Time hold_back{0};

  private:
    void take() {
        const auto bytes = rack.received();
        received_.insert(received_.end(), bytes.begin(), bytes.end());
    }

    std::string name_ = "sim:line";
    std::deque<std::uint8_t> received_;
};

}  // namespace nplc::midi_client
