#pragma once

#include <string>

#include "compiler/model.h"
#include "registers/family.h"
#include "sequencer/term.h"

/// The capabilities of a program's drive: registers/family.h in the compiler's types.
namespace nplc::seqc {

/// Why the drive cannot execute an order by itself, independent of others.
registers::Refusal refusal_of(const registers::DriveModel& drive, const Send& send);
registers::Refusal refusal_of(const registers::DriveModel& drive, const sequencer::Term& term);
/// In the drive's units: "period 32", "120000 increments".
std::string text_of(const registers::DriveValue& value);

}  // namespace nplc::seqc
