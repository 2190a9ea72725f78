#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>

namespace nplc::boards {

/// What lets an axis's sequence start without a command.
enum class AutostartPermission : std::uint8_t {
    first_run = 1,    ///< not yet: nobody has commanded run with this store
    given = 2,        ///< somebody has commanded run since the store was new and since the last crash
    after_crash = 3,  ///< not until somebody commands run: a run was cut off
    bad_mark = 4,     ///< likewise: what says how the last run ended was damaged
    lost = 5,         ///< likewise: what was stored was lost
};

/// The record in an axis's store that says whose store it is and whether the sequence may start without a
/// command: in the page at kAddress the bytes "NPO1", the permission, the name's length, the name, and the
/// CRC-32 of all that, low byte first. Written in one piece; half of it is damaged.
class StoreOwner {
  public:
    static constexpr std::uint32_t kAddress = 14 * 2048;

    enum class Found : std::uint8_t { blank, whole, damaged };

    /// Looks at the store, which must be there, and changes nothing.
    StoreOwner(std::string store, std::string axis);
    /// Waits for the write under way.
    ~StoreOwner();
    StoreOwner(const StoreOwner&) = delete;
    StoreOwner& operator=(const StoreOwner&) = delete;

    Found found() const { return found_; }
    /// Of a whole record.
    AutostartPermission permission() const { return permission_; }
    const std::string& owner() const { return owner_; }
    bool is_anothers() const { return found_ == Found::whole && owner_ != axis_; }
    bool says(AutostartPermission permission) const {
        return found_ == Found::whole && owner_ == axis_ && permission_ == permission;
    }

    /// On the disk when it returns. Empty, or in one line why it could not be written.
    std::string write(AutostartPermission permission);
    /// The same in a thread of its own; not while one is under way. Then poll() answers, once.
    void begin_write(AutostartPermission permission);
    std::optional<std::string> poll();
    bool is_writing() const { return thread_.joinable(); }

  private:
    void look();

    std::string path_;
    std::string axis_;
    Found found_ = Found::damaged;
    AutostartPermission permission_ = AutostartPermission::bad_mark;
    std::string owner_;
    std::thread thread_;
    std::atomic<bool> is_written_ = false;
    std::string error_;  ///< belongs to the thread until is_written_
};

}  // namespace nplc::boards
