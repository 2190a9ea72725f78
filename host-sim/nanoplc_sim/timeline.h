#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/snapshot.h"

namespace nplc::sim {

/// Colours for a terminal; empty for none.
struct Palette {
    explicit Palette(bool on);
    std::string_view dim, strong, good, bad, order, plain;
};

/// Wraps text to lines of at most `width` characters, between words where possible; colour escape codes have
/// no width.
std::vector<std::string> wrapped(std::string_view text, std::size_t width);

/// Printed log of a run: one line per event, on standard output. On a terminal too narrow for all columns:
/// time, step, position, speed, and the event, outputs included.
class Timeline {
  public:
    /// `columns` of the terminal; 0: no wrapping.
    Timeline(const Names& names, const Palette& palette, std::size_t columns = 0);

    void heading() const;
    /// Prints a line if something happened, if there is a remark, or if the motor has been moving for a
    /// while.
    void observe(const Snapshot& snapshot);
    /// A remark that no snapshot shows; printed with the next snapshot.
    void remark(const std::string& text) { remarks_.push_back(text); }
    void alarm(const std::string& text);
    void begin_lines_with(const std::string& code) { line_start_ = code; }

  private:
    std::vector<std::string> events(const Snapshot& snapshot) const;
    void print(const Snapshot& s, const std::vector<std::string>& list);
    std::string wide_columns(const Snapshot& s) const;
    std::string narrow_columns(const Snapshot& s) const;
    std::string step(const Snapshot& s) const;
    std::string inputs(const Snapshot& snapshot) const;
    std::string outputs(const Snapshot& snapshot) const;

    const Names& names_;
    Palette palette_;
    std::size_t step_width_;
    std::size_t inputs_width_;
    std::size_t outputs_width_;
    bool narrow_ = false;
    std::size_t indent_;
    std::size_t events_width_;
    std::optional<Snapshot> last_;
    Snapshot printed_;
    std::vector<std::string> remarks_;
    std::string line_start_;
};

}  // namespace nplc::sim
