#pragma once

#include <optional>

#include "gateway/event_log.h"
#include "gateway/forced_io.h"
#include "log_messages.h"

namespace nplc::boards {

/// The journal's messages on forces: the log has an entry for each write to FORCE_IN and FORCE_OUT, also for
/// one that ends forces, and for one that finds nothing forced.
class ForceMessages {
  public:
    /// To be called with a new log.
    void restart() { *this = {}; }
    /// Of a new entry: the message; empty if it has none. `now`: what is forced after it.
    std::optional<LogMessage> message(const gateway::EventLog::Entry& entry, const gateway::ForcedIo& now);

  private:
    bool inputs_ = false;  ///< are forced, as was told
    bool outputs_ = false;
};

}  // namespace nplc::boards
