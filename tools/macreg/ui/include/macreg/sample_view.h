#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "macreg/recording.h"

namespace nplc::macreg {

/// A recording, which of its curves is shown, and how.
class SampleView {
  public:
    const Recording& recording() const { return recording_; }
    /// Of a recording under way; else empty.
    const std::string& progress() const { return progress_; }
    std::size_t curve() const { return curve_; }
    /// The samples as a table, from the row `sample` on.
    bool shows_numbers() const { return numbers_; }
    std::size_t sample() const { return sample_; }

    void set_recording(Recording recording);
    void set_progress(std::string progress) { progress_ = std::move(progress); }
    void toggle_numbers() { numbers_ = !numbers_; }
    void move_curve(int steps);
    /// From row to row of a table, else from curve to curve.
    void move(int steps);

  private:
    Recording recording_;
    std::string progress_;
    std::size_t curve_ = 0;
    std::size_t sample_ = 0;
    bool numbers_ = false;
};

}  // namespace nplc::macreg
