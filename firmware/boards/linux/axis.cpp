#include "axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <filesystem>
#include <fstream>
#include <utility>

#include "table_file.h"
#include "words.h"

namespace nplc::boards {
namespace {

namespace fs = std::filesystem;
using store::Setting;

/// As flash pages of 2 KiB: two table slots of five, two settings slots of one.
constexpr ports::StorageGeometry kMemory{
    .size = 32 * 1024, .erase_block = 2048, .program_page = 256, .program_unit = 8};
constexpr store::Area kTableArea{.begin = 0, .slot_bytes = 5 * 2048};
constexpr store::Area kSettingsArea{.begin = 10 * 2048, .slot_bytes = 2048};

/// Marks of what is watched; serial lines have the first.
constexpr std::uint32_t kSerialLines = 0;
constexpr std::uint32_t kUserServer = 1;
constexpr std::uint32_t kFirstLine = 2;

constexpr base::Microseconds kPace{250};
/// Between two reads of the motor's status while nothing is under way.
constexpr base::Milliseconds kRest{5};
/// A motor that has not answered so long after the start is told of; one that is switched on with us needs
/// some time.
constexpr base::Milliseconds kFirstAnswer{5'000};
/// Until the store is done, for a reset.
constexpr base::Milliseconds kBetweenLooks{1};

std::string line_of_file(const std::string& path) {
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    return line;
}

std::string marker(const std::string& folder) {
    return folder + "/running";
}

}  // namespace

/// The levels may have been set anew since the start.
Axis::~Axis() {
    if (outputs_ && gateway_) outputs_->set_safe(gateway_->settings().safe_outputs);
}

void Axis::tell(LogLevel level, const std::string& text) {
    journal_.write(level, config_.name + ": " + text);
}

std::string Axis::open(const std::string& state_directory, base::Instant now) {
    folder_ = state_directory + "/" + config_.name;
    if (std::string error = open_store(folder_); !error.empty()) return error;
    settings_.emplace(*storage_, kSettingsArea);
    start_settings();
    if (std::string error = open_lines(); !error.empty()) return error;
    if (std::string error = open_ports(); !error.empty()) return error;
    const gateway::StartCause cause = cause_of_start();
    tell_stored_settings();
    return start(cause, now);
}

/// Which motor there is stands in the configuration, whatever was stored.
void Axis::start_settings() {
    settings_->start(config_.settings);
    for (const store::Setting setting : kOfTheMotor)
        settings_->impose(setting, config_.settings.get(setting));
}

std::string Axis::open_store(const std::string& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        return fmt::format(
            "{}: cannot be made: {}; name another state_directory, or let this user write there", folder,
            error.message());
    auto opened = hal_linux::FileStorage::open(folder + "/store.bin", kMemory);
    if (!opened.storage) return opened.error;
    file_ = std::move(opened.storage);
    storage_.emplace(*file_);
    return {};
}

std::string Axis::open_lines() {
    const auto safe = static_cast<std::uint8_t>(setting(Setting::safe_outputs));
    const std::string consumer = "nanoplc " + config_.name;
    if (std::string error = output_bits_.take({config_.outputs, consumer, safe}); !error.empty())
        return error;
    outputs_.emplace(output_bits_, safe);
    if (std::string error = input_bits_.take({config_.inputs, consumer, std::nullopt}); !error.empty())
        return error;
    inputs_.emplace(input_bits_);
    return {};
}

hal_linux::UartSettings Axis::uart_settings(const std::string& path, std::uint32_t baud) const {
    return {.path = path, .baud = baud};
}

std::string Axis::open_ports() {
    if (std::string error = motor_.open(config_.name, config_.motor, setting(Setting::motor_baud));
        !error.empty())
        return error;
    if (config_.motor.mactalk_port.is_there()) {
        const auto settings = uart_settings(config_.motor.mactalk_port.text, 19'200);
        if (std::string error = mactalk_port_.emplace().open(config_.name, settings); !error.empty())
            return error;
    }
    if (!config_.user_port.is_there()) return {};
    if (is_endpoint(config_.user_port.text)) {
        if (user_server_) return {};
        return user_server_.emplace().open(config_.user_port.text);
    }
    const auto settings = uart_settings(config_.user_port.text, setting(Setting::user_baud));
    return user_uart_.emplace().open(config_.name, settings);
}

/// A marker that is left over from this boot is of a run that did not end in order.
gateway::StartCause Axis::cause_of_start() const {
    const std::string boot = line_of_file("/proc/sys/kernel/random/boot_id");
    const bool crashed = !boot.empty() && line_of_file(marker(folder_)) == boot;
    return crashed ? gateway::StartCause::watchdog : gateway::StartCause::power_up;
}

void Axis::note_running() {
    std::ofstream(marker(folder_)) << line_of_file("/proc/sys/kernel/random/boot_id") << '\n';
}

void Axis::note_orderly_end() {
    std::error_code error;
    fs::remove(marker(folder_), error);
}

std::string Axis::start(gateway::StartCause cause, base::Instant now) {
    user_port_.reset();
    own_registers_.reset();
    tables_.reset();
    gateway_.reset();
    told_events_ = 0;
    tell_silence_at_ = now + kFirstAnswer;
    inputs_->look();
    motor::Motor& driver = motor_.start(settings_->values());
    const gateway::Gateway::Ports ports{*inputs_, *outputs_, watchdog_, driver};
    gateway_.emplace(ports, gateway::settings_of(settings_->values()), cause);
    gateway_->pace(kPace);
    settings_->attach(*gateway_);
    tables_.emplace(*gateway_, driver, *storage_, kTableArea, table_memory_);
    own_registers_.emplace(*gateway_, *tables_, *settings_);
    ports::SerialPort* user = &no_line_;
    if (user_server_) user = &*user_server_;
    if (user_uart_) user = &user_uart_->uart();
    user_port_.emplace(*user, mactalk_port_ ? &mactalk_port_->uart() : nullptr, *gateway_, driver,
                       *own_registers_, *settings_);
    return load_table(now);
}

std::string Axis::load_table(base::Instant now) {
    static_cast<void>(tables_->mount());
    const bool has_stored = tables_->stored().length != 0 || tables_->fell_back();
    if (has_stored || !config_.table.is_there()) {
        tables_->start(now);
        tell(LogLevel::info,
             has_stored ? "has a stored table" : "has no table; upload one with `nanoctl upload`");
        return {};
    }
    const TableFile table = read_table(config_.table.text);
    if (!table.error.empty()) return table.error;
    const auto result = tables_->use(table.bytes, now);
    if (!result.ok)
        return fmt::format("{}: term {}: {}; make it with `seqc build`", config_.table.text,
                           result.fault.term, sequencer::describe(result.fault.error));
    tell(LogLevel::info, fmt::format("runs {} while no table is stored", config_.table.text));
    return {};
}

void Axis::watch(hal_linux::EventLoop& loop, std::uint32_t mark) {
    loop_ = &loop;
    mark_ = mark;
    std::uint32_t line_mark = mark + kFirstLine;
    for (const int descriptor : input_bits_.descriptors()) loop.watch(descriptor, line_mark++);
    watch_ports();
    if (!user_server_) return;
    const bool is_terminal = config_.user_port.text.starts_with("pty:");
    loop.watch(
        user_server_->descriptor(), mark + kUserServer,
        is_terminal ? hal_linux::EventLoop::Wakes::at_news : hal_linux::EventLoop::Wakes::while_readable);
}

/// The motor's own MacTalk port is not among them: it is read when a person's message waits for its answer.
void Axis::watch_ports() {
    rests_until_ = base::kNever;
    motor_.watch(*loop_, mark_);
    if (user_uart_) loop_->watch(user_uart_->uart().descriptor(), mark_);
}

void Axis::note_readable(std::uint32_t mark) {
    const std::uint32_t which = mark - mark_;
    if (which >= kFirstLine) edges_ |= 1U << (which - kFirstLine);
    if (which == kUserServer) user_readable_ = true;
    if (which == kSerialLines) line_readable_ = true;
}

/// An edge tells its line's new level, and nothing else is asked for then. All lines are looked at whenever
/// something else is the cause, so an edge that a chip has missed is seen a little later.
void Axis::look_at_inputs() {
    std::uint32_t edges = std::exchange(edges_, 0);
    if (edges == 0) return inputs_->look();
    for (; edges != 0; edges &= edges - 1)
        inputs_->look_at(static_cast<std::size_t>(std::countr_zero(edges)));
}

/// While the motor's line was read a moment ago, as it is when nothing is under way.
bool Axis::is_edge_alone(base::Instant now) const {
    return edges_ != 0 && !line_readable_ && motor_.was_read_since(now - kRest);
}

/// After an edge the scan comes first, and its orders leave before the motor's status is read.
void Axis::run_sequence(base::Instant now) {
    const bool hurries = is_edge_alone(now);
    line_readable_ = false;
    look_at_inputs();
    if (hurries) gateway_->poll_inputs(now);
    motor_.open_line(now);
    motor::Motor& driver = motor_.driver();
    if (hurries) return driver.poll(now);
    gateway_->poll(now);
    if (motor_.next_poll(now) <= now) driver.poll(now);
}

void Axis::serve(base::Instant now) {
    if (failed_) return;
    run_sequence(now);
    if (user_server_ && (std::exchange(user_readable_, false) || user_server_->next_turn(now) <= now))
        user_server_->take_in(now, {static_cast<std::uint8_t>(setting(Setting::gateway_address)),
                                    static_cast<std::uint8_t>(setting(Setting::motor_address))});
    user_port_->poll(now);
    bool is_back = motor_.look(journal_, now);
    if (mactalk_port_) mactalk_port_->look(journal_, now);
    if (user_uart_) is_back = user_uart_->look(journal_, now) || is_back;
    if (is_back) watch_ports();
    rest_or_watch(now);
    watch_pins(now);
    tell_news(now);
    if (own_registers_->reset_asked() && !stores()) reset(now);
}

/// As after a power-up. Without its ports the axis is dead; the watchdog, if there is one, restarts all.
void Axis::reset(base::Instant now) {
    tell(LogLevel::notice, "reset over the user's port");
    settings_.emplace(*storage_, kSettingsArea);
    start_settings();
    std::string error = open_ports();
    if (error.empty()) error = start(gateway::StartCause::power_up, now);
    if (error.empty()) return watch_ports();
    write_safe_outputs();
    failed_ = true;
    tell(LogLevel::error, error + "; this axis does nothing any more: restart the service");
}

/// A JVL motor repeats its status without pause, 1920 bytes a second. While nothing is under way it is read
/// every few milliseconds instead of at every byte: an edge or a message wakes the program all the same.
void Axis::rest_or_watch(base::Instant now) {
    const bool rested = rests_until_ != base::kNever;
    const bool is_quiet = motor_.may_rest();
    rests_until_ = is_quiet ? now + kRest : base::kNever;
    if (is_quiet && !rested) motor_.ignore(*loop_);
    if (!is_quiet && rested) watch_ports();
}

/// Its descriptors are readable all the time then, and are left alone.
void Axis::note_lost_pins() {
    told_pins_lost_ = true;
    for (const int descriptor : input_bits_.descriptors()) loop_->ignore(descriptor);
    tell(LogLevel::error,
         "SAFE: a GPIO chip is gone; its lines read 0 and nothing can be switched; restart the service "
         "when it is back");
}

void Axis::watch_pins(base::Instant now) {
    if (!inputs_->lost() && !outputs_->lost()) return;
    if (!told_pins_lost_) note_lost_pins();
    if (gateway_->run_state() != gateway::RunState::stopped) gateway_->make_safe(now);
}

base::Instant Axis::next(base::Instant now) {
    if (failed_) return base::kNever;
    if (own_registers_->reset_asked()) return now + kBetweenLooks;
    base::Instant next =
        std::min(gateway_->next_poll(now, motor_.next_poll(now)), user_port_->next_poll(now));
    next = std::min({next, rests_until_, tell_silence_at_, motor_.next_look()});
    if (mactalk_port_) next = std::min(next, mactalk_port_->next_look());
    if (user_uart_) next = std::min(next, user_uart_->next_look());
    if (user_server_) next = std::min(next, user_server_->next_turn(now));
    return next;
}

void Axis::begin_end(base::Instant now) {
    if (failed_) return;
    gateway_->make_safe(now);
}

bool Axis::has_stopped() const {
    return failed_ || !motor::delivers(motor_.driver().link()) || motor_.driver().settled();
}

void Axis::write_safe_outputs() {
    if (outputs_) outputs_->write(gateway_ ? gateway_->settings().safe_outputs : std::uint8_t{0});
}

void Axis::tell_news(base::Instant now) {
    const gateway::EventLog& log = gateway_->log();
    if (log.count() < told_events_) told_events_ = 0;  // it was cleared
    if (log.count() - told_events_ > gateway::EventLog::kSlots)
        told_events_ = log.count() - static_cast<std::uint32_t>(gateway::EventLog::kSlots);
    for (; told_events_ != log.count(); ++told_events_) {
        const Said said = in_words(log.slot(told_events_ % gateway::EventLog::kSlots));
        tell(said.level, said.text);
    }
    for (const Said& said : motor_.news()) tell(said.level, said.text);
    const motor::Link link = motor_.driver().link();
    if (motor::delivers(link)) tell_silence_at_ = base::kNever;
    if (now >= tell_silence_at_) {
        tell_silence_at_ = base::kNever;
        tell(LogLevel::warning,
             fmt::format("no motor has answered yet on {}; look at its supply, its line, and at [axis.motor]",
                         config_.motor.line_in_words()));
    }
    if (motor::delivers(link) == motor::delivers(told_link_)) return;
    told_link_ = link;
    if (motor::delivers(link))
        tell(LogLevel::notice, "the motor answers on " + config_.motor.line_in_words());
    else
        tell(LogLevel::warning, "the motor does not answer on " + config_.motor.line_in_words());
}

void Axis::tell_stored_settings() {
    for (const store::SettingInfo& info : store::all_settings()) {
        const std::uint32_t stored = settings_->get(info.id);
        const std::uint32_t configured = config_.settings.get(info.id);
        if (stored == configured) continue;
        tell(LogLevel::notice,
             fmt::format(
                 "setting {} is {}, as stored over the user's port; the configuration's {} is not used",
                 info.name, stored, configured));
    }
}

std::string Axis::state_in_words() const {
    using gateway::RunState;
    const bool is_safe = gateway_->safe_reason() != gateway::SafeReason::none;
    const char* const link = motor::delivers(motor_.driver().link()) ? "" : ", no motor";
    switch (gateway_->run_state()) {
        case RunState::stopped:
            return fmt::format("{} stopped{}", config_.name, link);
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
