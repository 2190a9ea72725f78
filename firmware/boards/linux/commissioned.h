#pragma once

#include <atomic>
#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <thread>

namespace nplc::boards {

/// The list of the axes in whose store run was commanded, kept beside their folders, so that a lost folder is
/// not taken for a new axis. Lines of text: "NPC1", for each axis the second (Unix time) in which it was
/// entered and its name, and the CRC-32 of all that, in hexadecimal. It permits nothing and forbids nothing.
class CommissionedAxes {
  public:
    using Clock = std::chrono::sys_seconds (*)();

    /// Reads the list in this folder; changes nothing.
    explicit CommissionedAxes(const std::string& state_directory, Clock clock = now_by_clock);
    /// Waits for a write in progress, and for one not yet begun.
    ~CommissionedAxes();
    CommissionedAxes(const CommissionedAxes&) = delete;
    CommissionedAxes& operator=(const CommissionedAxes&) = delete;

    /// Why there is no list though there is a file, one line; empty: it is complete, or there is none yet.
    const std::string& fault() const { return fault_; }
    /// When the axis was entered; empty: it was not.
    std::optional<std::chrono::sys_seconds> since(const std::string& axis) const;

    /// Enters the axis, also anew, with the present time, and begins to write the list in the background:
    /// beside it, then renamed, with what another process has entered meanwhile.
    void enter(const std::string& axis);
    /// The result of a write, once: empty, or a one-line error. To be called now and then; begins the next
    /// write if one is due.
    std::optional<std::string> poll();

  private:
    using Entries = std::map<std::string, std::chrono::sys_seconds>;

    static std::chrono::sys_seconds now_by_clock();
    static std::string write(const std::string& path, Entries entries);
    void begin_write();

    std::string path_;
    Clock clock_;
    std::string fault_;
    Entries found_;
    Entries entered_;
    bool is_due_ = false;
    std::thread thread_;
    std::atomic<bool> is_written_ = false;
    std::string error_;  ///< owned by the thread until is_written_
};

}  // namespace nplc::boards
