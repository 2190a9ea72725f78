#include "axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "host/endpoint.h"
#include "log_messages.h"

namespace nplc::boards {
namespace {

using store::Setting;

/// Marks of what is watched; serial lines have the first.
constexpr std::uint32_t kSerialLines = 0;
constexpr std::uint32_t kUserServer = 1;
constexpr std::uint32_t kFirstLine = 2;

/// Between two reads of the motor's status while nothing is under way.
constexpr base::Milliseconds kUnwatched{5};
/// Until the store is done, for a reset.
constexpr base::Milliseconds kBetweenLooks{1};

}  // namespace

/// The levels may have been set anew since the start.
Axis::~Axis() {
    if (outputs_ && controller_) outputs_->set_safe(controller_->sequence().settings().safe_outputs);
}

void Axis::tell(LogLevel level, const std::string& text) {
    journal_.write(level, config_.name + ": " + text);
}

void Axis::watch(hal_linux::EventLoop& loop, std::uint32_t mark) {
    loop_ = &loop;
    mark_ = mark;
    watch_all();
}

void Axis::watch_all() {
    if (loop_ == nullptr) return;
    std::uint32_t line_mark = mark_ + kFirstLine;
    edges_ = 0;
    for (const int descriptor : input_bits_.descriptors()) loop_->watch(descriptor, line_mark++);
    watch_ports();
    if (!user_server_) return;
    const bool is_terminal = host::Endpoint(config_.user_port.text).kind == host::Endpoint::Kind::pty;
    loop_->watch(
        user_server_->descriptor(), mark_ + kUserServer,
        is_terminal ? hal_linux::EventLoop::Wakes::at_news : hal_linux::EventLoop::Wakes::while_readable);
}

/// The motor's own MacTalk port is not among them: it is read when a person's message waits for its answer.
void Axis::watch_ports() {
    unwatched_until_ = base::kNever;
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
    return edges_ != 0 && !line_readable_ && motor_.was_read_since(now - kUnwatched);
}

void Axis::look_at_user(base::Instant now) {
    const auto address = [this](Setting which) { return static_cast<std::uint8_t>(setting(which)); };
    if (user_server_ && (std::exchange(user_readable_, false) || user_server_->next_turn(now) <= now))
        user_server_->look(now, {address(Setting::gateway_address), address(Setting::motor_address)});
    if (user_line_) user_line_->look(now, address(Setting::gateway_address));
}

/// After an edge the scan comes first, and its orders leave before the motor's status is read.
void Axis::poll_controller(base::Instant now) {
    const bool hurries = is_edge_alone(now);
    line_readable_ = false;
    look_at_inputs();
    look_at_user(now);
    motor_.open_line(now);
    hurries ? controller_->poll_after_edge(now) : controller_->poll(now);
}

void Axis::serve(base::Instant now) {
    if (now >= try_at_) try_again(now);
    poll_controller(now);
    bool is_back = motor_.look(journal_, now);
    if (mactalk_port_) mactalk_port_->look(journal_, now);
    if (user_uart_) is_back = user_uart_->look(journal_, now) || is_back;
    if (is_back) watch_ports();
    watch_or_wait(now);
    watch_pins(now);
    tell_news(now);
    if (controller_->reset_asked() && !stores()) reset(now);
}

/// As after a power-up.
void Axis::reset(base::Instant now) {
    tell(LogLevel::notice, "reset over the user's port");
    if (storage_) cause_ = gateway::StartCause::power_up;
    begin(now);
}

/// A JVL motor repeats its status without pause, 1920 bytes a second. While nothing is under way it is read
/// every few milliseconds instead of at every byte: an edge or a message wakes the program all the same.
void Axis::watch_or_wait(base::Instant now) {
    const bool rested = unwatched_until_ != base::kNever;
    const bool is_quiet = motor_.needs_no_watch();
    unwatched_until_ = is_quiet ? now + kUnwatched : base::kNever;
    if (is_quiet && !rested) motor_.ignore(*loop_);
    if (!is_quiet && rested) watch_ports();
}

/// Its descriptors are readable all the time then, and are left alone.
void Axis::note_lost_pins() {
    told_pins_lost_ = true;
    for (const int descriptor : input_bits_.descriptors()) loop_->ignore(descriptor);
    tell(
        LogLevel::error,
        "SAFE: a GPIO chip is gone; its lines read 0 and nothing can be switched; `nanoctl reset` when it is "
        "back");
}

void Axis::watch_pins(base::Instant now) {
    if (told_pins_lost_ || (!inputs_->lost() && !outputs_->lost())) return;
    note_lost_pins();
    controller_->sequence().withdraw(gateway::SafeReason::no_lines, now);
}

base::Instant Axis::next(base::Instant now) {
    if (controller_->reset_asked()) return now + kBetweenLooks;
    base::Instant next = controller_->next_poll(now, motor_.next_poll(now));
    next = std::min({next, unwatched_until_, tell_silence_at_, try_at_, motor_.next_look()});
    if (mactalk_port_) next = std::min(next, mactalk_port_->next_look());
    if (user_uart_) next = std::min({next, user_uart_->next_look(), user_line_->next_look()});
    if (user_server_) next = std::min(next, user_server_->next_turn(now));
    return next;
}

void Axis::begin_end(base::Instant now) {
    controller_->sequence().make_safe(now);
}

bool Axis::has_stopped() const {
    return !motor::delivers(motor_.driver().link()) || motor_.driver().settled();
}

void Axis::write_safe_outputs() {
    if (!outputs_) return;
    outputs_->write(controller_ ? controller_->sequence().settings().safe_outputs : std::uint8_t{0});
}

void Axis::tell_news(base::Instant now) {
    const gateway::EventLog& log = controller_->sequence().log();
    if (log.count() < told_events_) told_events_ = 0;  // it was cleared
    if (log.count() - told_events_ > gateway::EventLog::kSlots)
        told_events_ = log.count() - static_cast<std::uint32_t>(gateway::EventLog::kSlots);
    for (; told_events_ != log.count(); ++told_events_) {
        const LogMessage said = in_words(log.slot(told_events_ % gateway::EventLog::kSlots));
        tell(said.level, said.text);
    }
    for (const LogMessage& said : motor_.news()) tell(said.level, said.text);
    const motor::Link link = motor_.driver().link();
    if (motor::delivers(link)) tell_silence_at_ = base::kNever;
    if (now >= tell_silence_at_) {
        tell_silence_at_ = base::kNever;
        tell(LogLevel::warning, motor_.silence_in_words());
    }
    if (motor::delivers(link) == motor::delivers(told_link_)) return;
    told_link_ = link;
    if (motor::delivers(link))
        tell(LogLevel::notice, "the motor answers on " + config_.motor.line_in_words());
    else
        tell(LogLevel::warning, motor_.loss_in_words());
}

std::string Axis::state_in_words() const {
    using gateway::RunState;
    const bool is_safe = controller_->sequence().safe_reason() != gateway::SafeReason::none;
    const char* const link = motor::delivers(motor_.driver().link()) ? "" : ", no motor";
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
