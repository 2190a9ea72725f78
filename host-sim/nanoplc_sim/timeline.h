#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/snapshot.h"

namespace nplc::sim {

/// Colours for a terminal, or nothing at all.
struct Palette {
    explicit Palette(bool on);
    std::string_view dim, strong, good, bad, order, plain;
};

/// A run as a person reads it: one line for everything that happens, on standard output.
class Timeline {
  public:
    Timeline(const Names& names, const Palette& palette);

    void heading() const;
    /// Prints a line if something happened, if there is a remark, or if the motor has been moving for a
    /// while.
    void observe(const Snapshot& snapshot);
    /// Something that no snapshot shows; printed with the next snapshot.
    void remark(const std::string& text) { remarks_.push_back(text); }
    void alarm(const std::string& text);
    void begin_lines_with(const std::string& code) { line_start_ = code; }

  private:
    std::vector<std::string> events(const Snapshot& snapshot) const;
    void print(const Snapshot& s, const std::vector<std::string>& list);
    std::string inputs(const Snapshot& snapshot) const;
    std::string outputs(const Snapshot& snapshot) const;

    const Names& names_;
    Palette palette_;
    std::size_t step_width_;
    std::size_t inputs_width_;
    std::size_t outputs_width_;
    std::optional<Snapshot> last_;
    Snapshot printed_;
    std::vector<std::string> remarks_;
    std::string line_start_;
};

}  // namespace nplc::sim
