#pragma once

#include <cstdint>
#include <optional>

#include "base/time.h"
#include "causes/midi_why.h"
#include "motor/any_driver.h"

namespace nplc::faces {

/// A MIDI drive as its driver has it, for who asks why it does not move.
class MidiWatch {
  public:
    /// Nothing: the driver is another one.
    std::optional<causes::MidiState> look(const motor::AnyDriver& driver, base::Instant wall);

  private:
    base::Instant looked_{base::Microseconds(INT64_MIN / 2)};
    std::int32_t place_ = 0;  ///< increments
    base::Instant moved_{};   ///< it was elsewhere until then
    base::Instant idle_{};    ///< it was last seen not to be busy
};

}  // namespace nplc::faces
