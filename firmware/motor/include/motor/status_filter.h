#pragma once

#include <cstdint>

#include "protocol/fastmac.h"

namespace nplc::motor {

/// Accepts a status byte only when it is received twice in a row: one byte has no redundancy.
class StatusFilter {
  public:
    void receive(std::uint8_t byte) {
        if (has_previous_ && byte == previous_) {
            status_ = protocol::fastmac::decode_status(byte);
            known_ = true;
            ++confirmed_;
        }
        previous_ = byte;
        has_previous_ = true;
    }
    void break_pair() { has_previous_ = false; }
    void forget() { known_ = has_previous_ = false; }

    bool known() const { return known_; }
    std::uint32_t confirmed() const { return confirmed_; }               ///< pairs received
    const protocol::fastmac::Status& status() const { return status_; }  ///< needs known()

  private:
    protocol::fastmac::Status status_;
    std::uint8_t previous_ = 0;
    std::uint32_t confirmed_ = 0;
    bool has_previous_ = false;
    bool known_ = false;
};

}  // namespace nplc::motor
