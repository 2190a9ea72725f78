#pragma once

#include "registers/vocabulary.h"

namespace nplc::gateway {

using registers::gateway::Event;
using registers::gateway::Origin;
using registers::gateway::Result;
using registers::gateway::RunState;
using registers::gateway::SafeReason;
using registers::gateway::SetPointRequest;

}  // namespace nplc::gateway
