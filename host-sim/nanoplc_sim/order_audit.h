#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "protocol/fastmac.h"
#include "sim/fastmac_slave.h"
#include "sim/snapshot.h"

namespace nplc::sim {

/// What the sequence ordered against what the motor executed. Left out on both sides: what only concerns the
/// link (NOP, 0Ah, 0Bh, 13h, 1Dh, 1Eh, 1Fh) and MODE_REG := 0, with which the gateway stops the motor by
/// itself.
struct OrderAudit {
    std::vector<SentOrder> missing;    ///< ordered and not executed
    std::vector<SentOrder> under_way;  ///< ordered and not executed yet
    std::vector<SentOrder> unordered;  ///< executed and not ordered
};

/// `on_their_way`: places in `ordered`, ascending, of what the driver has not finished. `code`: the register
/// code that the motor executed its commands by; the sequence's is the format list's.
OrderAudit audit(const std::vector<SentOrder>& ordered, const std::deque<Order>& executed,
                 const std::deque<std::size_t>& on_their_way = {},
                 protocol::fastmac::RegisterCode code = protocol::fastmac::RegisterCode::format_list);

}  // namespace nplc::sim
