#include "service.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <csignal>

#include "exit_codes.h"

namespace nplc::boards {
namespace {

constexpr std::array kEndSignals{SIGTERM, SIGINT, SIGHUP, SIGQUIT};
constexpr std::array kFatalSignals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGSYS};
/// Timeout for the motor's confirmation of the stop at the end.
constexpr base::Milliseconds kLongestEnd{2'000};

/// Used by the fatal-signal handler, which cannot get other parameters.
std::array<Axis*, 16> last_resort{};

void die_safely(int signal) {
    for (Axis* axis : last_resort) {
        if (axis != nullptr) axis->write_safe_outputs();
    }
    ::raise(signal);  // the handler was reset to the default action
}

void catch_fatal_signals() {
    for (const int signal : kFatalSignals) {
        struct sigaction action {};
        action.sa_handler = die_safely;
        action.sa_flags = static_cast<int>(SA_RESETHAND | SA_NODEFER);
        ::sigaction(signal, &action, nullptr);
    }
    std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace

ports::Watchdog& CommonWatchdog::add() {
    return *parts_.emplace_back(std::make_unique<Part>(*this));
}

void CommonWatchdog::Part::feed() {
    fed_ = true;
    whole_.look();
}

void CommonWatchdog::look() {
    if (!std::all_of(parts_.begin(), parts_.end(), [](const auto& part) { return part->fed_; })) return;
    for (const auto& part : parts_) part->fed_ = false;
    for (ports::Watchdog* target : targets_) target->feed();
}

Service::~Service() {
    plant_.close();
    last_resort.fill(nullptr);
}

std::string Service::open() {
    auto loop = hal_linux::EventLoop::open(kEndSignals);
    if (!loop.loop) return loop.error;
    loop_ = std::move(loop.loop);
    auto service = hal_linux::ServiceWatchdog::open();
    if (!service.watchdog) return service.error;
    service_ = std::move(service.watchdog);
    std::vector<ports::Watchdog*> targets{service_.get()};
    watchdog_time_ = service_->timeout();
    if (config_.watchdog_device.is_there()) {
        const base::Milliseconds time(1000 * config_.watchdog_seconds);
        auto device = hal_linux::DeviceWatchdog::open(config_.watchdog_device.text, time);
        if (!device.watchdog) return device.error;
        device_ = std::move(device.watchdog);
        targets.push_back(device_.get());
        watchdog_time_ = std::min(watchdog_time_.value_or(device_->timeout()), device_->timeout());
    }
    watchdog_ = std::make_unique<CommonWatchdog>(std::move(targets));
    catch_fatal_signals();
    std::optional<bool> tells_resets;
    if (device_) tells_resets = device_->tells_resets();
    const BoardStart board{
        hal_linux::DeviceWatchdog::any_has_reset_board() || (device_ && device_->has_reset_board()),
        power_cut_waits(config_.power_cut_waits, tells_resets)};
    if (const std::string& fault = commissioned_.fault(); !fault.empty())
        journal_.write(LogLevel::warning, JournalEvent::bad_list,
                       fault + "; which axes were in use before is not known");
    const base::Instant now = clock_.now();
    for (const AxisConfig& config : config_.axes) {
        axes_.push_back(std::make_unique<Axis>(config, journal_, watchdog_->add(), commissioned_));
        last_resort[axes_.size() - 1] = axes_.back().get();
        axes_.back()->open(config_.state_directory, board, now);
    }
    for (const auto& axis : axes_) axis->note_running(now);
    for (std::size_t i = 0; i < axes_.size(); ++i)
        axes_[i]->watch(*loop_, static_cast<std::uint32_t>(i) * Axis::kMarks);
    next_.assign(axes_.size(), base::Instant{});
    panel_.open(axes_);
    faces::Axes models;
    for (const auto& axis : axes_) models.push_back(&axis->model());
    plant_.open(std::move(models), now);
    return {};
}

void Service::set_up_real_time() {
    for (const std::string& missed : hal_linux::set_up_real_time(config_.real_time))
        journal_.write(LogLevel::warning, JournalEvent::no_real_time, missed);
}

int Service::run() {
    if (const std::string error = open(); !error.empty()) {
        journal_.write(LogLevel::error, JournalEvent::service_failed, error);
        for (const auto& axis : axes_) axis->write_safe_outputs();
        if (device_) static_cast<void>(device_->disarm());
        return kNoDevice;
    }
    set_up_real_time();
    service_->ready();
    journal_.write(LogLevel::notice, JournalEvent::service_started,
                   fmt::format("started with {} {}", axes_.size(), axes_.size() == 1 ? "axis" : "axes"));
    serve_until_signal();
    end_in_order();
    return kDone;
}

base::Instant Service::wanted_by_watchdog() const {
    return watchdog_time_ ? all_served_ + *watchdog_time_ / 3 : base::kNever;
}

void Service::wait_and_serve(base::Instant latest) {
    base::Instant deadline = std::min({latest, wanted_by_watchdog(), plant_.next()});
    for (const base::Instant next : next_) deadline = std::min(deadline, next);
    const auto marks = loop_->wait(deadline);
    const base::Instant now = clock_.now();
    const bool all = now >= wanted_by_watchdog();
    if (all) all_served_ = now;
    if (now >= plant_.next()) plant_.look(now);
    for (const std::uint32_t mark : marks) {
        next_[mark / Axis::kMarks] = now;
        axes_[mark / Axis::kMarks]->note_readable(mark);
    }
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        if (!all && next_[i] > now) continue;
        axes_[i]->serve(now);
        next_[i] = axes_[i]->next(now);
    }
}

void Service::show_status() {
    if (!service_->has_service()) return;
    std::string status;
    for (const auto& axis : axes_) status += (status.empty() ? "" : "; ") + axis->state_in_words();
    if (status == shown_status_) return;
    shown_status_ = status;
    service_->status(status);
}

void Service::tell_of_list() {
    const auto outcome = commissioned_.poll();
    if (outcome && !outcome->empty())
        journal_.write(LogLevel::warning, JournalEvent::bad_list,
                       *outcome + "; an axis whose folder is lost will be taken for a new one");
}

void Service::serve_until_signal() {
    for (;;) {
        wait_and_serve(base::kNever);
        tell_of_list();
        show_status();
        if (const auto signal = loop_->signal()) {
            journal_.write(LogLevel::notice, JournalEvent::service_ends,
                           fmt::format("ends: {}", ::strsignal(*signal)));
            return;
        }
    }
}

void Service::end_in_order() {
    service_->stopping();
    const base::Instant now = clock_.now();
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        axes_[i]->begin_shutdown(now);
        next_[i] = now;
    }
    const base::Instant limit = now + kLongestEnd;
    const auto stopped = [](const auto& axis) { return axis->has_stopped(); };
    do {
        wait_and_serve(limit);
    } while (clock_.now() < limit && !std::all_of(axes_.begin(), axes_.end(), stopped));
    for (const auto& axis : axes_) {
        if (axis->has_stopped()) {
            axis->mark_clean_shutdown();
            continue;
        }
        axis->note_unstopped_end();
    }
    last_resort.fill(nullptr);
    panel_.close();
    plant_.close();
    axes_.clear();
    if (!device_) return;
    if (const std::string error = device_->disarm(); !error.empty())
        journal_.write(LogLevel::warning, JournalEvent::watchdog_failed, error);
}

}  // namespace nplc::boards
