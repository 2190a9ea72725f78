#pragma once

#include "seqc/seqc.h"
#include "sim/snapshot.h"

namespace nplc::rehearsal {

/// Converts a program's symbols for the simulator.
sim::Names names_of(const seqc::Symbols& symbols);

}  // namespace nplc::rehearsal
