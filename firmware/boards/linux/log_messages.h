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
/// Its key, or its number.
EventKey event_of(const gateway::EventLog::Entry& entry);
/// Fields for searching the journal besides EVENT: CAUSE of a safe state, STEP, DETAIL.
JournalFields fields_of(const gateway::EventLog::Entry& entry);
/// Text of a log entry for the operator: the event, and for a fault the remedy.
LogMessage in_words(const gateway::EventLog::Entry& entry);

}  // namespace nplc::boards
