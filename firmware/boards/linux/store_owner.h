#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>

namespace nplc::boards {

/// Whether an axis's sequence may start without a command.
enum class AutostartPermission : std::uint8_t {
    first_run = 1,    ///< no: run was never commanded with this store
    given = 2,        ///< run was commanded since the store was created and since the last crash
    after_crash = 3,  ///< not until run is commanded: the last run was interrupted
    bad_mark = 4,     ///< likewise: the run marker was damaged
    lost = 5,         ///< likewise: the stored data were lost
};

/// The record in an axis's store that names the owner of the store and says whether the sequence may start
/// without a command: in the page at kAddress the bytes "NPO1", the permission, the name's length, the name,
/// and the CRC-32 of all that, little-endian. Written in one piece; a partial record is damaged.
class StoreOwner {
  public:
    static constexpr std::uint32_t kAddress = 14 * 2048;

    enum class Found : std::uint8_t { blank, whole, damaged };

    /// Reads the record of an existing store; changes nothing.
    StoreOwner(std::string store, std::string axis);
    /// Waits for a write in progress.
    ~StoreOwner();
    StoreOwner(const StoreOwner&) = delete;
    StoreOwner& operator=(const StoreOwner&) = delete;

    Found found() const { return found_; }
    /// Valid for a complete record.
    AutostartPermission permission() const { return permission_; }
    const std::string& owner() const { return owner_; }
    bool is_anothers() const { return found_ == Found::whole && owner_ != axis_; }
    bool says(AutostartPermission permission) const {
        return found_ == Found::whole && owner_ == axis_ && permission_ == permission;
    }

    /// Synchronous: on the disk when it returns. Empty, or a one-line error.
    std::string write(AutostartPermission permission);
    /// The same in a background thread; not while one is in progress. poll() then returns the result, once.
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
    std::string error_;  ///< owned by the thread until is_written_
};

}  // namespace nplc::boards
