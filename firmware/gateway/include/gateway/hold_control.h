#pragma once

#include <cstdint>

namespace nplc::gateway {

/// When a running sequence is to be held: at a breakpoint, after a single scan or step, or by command.
class HoldControl {
  public:
    enum class After : std::uint8_t { never, scan, step, at_once };

    void set(After after) { after_ = after; }
    bool has_single() const { return after_ == After::scan || after_ == After::step; }
    bool is_at_once() const { return after_ == After::at_once; }

    /// Bit n: hold at the entry of step n.
    void set_breakpoints(std::uint64_t steps) { breakpoints_ = steps; }
    std::uint64_t breakpoints() const { return breakpoints_; }
    bool breaks_at(std::uint8_t step) const { return ((breakpoints_ >> step) & 1U) != 0; }

    /// To be asked after each scan: the single scan or step is complete.
    bool is_due(bool entered_step) const {
        return after_ == After::scan || (after_ == After::step && entered_step);
    }

    void begin(bool at_breakpoint) {
        after_ = After::never;
        at_breakpoint_ = at_breakpoint;
    }
    /// The last hold was at a breakpoint.
    bool at_breakpoint() const { return at_breakpoint_; }
    void leave(After after) {
        after_ = after;
        at_breakpoint_ = false;
    }

  private:
    After after_ = After::never;
    bool at_breakpoint_ = false;
    std::uint64_t breakpoints_ = 0;
};

}  // namespace nplc::gateway
