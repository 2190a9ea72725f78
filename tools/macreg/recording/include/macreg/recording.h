#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "registers/mac.h"

namespace nplc::macreg {

/// Values of registers over time, in their units.
struct Recording {
    struct Column {
        std::string name;
        std::string unit;  ///< empty: a plain number
        std::vector<double> values;
    };

    std::string model{};
    unsigned address = 0;
    double rate_hz = 0;        ///< 0: polled, with the times of the answers
    std::string start{};       ///< the start condition: "now", "when V_IST > 100 rpm"
    std::string incomplete{};  ///< why it ended early; empty if it is complete
    std::vector<double> time_s{};
    std::vector<Column> columns{};

    std::size_t size() const { return time_s.size(); }
};

/// A column for a register, in the unit that the screen shows too.
Recording::Column column_of(const registers::Register& reg);
/// The number that `value_text` shows, without its unit.
double shown_value(const registers::Register& reg, registers::Model model, std::int64_t raw);

/// Comment lines with `#` (model, address, rate, start, incomplete), a header `time_s,P_IST [counts],...`,
/// one row per sample. Enough decimals to distinguish neighbouring raw values.
std::string to_csv(const Recording& recording);

struct RecordingReading {
    Recording recording{};
    std::string error{};  ///< "plot.csv:12: ...", with what to do; empty if it was understood
};

/// Also takes CSV of other programs: a first column of seconds, names with or without [unit]. `name` is the
/// file's, for messages.
RecordingReading from_csv(std::string_view text, const std::string& name);

/// The same, line by line.
class RecordingReader {
  public:
    explicit RecordingReader(std::string name) : name_(std::move(name)) {}

    /// False after an error.
    bool take(std::string_view line);
    /// For a line that exceeds the limit.
    void refuse_line();
    RecordingReading finish();

  private:
    void comment(std::string_view line);
    void header(std::string_view line);
    void row(std::string_view line);
    void fail(const std::string& what) { fail(what, line_); }
    void fail(const std::string& what, std::size_t line);

    std::string name_;
    std::size_t line_ = 0;
    bool header_ = false;
    RecordingReading result_{};
};

}  // namespace nplc::macreg
