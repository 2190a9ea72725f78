// What an axis is made of: had at the start, or tried again until it is there.
#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "axis.h"
#include "stored.h"
#include "table_file.h"

namespace nplc::boards {
namespace {

namespace fs = std::filesystem;
using gateway::SafeReason;
using Found = hal_linux::RunMarker::Found;
using store::Setting;

/// A motor that has not answered so long after the start is told of; one that is switched on with us needs
/// some time.
constexpr base::Milliseconds kFirstAnswer{5'000};
constexpr base::Milliseconds kBetweenTries{500};
constexpr base::Microseconds kPace{250};

}  // namespace

void Axis::open(const std::string& state_directory, const BoardStart& board, base::Instant now) {
    board_ = board;
    folder_ = state_directory + "/" + config_.name;
    begin(now);
}

/// Outputs first, at their safe levels, as far as the settings that tell them are to be had.
void Axis::begin(base::Instant now) {
    lacks_ = {};
    get_store(now);
    settings_.emplace(storage(), kSettingsArea);
    settings_->start(config_.settings);
    impose_motor(*settings_, config_);
    get_lines();
    open_motor();
    get_users_port();
    tell_stored_settings();
    start(now);
    if (!is_complete()) {
        controller_->sequence().withdraw(worst_lack(), now);
        try_at_ = now + kBetweenTries;
    } else {
        try_at_ = base::kNever;
        if (!told_lacks_.empty()) tell(LogLevel::notice, "has all that it needs");
        told_lacks_.clear();
    }
    watch_all();
}

/// Only what is missing. Whatever comes makes a new start, since settings, safe levels or the port depend on
/// it.
void Axis::try_again(base::Instant now) {
    try_at_ = now + kBetweenTries;
    const Lacks before = lacks_;
    if (!lacks_.store.empty()) get_store(now);
    if (!lacks_.lines.empty()) get_lines();
    if (!lacks_.port.empty()) get_users_port();
    const auto came = [](const std::string& then, const std::string& now_is) {
        return !then.empty() && now_is.empty();
    };
    if (came(before.store, lacks_.store) || came(before.lines, lacks_.lines) ||
        came(before.port, lacks_.port))
        begin(now);
}

SafeReason Axis::worst_lack() const {
    if (!lacks_.lines.empty()) return SafeReason::no_lines;
    return lacks_.store.empty() ? SafeReason::no_port : SafeReason::no_store;
}

/// Once for each reason, however often it is tried.
void Axis::lack(std::string& what, const std::string& why) {
    what = why;
    if (why.empty() || !told_lacks_.insert(why).second) return;
    tell(LogLevel::error, why + "; the axis is stopped, and tries again until it can have it");
}

ports::Storage& Axis::storage() {
    if (storage_) return *storage_;
    return no_storage_;
}

void Axis::get_store(base::Instant now) {
    if (storage_) return;
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error)
        return lack(
            lacks_.store,
            fmt::format("{}: cannot be made: {}; name another state_directory, or let this user write there",
                        folder_, error.message()));
    const std::string path = store_file(folder_);
    if (!marker_ && !look_at_marker(path)) return;
    auto opened = hal_linux::FileStorage::open(path, kMemory);
    lack(lacks_.store, opened.error);
    if (!opened.storage) return;
    file_ = std::move(opened.storage);
    storage_.emplace(*file_);
    if (!cause_) cause_ = is_after_crash() ? gateway::StartCause::watchdog : gateway::StartCause::power_up;
    if (is_running_) note_running(now);
}

/// What was stored is lost where a run is known and its store is missing.
bool Axis::look_at_marker(const std::string& path) {
    std::error_code error;
    marker_.emplace(folder_ + "/running");
    const bool has_store = fs::exists(path, error);
    const Found found = marker_->found();
    const bool is_new = found == Found::missing && !has_store;
    if (is_new) static_cast<void>(marker_->make());  // note_running() tells
    marker_is_bad_ = !is_new && (found == Found::missing || found == Found::damaged);
    if (has_store || is_new || found == Found::fresh) return true;
    lack(lacks_.store, replace_lost_store(path));
    if (!lacks_.store.empty()) marker_.reset();
    return lacks_.store.empty();
}

/// By one that says so until something is stored anew.
std::string Axis::replace_lost_store(const std::string& path) {
    tell(LogLevel::error, path +
                              " is missing, and with it what was stored; upload the table again, and set and "
                              "keep the settings, or put a copy there while the service is stopped");
    const std::string beside = path + ".new";
    std::error_code error;
    fs::remove(beside, error);
    {
        const auto made = hal_linux::FileStorage::open(beside, kMemory);
        if (!made.storage) return made.error;
        for (const store::Area& area : {kTableArea, kSettingsArea}) {
            if (!store::note_loss(*made.storage, area)) return beside + ": cannot be written";
        }
    }
    fs::rename(beside, path, error);
    return error ? path + ": cannot be made: " + error.message() : "";
}

/// Those that it has, and whose chip is there, it keeps.
void Axis::get_lines() {
    const auto safe = static_cast<std::uint8_t>(setting(Setting::safe_outputs));
    const std::string consumer = "nanoplc " + config_.name;
    lacks_.lines.clear();
    if (!has_outputs_ || outputs_->lost()) {
        const std::string error = output_bits_.take({config_.outputs, consumer, safe});
        has_outputs_ = error.empty();
        outputs_.emplace(output_bits_, safe);
        lack(lacks_.lines, error);
    }
    if (!has_inputs_ || inputs_->lost()) {
        const std::string error = input_bits_.take({config_.inputs, consumer, std::nullopt});
        has_inputs_ = error.empty();
        inputs_.emplace(input_bits_);
        if (!error.empty()) lack(lacks_.lines, error);
    }
    told_pins_lost_ = false;
}

/// A line that cannot be had is a lost link, and looked for by itself.
void Axis::open_motor() {
    motor_.open(config_.name, config_.motor, setting(Setting::motor_baud));
    if (!config_.motor.mactalk_port.is_there()) return;
    static_cast<void>(mactalk_port_.emplace().open(
        config_.name, {.path = config_.motor.mactalk_port.text, .baud = 19'200}));
}

void Axis::get_users_port() {
    if (!config_.user_port.is_there()) return;
    if (!is_endpoint(config_.user_port.text)) return get_user_uart();
    if (user_server_) return;
    const hal_linux::ByteServer::Settings settings{
        .mode = config_.socket_mode, .group = config_.socket_group.text, .at_once = is_running_};
    lack(lacks_.port, user_server_.emplace().open(config_.user_port.text, settings));
    if (!lacks_.port.empty()) user_server_.reset();
}

/// Nothing is left of one that cannot be had: the user's port is not served until the next start.
void Axis::get_user_uart() {
    user_line_.reset();
    lack(lacks_.port, open_user_uart());
    if (!lacks_.port.empty()) user_uart_.reset();
}

/// A stored speed that this port cannot do must not keep the person out who would set it back.
std::string Axis::open_user_uart() {
    const std::uint32_t stored = setting(Setting::user_baud);
    const std::uint32_t configured = config_.settings.get(Setting::user_baud);
    const std::string& path = config_.user_port.text;
    std::string error = user_uart_.emplace().open(config_.name, {.path = path, .baud = stored});
    if (error.empty() || stored == configured) return error;
    if (!user_uart_->open(config_.name, {.path = path, .baud = configured}).empty()) return error;
    tell(LogLevel::warning,
         fmt::format("{}; the configuration's {} baud are used: set user_baud anew", error, configured));
    return {};
}

/// A watchdog's reset is over once a run has ended in order since then.
bool Axis::is_after_crash() {
    const bool is_cut_off = marker_->found() == Found::running;
    const bool of_this_boot = marker_->of_this_boot();
    if (is_cut_off && of_this_boot) return true;
    if (board_.by_watchdog && !(of_this_boot && marker_->found() == Found::ended)) {
        tell(LogLevel::error, "a watchdog has reset the board");
        return true;
    }
    if (is_cut_off)
        tell(LogLevel::notice,
             "the board has restarted in the middle of a run, and no watchdog says that it did this: a power "
             "cut");
    return is_cut_off && board_.power_cut_waits;
}

/// In a store that is another program's the marker is so too.
void Axis::note_running(base::Instant now) {
    is_running_ = true;
    if (!storage_) return;
    const std::string error = marker_->set();
    is_marked_ = error.empty();
    if (is_marked_) return;
    tell(LogLevel::error, error + "; make room, or mend it, and restart the service");
    controller_->sequence().withdraw(SafeReason::bad_run_mark, now);
}

void Axis::note_orderly_end() {
    if (!storage_) return;
    if (const std::string error = marker_->clear(); !error.empty())
        tell(LogLevel::warning, error + "; the next start waits for `nanoctl run`");
}

void Axis::start(base::Instant now) {
    told_events_ = 0;
    tell_silence_at_ = now + kFirstAnswer;
    user_readable_ = true;
    inputs_->look();
    gateway::Controller::Ports ports{*inputs_, *outputs_, watchdog_, motor_.start(settings_->values()),
                                     storage()};
    if (user_server_) ports.user_line = &*user_server_;
    if (user_uart_) ports.user_line = &user_line_.emplace(user_uart_->uart());
    if (mactalk_port_) ports.motor_mactalk_line = &mactalk_port_->uart();
    controller_.emplace(ports, kTableArea, table_memory_, *settings_,
                        is_complete() ? *cause_ : gateway::StartCause::service);
    gateway::Gateway& sequence = controller_->sequence();
    sequence.pace(kPace);
    if (std::exchange(marker_is_bad_, false)) sequence.block_start(SafeReason::bad_run_mark);
    if (lacks_.store.empty()) load_table(now);
    if (!is_marked_) sequence.withdraw(SafeReason::bad_run_mark, now);
}

/// A table that cannot run leaves the axis stopped, and its port open for another one.
void Axis::load_table(base::Instant now) {
    const LoadedTable loaded = load_first_table(controller_->tables(), *settings_, config_, now);
    if (!loaded.fault.empty()) {
        controller_->sequence().block_start(SafeReason::bad_table);
        return tell(LogLevel::error, loaded.fault);
    }
    tell(LogLevel::info, loaded.where_from);
}

void Axis::tell_stored_settings() {
    for (const StoredSetting& other : stored_settings(*settings_, config_))
        tell(LogLevel::notice,
             fmt::format(
                 "setting {} is {}, as stored over the user's port; the configuration's {} is not used",
                 other.name, other.stored, other.configured));
}

}  // namespace nplc::boards
