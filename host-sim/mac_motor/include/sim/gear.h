#pragma once

#include <cstdint>

namespace nplc::sim {

/// Electronic gearing (001 §4.1.3, §4.1.12): how far the profile is behind the pulse input, G_FNC, in 1/16
/// counts, negative while it has that much to go.
class Gear {
  public:
    void reset() { *this = {}; }

    static constexpr std::int32_t kOne = 0x10000;

    /// One sample's pulses times GEARF1 / GEARF2 times `factor` / 65536, in 1/16 counts. R: the remainder is
    /// kept for the next sample as long as GEARF2 stays; GEARF2 = 0 gives nothing.
    std::int64_t scale(std::int32_t v_ext, std::int32_t gearf1, std::int32_t gearf2,
                       std::int32_t factor = kOne);
    /// So much more is to be followed. G_FNC stays within 2^44.
    void take(std::int64_t counts_16);
    /// The profile went `fnc_out` in this sample, torque correction included.
    void went(std::int32_t fnc_out) { g_fnc_ += fnc_out; }

    /// For a block that knows its target itself.
    void stand_at(std::int64_t g_fnc) { g_fnc_ = g_fnc; }

    std::int64_t g_fnc() const { return g_fnc_; }

  private:
    std::int64_t g_fnc_ = 0;
    std::int64_t remainder_ = 0;  // 1/GEARF2/65536 of 1/16 counts
    std::int32_t divisor_ = 1;
};

/// 001 §4.1.3: all that is missing in one sample, within `limit` >= 0 and `acceleration`. Follows without a
/// lag, and overshoots when the pulses stop suddenly. (The Gear Position block of §4.1.12 is position_block
/// towards -G_FNC.)
std::int32_t gear_follow_block(std::int64_t g_fnc, std::int32_t v_old, std::int32_t limit,
                               std::int32_t acceleration);

}  // namespace nplc::sim
