#pragma once

#include <string>

namespace nplc::hal_linux {

/// A file that records whether a program runs and in which boot of this machine it began, so that the next
/// start knows how the last run ended. It has a fixed size and is written in place, so that a full disk does
/// not matter; its content is on the disk when a call returns.
class RunMarker {
  public:
    enum class Found {
        missing,
        fresh,    ///< created, and never set
        ended,    ///< orderly end
        running,  ///< no orderly end: killed, crashed, reset, or a power cut
        crashed,  ///< no orderly end, and it was no power cut
        damaged,  ///< or unreadable
    };

    /// Reads the file and changes nothing.
    explicit RunMarker(std::string path);
    Found found() const { return found_; }
    /// The record was written in this boot.
    bool of_this_boot() const { return of_this_boot_; }
    /// The record was written by version 1, in which the store had no owner record.
    bool is_old() const { return is_old_; }

    // Each returns an empty string, or a one-line error.

    /// Creates the file as `fresh` if there was none.
    std::string make();
    /// Records that the program runs.
    std::string set();
    /// Records an orderly end.
    std::string clear();
    /// Records a disorderly end, which a power cut afterwards does not hide.
    std::string note_crash();

  private:
    void look();
    std::string write(const std::string& state);

    std::string path_;
    std::string boot_;
    Found found_ = Found::damaged;
    bool of_this_boot_ = false;
    bool is_old_ = false;
    bool is_whole_ = false;  ///< complete, so that it can be written in place
};

}  // namespace nplc::hal_linux
