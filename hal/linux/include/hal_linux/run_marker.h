#pragma once

#include <string>

namespace nplc::hal_linux {

/// A file that says whether a program runs and in which boot of this machine it began, so that the next start
/// knows how the last one ended. It has one size from the beginning and is written in place, so that a full
/// disk does not matter; what it says is on the disk when a call returns.
class RunMarker {
  public:
    enum class Found {
        missing,
        fresh,    ///< made, and never set
        ended,    ///< in order
        running,  ///< not ended: killed, crashed, reset, or the power was cut
        damaged,  ///< or not readable
    };

    /// Looks at the file and changes nothing.
    explicit RunMarker(std::string path);
    Found found() const { return found_; }
    /// What was found was written in this boot.
    bool of_this_boot() const { return of_this_boot_; }
    /// What was found was written by a version before 2, beside which the store had no record of its owner.
    bool is_old() const { return is_old_; }

    // Each answers nothing, or in one line why it could not be written.

    /// `fresh`, where nothing was found.
    std::string make();
    /// The program runs from now on.
    std::string set();
    /// It has ended in order.
    std::string clear();

  private:
    void look();
    std::string write(const std::string& state);

    std::string path_;
    std::string boot_;
    Found found_ = Found::damaged;
    bool of_this_boot_ = false;
    bool is_old_ = false;
    bool is_whole_ = false;  ///< and can be written in place
};

}  // namespace nplc::hal_linux
