#pragma once

#include <string>

#include "gateway/event_log.h"
#include "gateway/vocabulary.h"
#include "journal.h"

namespace nplc::boards {

struct LogMessage {
    LogLevel level;
    std::string text;
};
/// An entry of the gateway's log for a person: what happened, and for a fault what to do.
LogMessage in_words(const gateway::EventLog::Entry& entry);

}  // namespace nplc::boards
