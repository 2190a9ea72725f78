#pragma once

#include <cstdint>

#include "registers/mac.h"

namespace nplc::sim {

/// How a generator speaks to the pulse input (001 §3.2.36, PULSEDIR).
enum class PulseFormat : std::uint8_t {
    quadrature,           ///< four counts a period of its lines
    pulse_and_direction,  ///< one count a pulse
};

/// What the pulse input's pins are set to at power-up (001 §3.2.36 bits 0 to 4; 004 HW_SETUP).
class PulseInput {
  public:
    /// R: MAC800 (004 gives names only): XPRINP is PULSEDIR, INVXDIR is INPSIGN, NOFILT is HICLK; the input
    /// is always there.
    void configure(registers::Model model, std::int32_t cntrl_bits, std::int32_t hw_setup);

    bool on() const { return on_; }
    /// Counts of V_EXT for each count of the generator: this over four, with the sign. 0: none arrive.
    /// R: above the filter's frequency nothing passes; quadrature on an input for pulses counts one edge of
    /// four, pulses on one for quadrature count to and fro.
    int quarters(PulseFormat generator, std::int64_t counts_per_second) const;

  private:
    bool on_ = false;
    bool inverted_ = false;
    bool fast_ = false;
    PulseFormat format_ = PulseFormat::quadrature;
};

}  // namespace nplc::sim
