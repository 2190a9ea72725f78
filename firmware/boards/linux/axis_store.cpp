#include "axis_store.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <utility>

namespace nplc::boards {
namespace {

namespace fs = std::filesystem;
using Found = hal_linux::RunMarker::Found;

std::string run_mark(const std::string& folder) {
    return folder + "/running";
}

std::string date_of(std::chrono::sys_seconds time) {
    const std::chrono::year_month_day date(std::chrono::floor<std::chrono::days>(time));
    return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(date.year()),
                       static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
}

}  // namespace

bool power_cut_waits(std::optional<bool> configured, std::optional<bool> tells_resets) {
    return configured.value_or(!tells_resets.value_or(true));
}

ports::Storage& AxisStore::storage() {
    if (storage_) return *storage_;
    return no_storage_;
}

std::string AxisStore::open(const std::string& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        return fmt::format(
            "{}: cannot be made: {}; name another state_directory, or let this user write there", folder,
            error.message());
    const std::string path = store_file(folder);
    if (!marker_) {
        if (std::string why = check_marker(folder, path); !why.empty()) return why;
    }
    auto opened = hal_linux::FileStorage::open(path, kMemory);
    if (!opened.storage) return opened.error;
    file_ = std::move(opened.storage);
    storage_.emplace(*file_);
    if (!owner_) check_owner(path);
    return {};
}

void AxisStore::check_owner(const std::string& path) {
    using enum AutostartPermission;
    owner_.emplace(path, axis_);
    const Found found = marker_->found();
    const bool has_run_here = found == Found::ended || found == Found::running || found == Found::crashed;
    switch (owner_->found()) {
        case StoreOwner::Found::whole:
            permission_ = owner_->permission();
            if (!owner_->is_anothers()) break;
            permission_ = first_run;
            journal_.write(
                LogLevel::error, JournalEvent::store_of_another,
                fmt::format("{} is the store of axis {}; if it is to be this one's, look at its table "
                            "and settings, then `nanoctl run`",
                            path, owner_->owner()));
            break;
        case StoreOwner::Found::damaged:
            permission_ = bad_mark;
            journal_.write(LogLevel::error, JournalEvent::store_lost,
                           path + ": what says whose it is is damaged");
            break;
        case StoreOwner::Found::blank:
            permission_ = is_lost_ ? lost : first_run;
            if (is_lost_ || !has_run_here) break;
            permission_ = marker_->is_old() ? given : lost;
            if (marker_->is_old())
                journal_.write(LogLevel::notice, JournalEvent::new_store,
                               "is of a version before: it may start by itself, as it did there");
            else
                journal_.write(LogLevel::error, JournalEvent::store_lost,
                               path + " is blank, though the axis had one; what was stored is lost");
            break;
    }
    if (marker_is_bad_ && permission_ != lost) permission_ = bad_mark;
    look_for_traces();
}

/// What the list of commissioned axes says of a new store, and the other way round: an axis from before there
/// was a list gets into it.
void AxisStore::look_for_traces() {
    using enum AutostartPermission;
    const auto since = commissioned_.since(axis_);
    if ((permission_ == given || permission_ == after_crash) && !since) commissioned_.enter(axis_);
    if (permission_ != first_run) return;
    if (owner_->is_anothers()) {
        trace_ = gateway::StoreTrace::anothers;
    } else if (since) {
        trace_ = gateway::StoreTrace::lost;
        journal_.write(LogLevel::error, JournalEvent::store_lost,
                       fmt::format("its store was lost (it was in use since {}): waits for `nanoctl run`",
                                   date_of(*since)));
    } else {
        journal_.write(LogLevel::notice, JournalEvent::new_store,
                       "new here: waits for a first run command, `nanoctl run`");
    }
}

/// The stored data are lost if the marker shows earlier runs and the store is missing.
std::string AxisStore::check_marker(const std::string& folder, const std::string& path) {
    std::error_code error;
    marker_.emplace(run_mark(folder));
    const bool has_store = fs::exists(path, error);
    const Found found = marker_->found();
    const bool is_new = found == Found::missing && !has_store;
    if (is_new) static_cast<void>(marker_->make());  // mark_running() reports it
    marker_is_bad_ = !is_new && (found == Found::missing || found == Found::damaged);
    if (has_store || is_new || found == Found::fresh) return {};
    is_lost_ = true;
    std::string why = replace_lost_store(path);
    if (!why.empty()) marker_.reset();
    return why;
}

std::string AxisStore::replace_lost_store(const std::string& path) {
    journal_.write(LogLevel::error, JournalEvent::store_lost,
                   path +
                       " is missing, and with it what was stored; upload the table again, and set and "
                       "keep the settings, or put a copy there while the service is stopped");
    const std::string beside = path + ".new";
    std::error_code error;
    fs::remove(beside, error);
    {
        const auto made = hal_linux::FileStorage::open(beside, kMemory);
        if (!made.storage) return made.error;
        for (const store::Area& area : {kTableArea, kSettingsArea, kSetPointArea}) {
            if (!store::note_loss(*made.storage, area)) return beside + ": cannot be written";
        }
    }
    fs::rename(beside, path, error);
    return error ? path + ": cannot be made: " + error.message() : "";
}

/// A watchdog reset no longer counts once a run has ended in order since then.
bool AxisStore::is_after_crash(const BoardStart& board) {
    if (!was_cut_off(board)) return false;
    is_after_crash_ = true;
    if (permission_ == AutostartPermission::given) permission_ = AutostartPermission::after_crash;
    return true;
}

bool AxisStore::was_cut_off(const BoardStart& board) const {
    const bool is_cut_off = marker_->found() == Found::running;
    const bool of_this_boot = marker_->of_this_boot();
    if (marker_->found() == Found::crashed || (is_cut_off && of_this_boot)) return true;
    if (board.by_watchdog && !(of_this_boot && marker_->found() == Found::ended)) {
        journal_.write(LogLevel::error, JournalEvent::board_reset, "a watchdog has reset the board");
        return true;
    }
    if (is_cut_off)
        journal_.write(
            LogLevel::notice, JournalEvent::board_reset,
            "the board has restarted in the middle of a run, and no watchdog says that it did this: a power "
            "cut");
    return is_cut_off && board.power_cut_waits;
}

/// The permission first: a power cut between the two must not make a power cut of a crash.
std::string AxisStore::mark_running() {
    if (!storage_) return {};
    std::string error;
    if (!owner_->is_writing() && !owner_->is_anothers() && !owner_->says(permission_))
        error = owner_->write(permission_);
    if (error.empty()) error = marker_->set();
    is_marked_ = error.empty();
    return error;
}

/// A write that was given up may still be under way at the next command, which then waits for it.
std::optional<std::string> AxisStore::give_permission(base::Instant now) {
    constexpr base::Milliseconds kLongestWrite{1'000};
    if (!owner_) return "there is no store";
    if (!asked_) {
        asked_ = now;
        if (!owner_->is_writing()) owner_->begin_write(AutostartPermission::given);
    }
    std::optional<std::string> outcome = owner_->poll();
    if (!outcome && now - *asked_ < kLongestWrite) return std::nullopt;
    asked_.reset();
    if (!outcome) return "the store takes longer than 1 s to be written";
    if (outcome->empty()) {
        const bool is_new_store =
            permission_ == AutostartPermission::first_run || permission_ == AutostartPermission::lost;
        if (is_new_store || !commissioned_.since(axis_)) commissioned_.enter(axis_);
        permission_ = AutostartPermission::given;
        is_after_crash_ = false;
    }
    return outcome;
}

/// The marker keeps a crash until run is commanded, since the store may be replaced by another one.
std::string AxisStore::mark_ended() {
    if (!storage_) return {};
    return is_after_crash_ ? marker_->note_crash() : marker_->clear();
}

std::string AxisStore::mark_crashed() {
    return storage_ ? marker_->note_crash() : std::string();
}

bool is_in_use(const std::string& folder) {
    return hal_linux::FileStorage::is_held(store_file(folder));
}

std::string note_crash(const std::string& folder) {
    if (is_in_use(folder))
        return fmt::format("{}: a service uses this store: it has not ended, and nothing was noted", folder);
    hal_linux::RunMarker marker(run_mark(folder));
    const bool crashed = marker.found() == Found::running && marker.of_this_boot();
    return crashed ? marker.note_crash() : std::string();
}

}  // namespace nplc::boards
