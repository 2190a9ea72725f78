#pragma once

#include <string>
#include <vector>

namespace nplc::boards {

/// As the journal counts them.
enum class LogLevel : int { error = 3, warning = 4, notice = 5, info = 6, debug = 7 };

/// What the journal can be searched by, beside its own fields: `journalctl NANOPLC_CAUSE=link_down`. The
/// README has the list.
struct JournalField {
    std::string name;  ///< capitals, behind NANOPLC_
    std::string value;
};
using JournalFields = std::vector<JournalField>;

/// Lines for the user on standard error. Where that is the journal they go there with their level and fields;
/// where it does not take them so, with their level <3> before them, which it takes off.
class Journal {
  public:
    /// The journal's socket is systemd's, or where NANOPLC_JOURNAL_SOCKET of the environment says.
    explicit Journal(LogLevel most);
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Never waits for the journal.
    void write(LogLevel level, const std::string& text, const JournalFields& fields = {});
    bool writes(LogLevel level) const { return level <= most_; }

  private:
    LogLevel most_;
    bool is_journal_;
    int socket_ = -1;
};

/// Those about one axis, whose name they begin with.
class AxisJournal {
  public:
    AxisJournal(Journal& journal, const std::string& axis) : journal_(journal), axis_(axis) {}
    void write(LogLevel level, const std::string& text, JournalFields fields = {}) {
        fields.push_back({"AXIS", axis_});
        journal_.write(level, axis_ + ": " + text, fields);
    }
    Journal& journal() { return journal_; }

  private:
    Journal& journal_;
    const std::string& axis_;
};

}  // namespace nplc::boards
