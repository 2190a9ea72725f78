#pragma once

#include <string>

#include "seqc/seqc.h"
#include "views/machine.h"

namespace nplc::seqc {

/// What a step does in one case, said so that two tables can be compared.
struct Deed {
    int next_id = -1;  ///< of the step that follows, the same for both tables; -1 while it stays
    std::string next;  ///< its name
    std::vector<sequencer::MotorOrder> orders;
    std::uint16_t timer = 0;
    CounterChange counter = CounterChange::none;
    std::uint16_t counter_preset = 0;
    KnownOutputs outputs;           ///< where two tables differ and the steps themselves do not settle it
    std::uint8_t kept_outputs = 0;  ///< those of them that have no certain value
    bool operator==(const Deed& other) const;
};

/// The deed of an outcome in case `c`, without the step that follows. What changes nothing when the counter
/// is zero is left out.
Deed deed_of(const Outcome& outcome, std::size_t c);

/// "sends STOP and goes to Fault"; "nothing".
std::string text_of(const Deed& deed, const Symbols* symbols);

}  // namespace nplc::seqc
