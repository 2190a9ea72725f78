#pragma once

#include <map>
#include <optional>

#include "sim/output_file.h"
#include "sim/snapshot.h"

namespace nplc::sim {

/// The trace as CSV:
///     time_ms,step,timer,counter,inputs,outputs,inpos,error,command,p_ist,v_ist
/// A row at every change of a column and at least every 10 ms; time_ms has three decimals; `command` holds
/// the commands given at that instant, space separated: two hex digits without the toggle bit, or REG=VALUE
/// in decimal. Steps, inputs and outputs are numbers, whatever names the program has for them.
class CsvTrace {
  public:
    static constexpr Time kLongestGap = std::chrono::milliseconds{10};

    explicit CsvTrace(const std::string& path);

    /// Time of the next row without a change.
    Time next_due() const;
    /// Writes a row if there is a change or one is due; times must not decrease.
    void observe(const Snapshot& snapshot);
    /// Writes `last` if it is newer than the last row.
    void finish(const Snapshot& last);

  private:
    void write_held();
    void write_row(const Snapshot& snapshot);

    OutputFile file_;
    std::optional<Snapshot> last_;
    bool holds_ =
        false;  ///< last_ was due without a change: written unless a change at the same time replaces it
};

/// The trace as a value change dump (IEEE 1364), in microseconds, for GTKWave and its like. Signals have the
/// program's names (IN0, OUT0 and step numbers without any). `step_name` and `command` are GTKWave's string
/// variables; `command` falls back to "-" one millisecond after the command was given, so that two equal ones
/// can be told apart.
class VcdTrace {
  public:
    /// `comment` is written in the header.
    VcdTrace(const std::string& path, const Names& names, const std::string& comment = {});

    /// Times must not decrease.
    void observe(const Snapshot& snapshot);
    /// `end`: the last observed time.
    void finish(Time end);

  private:
    void header(const std::string& comment);
    void at(Time time);
    /// Writes `value` under `name` if it differs from the last one in the file.
    void put(const std::string& name, const std::string& value);
    void fall_back(Time time);

    OutputFile file_;
    Names names_;
    std::map<std::string, std::string> values_;
    std::optional<std::int64_t> written_us_;
    std::int64_t now_us_ = 0;
    std::optional<Time> command_until_;
};

}  // namespace nplc::sim
