#pragma once

#include <memory>
#include <optional>
#include <string>

#include "hal_linux/background_storage.h"
#include "hal_linux/file_storage.h"
#include "hal_linux/run_marker.h"
#include "journal.h"
#include "no_ports.h"
#include "store_owner.h"
#include "stored.h"

namespace nplc::boards {

/// What is known of the board's own start.
struct BoardStart {
    bool by_watchdog = false;      ///< one of its watchdogs says that it has reset the board
    bool power_cut_waits = false;  ///< a run that a restart of the board has cut off waits for the user
};

/// An axis's folder: its store with the record of its owner, and the run marker that says how the last run
/// ended. The sequence starts without a command only if somebody has commanded run with this store, in this
/// axis, and since the last crash.
class AxisStore {
  public:
    AxisStore(AxisJournal& journal, std::string axis) : journal_(journal), axis_(std::move(axis)) {}

    /// Empty, or why it cannot be had, one line; then it may be tried again. A store that is lost is replaced
    /// by one that says so until something is stored anew.
    std::string open(const std::string& folder);
    bool is_open() const { return storage_.has_value(); }
    /// Fails at everything until it is open.
    ports::Storage& storage();
    bool is_busy() { return storage().state() == ports::StorageState::busy; }

    /// Whether the last run was cut off by something else than a power cut that the board may go on after;
    /// then nothing starts without a command. Once it is open.
    bool is_after_crash(const BoardStart& board);
    AutostartPermission permission() const { return permission_; }
    /// Marks a run, and what is known now of the permission. In a store that is another program's the marker
    /// is so too, and is left alone. Empty, or one line.
    std::string mark_running();
    /// Somebody has commanded run: the permission is given, and written beside everything else.
    void note_run();
    /// To be called now and then after note_run(): why it could not be written, one line, once.
    std::string look();
    std::string mark_ended();
    bool is_marked() const { return is_marked_; }

  private:
    std::string check_marker(const std::string& folder, const std::string& path);
    void check_owner(const std::string& path);
    bool was_cut_off(const BoardStart& board) const;
    std::string replace_lost_store(const std::string& path);

    AxisJournal& journal_;
    std::string axis_;
    std::optional<hal_linux::RunMarker> marker_;
    bool marker_is_bad_ = false;  ///< as the start found it
    bool is_lost_ = false;        ///< the store was missing, and replaced
    std::optional<StoreOwner> owner_;
    AutostartPermission permission_ = AutostartPermission::first_run;
    bool is_marked_ = true;
    std::unique_ptr<hal_linux::FileStorage> file_;
    std::optional<hal_linux::BackgroundStorage> storage_;
    NoStorage no_storage_{kMemory};
};

}  // namespace nplc::boards
