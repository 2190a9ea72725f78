#include "axis.h"

#include <fmt/format.h>

#include <algorithm>

#include "stored.h"

namespace nplc::boards {
namespace {

using gateway::SafeReason;
using store::Setting;

/// Event loop marks; serial lines have the first one.
constexpr std::uint32_t kSerialLines = 0;
constexpr std::uint32_t kUserServer = 1;
constexpr std::uint32_t kFaces = 2;
constexpr std::uint32_t kFirstLine = 3;

constexpr base::Milliseconds kBetweenTries{500};
constexpr base::Microseconds kPace{250};
/// Read interval of the motor's status while nothing is in progress.
constexpr base::Milliseconds kUnwatched{5};
/// Poll interval for the end of a store operation before a reset.
constexpr base::Milliseconds kBetweenLooks{1};

}  // namespace

/// The safe levels may have been changed since the start.
Axis::~Axis() {
    if (controller_) pins_.set_safe(controller_->sequence().settings().safe_outputs);
}

void Axis::open(const std::string& state_directory, const BoardStart& board, base::Instant now) {
    board_ = board;
    folder_ = state_directory + "/" + config_.name;
    begin(now);
}

/// Outputs first, at their safe levels, as far as the settings with these levels can be read.
void Axis::begin(base::Instant now) {
    missing_ = {};
    open_store(now);
    settings_.emplace(store_.storage(), kSettingsArea);
    settings_->start(config_.settings);
    impose_motor(*settings_, config_);
    open_pins();
    open_motor();
    open_user_port();
    tell_stored_settings();
    start(now);
    if (!is_complete()) {
        controller_->sequence().lock_and_enter_safe_state(missing_reason(), now);
        try_at_ = now + kBetweenTries;
    } else {
        try_at_ = base::kNever;
        if (!reported_missing_.empty())
            journal_.write(LogLevel::notice, JournalEvent::complete, "has all that it needs");
        reported_missing_.clear();
    }
    watch_all();
}

/// Retries only the missing resources. If one becomes available the axis starts again, since settings, safe
/// levels or the port depend on it.
void Axis::try_again(base::Instant now) {
    try_at_ = now + kBetweenTries;
    const Missing before = missing_;
    if (!missing_.store.empty()) open_store(now);
    if (!missing_.lines.empty()) open_pins();
    if (!missing_.port.empty()) open_user_port();
    const auto came = [](const std::string& then, const std::string& now_is) {
        return !then.empty() && now_is.empty();
    };
    if (came(before.store, missing_.store) || came(before.lines, missing_.lines) ||
        came(before.port, missing_.port))
        begin(now);
}

SafeReason Axis::missing_reason() const {
    if (!missing_.lines.empty()) return SafeReason::no_lines;
    return missing_.store.empty() ? SafeReason::no_port : SafeReason::no_store;
}

/// Logs each reason once, over all retries.
void Axis::note_missing(std::string& what, SafeReason cause, const std::string& why) {
    what = why;
    if (why.empty() || !reported_missing_.insert(why).second) return;
    journal_.write(LogLevel::error, JournalEvent::missing,
                   why + "; the axis is stopped, and tries again until it can have it", cause_field(cause));
}

void Axis::open_store(base::Instant now) {
    if (store_.is_open()) return;
    note_missing(missing_.store, SafeReason::no_store, store_.open(folder_));
    if (!store_.is_open()) return;
    using gateway::StartCause;
    if (!cause_) cause_ = store_.is_after_crash(board_) ? StartCause::watchdog : StartCause::power_up;
    if (is_running_) note_running(now);
}

void Axis::open_pins() {
    missing_.lines.clear();
    for (const std::string& error :
         pins_.open(config_, static_cast<std::uint8_t>(setting(Setting::safe_outputs))))
        note_missing(missing_.lines, SafeReason::no_lines, error);
}

/// A line that cannot be opened counts as a lost link and is retried separately.
void Axis::open_motor() {
    motor_.open(config_.motor, setting(Setting::motor_baud));
    if (config_.motor.mactalk_port.is_there()) mactalk_.open(config_.motor.mactalk_port.text);
}

void Axis::open_user_port() {
    note_missing(missing_.port, SafeReason::no_port,
                 user_.open(config_, setting(Setting::user_baud), is_running_, faces_.seat()));
}

void Axis::start(base::Instant now) {
    reporter_.start(now);
    pins_.inputs().look();
    gateway::Controller::Ports ports{pins_.inputs(), pins_.outputs(), watchdog_,
                                     motor_.start(settings_->values()), store_.storage()};
    user_.start();
    ports.motor_mactalk_line =
        mactalk_.start(ports.motor, static_cast<std::uint8_t>(setting(Setting::motor_address)));
    ports.set_points = &kSetPointArea;
    controller_.emplace(ports, kTableArea, table_memory_, *settings_,
                        is_complete() ? *cause_ : gateway::StartCause::service);
    faces_.restarted();
    gateway::Gateway& sequence = controller_->sequence();
    sequence.pace(kPace);
    block_start();
    if (missing_.store.empty()) load_table(now);
    if (!store_.is_marked()) sequence.lock_and_enter_safe_state(SafeReason::bad_run_mark, now);
}

void Axis::block_start() {
    gateway::Gateway& sequence = controller_->sequence();
    if (!store_.is_open()) return;
    switch (store_.permission()) {
        case AutostartPermission::given:
            if (is_unstopped_) sequence.block_start(SafeReason::stop_command);
            return;
        case AutostartPermission::first_run:
            controller_->registers().store_traces().note(store_.trace());
            return sequence.wait_for_mark(SafeReason::not_started);
        case AutostartPermission::after_crash:
            return sequence.wait_for_mark(SafeReason::watchdog);
        case AutostartPermission::bad_mark:
        case AutostartPermission::lost:
            return sequence.wait_for_mark(SafeReason::bad_run_mark);
    }
}

/// With a table that cannot run the axis stays stopped, and its port is open for another table.
void Axis::load_table(base::Instant now) {
    const LoadedTable loaded = load_first_table(controller_->tables(), *settings_, config_, now);
    if (!loaded.fault.empty()) {
        controller_->sequence().block_start(SafeReason::bad_table);
        return journal_.write(LogLevel::error, JournalEvent::bad_table, loaded.fault,
                              cause_field(SafeReason::bad_table));
    }
    journal_.write(LogLevel::info, JournalEvent::table_loaded, loaded.where_from);
}

void Axis::tell_stored_settings() {
    for (const StoredSetting& other : stored_settings(*settings_, config_))
        journal_.write(
            LogLevel::notice, JournalEvent::setting_unused,
            fmt::format(
                "setting {} is {}, as stored over the user's port; the configuration's {} is not used",
                other.name, other.stored, other.configured));
}

/// Restarts the axis as after a power-up. A stop that the motor has not confirmed is not forgotten.
void Axis::reset(base::Instant now) {
    journal_.write(LogLevel::notice, JournalEvent::reset, "reset over the user's port");
    is_unstopped_ = controller_->sequence().stop_unconfirmed();
    if (store_.is_open()) cause_ = gateway::StartCause::power_up;
    begin(now);
}

void Axis::note_running(base::Instant now) {
    is_running_ = true;
    const std::string error = store_.mark_running();
    if (error.empty()) return;
    journal_.write(LogLevel::error, JournalEvent::run_mark_failed,
                   error + "; make room, or mend it, and restart the service",
                   cause_field(SafeReason::bad_run_mark));
    controller_->sequence().lock_and_enter_safe_state(SafeReason::bad_run_mark, now);
}

/// A run waits for it before its first scan; one that was stopped meanwhile has been commanded all the same.
void Axis::give_permission(base::Instant now) {
    gateway::Gateway& sequence = controller_->sequence();
    is_giving_ = is_giving_ || sequence.wants_mark();
    if (!is_giving_) return;
    const auto outcome = store_.give_permission(now);
    is_giving_ = !outcome.has_value();
    if (!outcome) return;
    if (outcome->empty()) return sequence.mark_run();
    journal_.write(LogLevel::error, JournalEvent::run_mark_failed,
                   *outcome + "; it has not started, `nanoctl run` again",
                   cause_field(SafeReason::bad_run_mark));
    if (sequence.wants_mark()) sequence.refuse_run_mark();
}

void Axis::mark_clean_shutdown() {
    if (const std::string error = store_.mark_ended(); !error.empty())
        journal_.write(LogLevel::warning, JournalEvent::run_mark_failed,
                       error + "; the next start waits for `nanoctl run`");
}

void Axis::note_unstopped_end() {
    const bool answers = motor_.has_driver() && motor::link_is_usable(motor_.driver().link());
    journal_.write(
        LogLevel::warning, JournalEvent::end_unstopped,
        fmt::format("the motor {}; it may be moving. The next start waits for `nanoctl run`",
                    answers ? "has not confirmed the stop" : "does not answer and could not be told to stop"),
        answers ? JournalFields{} : cause_field(SafeReason::link_down));
    if (const std::string error = store_.mark_crashed(); !error.empty())
        journal_.write(LogLevel::warning, JournalEvent::run_mark_failed, error);
}

void Axis::watch(hal_linux::EventLoop& loop, std::uint32_t mark) {
    loop_ = &loop;
    mark_ = mark;
    watch_all();
}

void Axis::watch_all() {
    if (loop_ == nullptr) return;
    pins_.watch(*loop_, mark_ + kFirstLine);
    watch_ports();
    loop_->watch(faces_.descriptor(), mark_ + kFaces);
    user_.watch_server(*loop_, mark_ + kUserServer);
}

/// Without the motor's own MacTalk port: it is polled while a client waits for its answer.
void Axis::watch_ports() {
    unwatched_until_ = base::kNever;
    motor_.watch(*loop_, mark_);
    user_.watch_serial_port(*loop_, mark_);
}

void Axis::note_readable(std::uint32_t mark) {
    const std::uint32_t which = mark - mark_;
    if (which >= kFirstLine) pins_.note_edge(which - kFirstLine);
    if (which == kUserServer) user_.note_readable();
    if (which == kSerialLines) line_readable_ = true;
}

/// The motor's line was read recently, as it is while nothing is in progress.
bool Axis::is_edge_alone(base::Instant now) const {
    return pins_.has_edges() && !line_readable_ && motor_.was_read_since(now - kUnwatched);
}

void Axis::look_at_user(base::Instant now) {
    const auto address = [this](Setting which) { return static_cast<std::uint8_t>(setting(which)); };
    user_.look(*controller_, {address(Setting::gateway_address), address(Setting::motor_address)}, now);
}

/// After an input edge the scan comes first, and its orders are sent before the motor's status is read.
void Axis::poll_controller(base::Instant now) {
    const bool hurries = is_edge_alone(now);
    line_readable_ = false;
    pins_.read_inputs();
    look_at_user(now);
    motor_.open_line(now);
    hurries ? controller_->poll_after_edge(now) : controller_->poll(now);
    user_.answer(*controller_, now);
}

void Axis::serve(base::Instant now) {
    const bool is_storing = store_.is_busy() || controller_->set_points().stores();
    if (now >= try_at_ && !is_storing) try_again(now);
    poll_controller(now);
    faces_.poll(*controller_, motor_.any_driver(), now, now);
    bool is_back = motor_.look(journal_, now);
    mactalk_.look(controller_->sequence(), journal_, now);
    is_back = user_.look_for_serial_port(now) || is_back;
    if (is_back) watch_ports();
    watch_or_wait(now);
    watch_pins(now);
    give_permission(now);
    if (const auto news = faces_.seat().take_news())
        journal_.write(LogLevel::notice, JournalEvent::new_operator,
                       fmt::format("operator: {} took over from {}", news->by.name, news->from.name));
    reporter_.set_store(store_.is_open());
    reporter_.report(*controller_, motor_, faces_.seat().holder(), now);
    if (controller_->reset_asked() && !store_.is_busy()) reset(now);
}

/// A JVL motor repeats its status without pause, 1920 bytes a second. While nothing is in progress it is read
/// every few milliseconds instead of at every byte; an edge or a message still wakes the program.
void Axis::watch_or_wait(base::Instant now) {
    const bool rested = unwatched_until_ != base::kNever;
    const bool is_quiet = motor_.needs_no_watch();
    unwatched_until_ = is_quiet ? now + kUnwatched : base::kNever;
    if (is_quiet && !rested) motor_.ignore(*loop_);
    if (!is_quiet && rested) watch_ports();
}

void Axis::watch_pins(base::Instant now) {
    if (!pins_.is_newly_lost(*loop_)) return;
    journal_.write(
        LogLevel::error, JournalEvent::missing,
        "SAFE: a GPIO chip is gone; its lines read 0 and nothing can be switched; `nanoctl reset` when it is "
        "back",
        cause_field(SafeReason::no_lines));
    controller_->sequence().lock_and_enter_safe_state(SafeReason::no_lines, now);
}

base::Instant Axis::next(base::Instant now) {
    if (controller_->reset_asked() || is_giving_) return now + kBetweenLooks;
    base::Instant next = controller_->next_poll(now, motor_.next_poll(now));
    next = std::min(
        {next, unwatched_until_, reporter_.next_report(), try_at_, motor_.next_look(), user_.next_look()});
    next = std::min(next, faces_.next(*controller_));
    next = std::min(next, mactalk_.next_look(now));
    controller_->sequence().expect_poll(next, now);
    return next;
}

void Axis::begin_shutdown(base::Instant now) {
    controller_->sequence().enter_safe_state_by_command(now);
}

bool Axis::has_stopped() const {
    return !controller_->sequence().stop_unconfirmed();
}

void Axis::write_safe_outputs() {
    pins_.write(controller_ ? controller_->sequence().settings().safe_outputs : std::uint8_t{0});
}

std::string Axis::state_in_words() const {
    using gateway::RunState;
    const bool is_safe = controller_->sequence().safe_reason() != SafeReason::none;
    const char* const link = motor::link_is_usable(motor_.driver().link()) ? "" : ", no motor";
    switch (controller_->sequence().run_state()) {
        case RunState::stopped:
            return fmt::format("{} stopped{}{}", config_.name, is_complete() ? "" : ", incomplete", link);
        case RunState::waiting_for_motor:
            return fmt::format("{} waits for its motor", config_.name);
        case RunState::running:
            return fmt::format("{} {}{}", config_.name, is_safe ? "SAFE" : "runs", link);
        case RunState::holding:
        case RunState::held:
            return fmt::format("{} held{}", config_.name, link);
    }
    return config_.name;
}

}  // namespace nplc::boards
