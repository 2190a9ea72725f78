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
/// What the journal can be searched by: EVENT, CAUSE of a safe state, STEP, DETAIL.
JournalFields fields_of(const gateway::EventLog::Entry& entry);
/// An entry of the gateway's log for the user: what happened, and for a fault what to do.
LogMessage in_words(const gateway::EventLog::Entry& entry);

}  // namespace nplc::boards
