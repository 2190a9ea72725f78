#pragma once

#include <deque>
#include <vector>

#include "sim/fastmac_slave.h"
#include "sim/snapshot.h"

namespace nplc::sim {

/// What the sequence ordered against what the motor executed. Left out on both sides: what only concerns the
/// link (NOP, 0Ah, 0Bh, 13h, 1Dh, 1Eh, 1Fh) and MODE_REG := 0, with which the gateway stops the motor by
/// itself.
struct OrderAudit {
    std::vector<SentOrder> missing;    ///< ordered and not executed
    std::vector<SentOrder> unordered;  ///< executed and not ordered
};

OrderAudit audit(const std::vector<SentOrder>& ordered, const std::deque<Order>& executed);

}  // namespace nplc::sim
