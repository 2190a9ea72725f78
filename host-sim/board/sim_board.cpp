#include "sim/sim_board.h"

#include <utility>

namespace nplc::sim {

void SimBoard::set_input(unsigned index, bool level) {
    const auto bit = static_cast<std::uint8_t>(1U << index);
    inputs_ = static_cast<std::uint8_t>(level ? inputs_ | bit : inputs_ & ~bit);
}

bool SimBoard::watchdog_bites(base::Instant now) {
    if (std::exchange(fed_, false)) last_fed_ = now;
    if (!last_fed_ || now - *last_fed_ <= watchdog_time_) return false;
    last_fed_.reset();
    ++bites_;
    return true;
}

}  // namespace nplc::sim
