#pragma once

#include "causes/commands.h"
#include "causes/finding.h"
#include "causes/midi_why.h"
#include "causes/modes.h"
#include "causes/snapshot.h"
#include "causes/texts.h"
#include "causes/why.h"

/// What macreg shares with the gateway's faces (firmware/causes).
namespace nplc::macreg {

using namespace causes;

}  // namespace nplc::macreg
