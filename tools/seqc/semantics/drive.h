#pragma once

#include <string>

#include "registers/family.h"
#include "semantics/model.h"
#include "sequencer/term.h"

/// What the drive of a program can do: registers/family.h, in the compiler's terms.
namespace nplc::seqc {

/// Why the drive cannot do what goes to the motor, as far as it tells alone.
registers::Refusal refusal_of(const registers::DriveModel& drive, const Send& send);
registers::Refusal refusal_of(const registers::DriveModel& drive, const sequencer::Term& term);
/// In the drive's own terms: "period 32", "120000 increments".
std::string text_of(const registers::DriveValue& value);

}  // namespace nplc::seqc
