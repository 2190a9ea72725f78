#pragma once

#include <memory>
#include <optional>
#include <string>

#include "commissioned.h"
#include "gateway/store_trace.h"
#include "hal_linux/background_storage.h"
#include "hal_linux/file_storage.h"
#include "hal_linux/run_marker.h"
#include "journal.h"
#include "no_ports.h"
#include "store_owner.h"
#include "stored.h"

namespace nplc::boards {

/// How the board itself was started.
struct BoardStart {
    bool by_watchdog = false;      ///< one of its watchdogs reports that it has reset the board
    bool power_cut_waits = false;  ///< after a power cut during a run the axis waits for the operator
};

/// What `after_power_cut` means on this board. `configured`: whether it waits; empty: "auto". `tells_resets`:
/// whether the driver of watchdog_device reports its own resets, which look like power cuts otherwise; empty:
/// no watchdog_device.
bool power_cut_waits(std::optional<bool> configured, std::optional<bool> tells_resets);

/// An axis's folder: its store with the owner record, and the run marker that records how the last run ended.
/// The sequence starts without a command only if run was commanded with this store, in this axis, since the
/// last crash.
class AxisStore {
  public:
    /// `commissioned`: all axes' list.
    AxisStore(AxisJournal& journal, std::string axis, CommissionedAxes& commissioned)
        : journal_(journal), axis_(std::move(axis)), commissioned_(commissioned) {}

    /// Empty, or a one-line error; then it may be retried. Replaces a missing store with one marked 'data
    /// lost' until the next upload.
    std::string open(const std::string& folder);
    bool is_open() const { return storage_.has_value(); }
    /// Returns an error for every operation until it is open.
    ports::Storage& storage();
    bool is_busy() { return storage().state() == ports::StorageState::busy; }

    /// The last run was interrupted by something other than a power cut after which the board may continue;
    /// then nothing starts without a command. Needs is_open().
    bool is_after_crash(const BoardStart& board);
    AutostartPermission permission() const { return permission_; }
    /// Why run was never commanded with this store, when it was opened.
    gateway::StoreTrace trace() const { return trace_; }
    /// Marks a run as begun and stores the permission. Leaves the record in a store of another axis
    /// unchanged. Empty, or a one-line error.
    std::string mark_running();
    /// Run was commanded: begins to write the permission in the background, for 1 s at the most. To be called
    /// until it returns a value: empty if the permission is stored, else the reason, one line.
    std::optional<std::string> give_permission(base::Instant now);
    /// An orderly end. One before which a crash has not been answered by run keeps the crash.
    std::string mark_ended();
    /// The end is not orderly: the motor may be moving.
    std::string mark_crashed();
    bool is_marked() const { return is_marked_; }

  private:
    std::string check_marker(const std::string& folder, const std::string& path);
    void check_owner(const std::string& path);
    void look_for_traces();
    bool was_cut_off(const BoardStart& board) const;
    std::string replace_lost_store(const std::string& path);

    AxisJournal& journal_;
    std::string axis_;
    CommissionedAxes& commissioned_;
    gateway::StoreTrace trace_ = gateway::StoreTrace::none;
    std::optional<hal_linux::RunMarker> marker_;
    bool marker_is_bad_ = false;  ///< at the start
    bool is_lost_ = false;        ///< the store was missing and has been replaced
    std::optional<StoreOwner> owner_;
    AutostartPermission permission_ = AutostartPermission::first_run;
    bool is_marked_ = true;
    bool is_after_crash_ = false;         ///< and run was not commanded since
    std::optional<base::Instant> asked_;  ///< when the permission was
    std::unique_ptr<hal_linux::FileStorage> file_;
    std::optional<hal_linux::BackgroundStorage> storage_;
    NoStorage no_storage_{kMemory};
};

/// Whether a service has the store in this folder open.
bool is_in_use(const std::string& folder);

/// After the end of the service: records that an axis in this folder which was running in this boot has
/// crashed, so that the next start finds this even after a power cut. Changes nothing while is_in_use().
/// Empty, or a one-line error.
std::string note_crash(const std::string& folder);

}  // namespace nplc::boards
