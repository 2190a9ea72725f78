#include "motor/jvl_blind_stop.h"

#include "registers/mac.h"

namespace nplc::motor {
namespace {

constexpr std::uint8_t kWayBack = 3;

}  // namespace

protocol::flexmac::Encoded BlindStop::take_part(bool longword, base::Instant now) {
    if (part_ == 0) due_ = now + pace_.next();
    const std::uint8_t part = part_++;
    if (part == 0) return {.bytes = {0x7F, 0x7F, 0xFF, 0xFF}, .size = 4};
    if (part == kWayBack) return protocol::flexmac::encode(protocol::flexmac::kUseFastMac);
    if (part > kWayBack) {
        part_ = 0;
        return {};
    }
    return protocol::flexmac::encode({.longword = longword,
                                      .level = protocol::flexmac::Level::reg,
                                      .target = registers::MODE_REG,
                                      .value = 0});
}

}  // namespace nplc::motor
