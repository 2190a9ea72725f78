#pragma once

#include <string>
#include <vector>

#include "gateway/vocabulary.h"
#include "journal_event.h"

namespace nplc::boards {

/// Numbered as in the journal.
enum class LogLevel : int { error = 3, warning = 4, notice = 5, info = 6, debug = 7 };

/// Fields for searching the journal, besides its own: `journalctl NANOPLC_CAUSE=link_down`. The README has
/// the list.
struct JournalField {
    std::string name;  ///< capitals, without the prefix NANOPLC_
    std::string value;
};
using JournalFields = std::vector<JournalField>;
/// CAUSE, a cause of the safe state: what the machine cannot do without.
JournalFields cause_field(gateway::SafeReason reason);

/// Lines for the operator on standard error. If that is the journal they are sent with their level and
/// fields, or, where the journal does not accept that, with the level prefix <3>, which it strips.
class Journal {
  public:
    /// The journal's socket is systemd's, or the one in the environment variable NANOPLC_JOURNAL_SOCKET.
    explicit Journal(LogLevel most);
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Never blocks on the journal.
    void write(LogLevel level, const EventKey& event, const std::string& text,
               const JournalFields& fields = {});
    bool writes(LogLevel level) const { return level <= most_; }

  private:
    LogLevel most_;
    bool is_journal_;
    int socket_ = -1;
};

/// Lines about one axis, with its name as prefix.
class AxisJournal {
  public:
    AxisJournal(Journal& journal, const std::string& axis) : journal_(journal), axis_(axis) {}
    void write(LogLevel level, const EventKey& event, const std::string& text, JournalFields fields = {}) {
        fields.push_back({"AXIS", axis_});
        journal_.write(level, event, axis_ + ": " + text, fields);
    }

  private:
    Journal& journal_;
    const std::string& axis_;
};

}  // namespace nplc::boards
