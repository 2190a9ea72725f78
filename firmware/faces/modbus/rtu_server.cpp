#include "modbus/rtu_server.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <utility>

#include "hal_linux/quiet_thread.h"
#include "hal_linux/steady_clock.h"
#include "hal_linux/wakeup.h"
#include "rtu_line.h"
#include "rtu_slave.h"

namespace nplc::modbus {

/// The thread's main loop.
class RtuServer::Loop {
  public:
    Loop(const Options& options, const faces::Axes& axes)
        : options_(options),
          slave_({.baud = options.baud, .unit = options.unit, .settings = options.settings}, axes) {}
    Loop(const Loop&) = delete;
    Loop& operator=(const Loop&) = delete;

    std::string open();
    void run();
    void end() {
        ends_ = true;
        wakeup_.ring();
    }

  private:
    void wait();
    void read(base::Instant now);
    bool has_more();
    void send(base::Instant now);

    Options options_;
    hal_linux::SteadyClock clock_;
    hal_linux::Wakeup wakeup_;
    faces::Bell bell_{[this] { wakeup_.ring(); }};
    RtuSlave slave_;
    std::unique_ptr<RtuLine> line_;
    std::array<pollfd, 2> polled_{};
    base::Instant empty_at_{};  ///< last time when no data were pending
    std::atomic<bool> ends_{false};
};

std::string RtuServer::Loop::open() {
    auto opened = RtuLine::open(options_);
    if (!opened.line) return opened.error;
    line_ = std::move(opened.line);
    empty_at_ = clock_.now();
    slave_.join(bell_, empty_at_);
    return {};
}

void RtuServer::Loop::wait() {
    polled_[0] = {.fd = wakeup_.descriptor(), .events = POLLIN, .revents = 0};
    polled_[1] = {.fd = line_->descriptor(), .events = POLLIN, .revents = 0};
    const base::Instant now = clock_.now();
    const auto left = std::max(slave_.due(now) - now, base::Microseconds(0));
    timespec time{};
    time.tv_nsec = static_cast<long>(std::min(left, base::Microseconds(UnitSet::kTick)).count() * 1'000);
    ::ppoll(polled_.data(), polled_.size(), &time, nullptr);
}

void RtuServer::Loop::run() {
    while (!ends_) {
        wait();
        if ((polled_[0].revents & POLLIN) != 0) wakeup_.drain();
        bell_.arm();
        const base::Instant now = clock_.now();
        line_->look();
        read(now);
        slave_.poll(now);
        send(now);
    }
}

void RtuServer::Loop::read(base::Instant now) {
    std::array<ports::ReceivedByte, 256> bytes{};
    const base::Instant arrived = empty_at_;
    const std::size_t count = line_->read(bytes);
    if (count < bytes.size()) empty_at_ = now;
    slave_.take(std::span(bytes).first(count), arrived, now);
}

/// Characters that came since read(), perhaps while the process stood.
bool RtuServer::Loop::has_more() {
    pollfd line{.fd = line_->descriptor(), .events = POLLIN, .revents = 0};
    return ::poll(&line, 1, 0) == 1 && (line.revents & POLLIN) != 0;
}

void RtuServer::Loop::send(base::Instant now) {
    const auto bytes = slave_.out(now);
    if (!bytes.empty() && !has_more()) slave_.note_sent(line_->write(bytes));
}

RtuServer::RtuServer() = default;

RtuServer::Opened RtuServer::open(const Options& options, const faces::Axes& axes) {
    std::unique_ptr<RtuServer> server(new RtuServer);
    server->loop_ = std::make_unique<Loop>(options, axes);
    if (std::string error = server->loop_->open(); !error.empty()) return {nullptr, error};
    server->thread_ = hal_linux::start_quiet_thread([loop = server->loop_.get()] { loop->run(); });
    return {std::move(server), {}};
}

RtuServer::~RtuServer() {
    if (!thread_.joinable()) return;
    loop_->end();
    thread_.join();
}

}  // namespace nplc::modbus
