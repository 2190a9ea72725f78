#pragma once

#include <bitset>

#include "host/can_client.h"
#include "midi_client/link.h"
#include "protocol/midi_can.h"

namespace nplc::midi_client {

struct CanOptions {
    base::Microseconds patience{150'000};
    base::Microseconds longest_boot{3'000'000};  ///< R: 000 §VI 00h has two seconds
};

/// 003 §V. Frames of other nodes are discarded.
class CanLink final : public Link {
  public:
    explicit CanLink(host::CanClient& can, const CanOptions& options = {}) : can_(can), options_(options) {}

    const std::string& name() const override { return can_.name(); }
    bool is_can() const override { return true; }
    Answer ask(const Request& request) override;
    Answer synchronise() override;
    std::uint8_t everyone() const override { return protocol::midi_can::kGeneral; }
    std::uint8_t usual_address() const override { return 1; }
    /// Two frames of eight bytes at 125 kbit/s.
    base::Microseconds exchange_time() const override { return base::Microseconds{2'000}; }
    void pause(base::Microseconds time) override;
    base::Instant now() override { return can_.now(); }
    std::string last_sent() const override { return sent_; }
    std::string last_heard() const override { return heard_; }
    bool take_boot(std::uint8_t address) override;
    bool take_foreign_sync() override;
    bool heard_anything() const override { return heard_any_; }

    /// The whole LMT procedure (003 §V.5) with the only module on the bus; true when it has booted with the
    /// new address. `refused`: it refused the address. `several`: more than one answered, so the procedure
    /// was cancelled: none has the new address, and all stay in configuration until they are switched off.
    enum class Programmed : std::uint8_t { done, refused, silence, several };
    Programmed program_address(std::uint8_t address);

  private:
    void send(const protocol::midi_can::Request& request);
    protocol::midi_can::Answer hear(base::Microseconds wait);
    void drain();
    protocol::midi_can::Answer take(const ports::CanFrame& frame);

    host::CanClient& can_;
    CanOptions options_;
    std::string sent_;
    std::string heard_;
    std::bitset<protocol::midi_can::kMaxAddress + 1U> boots_;  ///< received, by address
    bool heard_any_ = false;
    bool foreign_sync_ = false;
};

}  // namespace nplc::midi_client
