#pragma once

#include "seqc/seqc.h"
#include "sim/snapshot.h"

namespace nplc::rehearsal {

/// What a program's symbols are to the simulator.
sim::Names names_of(const seqc::Symbols& symbols);

}  // namespace nplc::rehearsal
