#pragma once

#include <vector>

#include "midi_client/link.h"

namespace nplc::midi_client {

struct V24Options {
    std::uint32_t baud = 38'400;  ///< what messages take on the line; sockets are taken to be as slow
    /// Beyond the time that request and answer take on the line.
    base::Microseconds patience{150'000};
};

/// 000 §II to §IV. What belongs to no answer is read over; after a request without a clear answer the line
/// must have been silent for `patience` before the next one, for an answer does not say whose it is.
class V24Link final : public Link {
  public:
    explicit V24Link(host::ByteClient& wire, const V24Options& options = {});

    const std::string& name() const override { return line_.name(); }
    bool is_can() const override { return false; }
    Answer ask(const Request& request) override;
    Answer synchronise() override;
    std::uint8_t everyone() const override { return 0xFF; }
    std::uint8_t usual_address() const override { return 0; }
    base::Microseconds exchange_time() const override;
    void pause(base::Microseconds time) override { line_.pause(time); }
    base::Instant now() override { return line_.now(); }
    std::string last_sent() const override;
    std::string last_heard() const override;
    bool heard_anything() const override { return line_.heard_anything(); }

  private:
    void count_answers(std::span<const std::uint8_t> bytes);

    mactalk_client::Line line_;
    std::vector<std::uint8_t> sent_;
    std::vector<std::uint8_t> heard_;
    std::uint8_t asked_ = 0;  ///< last
};

}  // namespace nplc::midi_client
