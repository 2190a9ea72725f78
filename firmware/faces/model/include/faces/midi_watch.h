#pragma once

#include <cstdint>
#include <optional>

#include "base/time.h"
#include "causes/midi_why.h"
#include "motor/any_driver.h"

namespace nplc::faces {

/// State of a MIDI drive from its driver, for the causes of a standstill.
class MidiWatch {
  public:
    /// Empty: another kind of driver.
    std::optional<causes::MidiState> look(const motor::AnyDriver& driver, base::Instant wall);

  private:
    base::Instant looked_{base::Microseconds(INT64_MIN / 2)};
    std::int32_t place_ = 0;  ///< increments
    base::Instant moved_{};   ///< last change of position
    base::Instant idle_{};    ///< last time it was not busy
};

}  // namespace nplc::faces
