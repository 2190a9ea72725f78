#pragma once

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

    /// When the next row is due without any change.
    Time next_due() const;
    /// Writes a row if there is a change or one is due; times must not fall.
    void observe(const Snapshot& snapshot);
    /// Writes `last` if it is newer than the last row.
    void finish(const Snapshot& last);

  private:
    void write_held();
    void write_row(const Snapshot& snapshot);

    OutputFile file_;
    std::optional<Snapshot> last_;
    bool holds_ =
        false;  ///< last_ was only due: it is written unless a change at its instant takes its place
};

}  // namespace nplc::sim
