#include "host/can_client.h"

#include <poll.h>

#include <cerrno>
#include <ctime>

#include "hal_linux/socket_can.h"
#include "host/clock.h"
#include "host/endpoint.h"

namespace nplc::hal_linux {
namespace {

constexpr base::Microseconds kLongestWrite{1'000'000};
constexpr base::Microseconds kWriteAgain{1'000};

class SocketCanClient final : public host::CanClient {
  public:
    SocketCanClient(std::unique_ptr<SocketCan> can, const std::string& interface)
        : can_(std::move(can)), name_(host::Endpoint::text(host::Endpoint::Kind::can, interface)) {}

    const std::string& name() const override { return name_; }

    bool write(const ports::CanFrame& frame) override {
        const base::Instant end = now() + kLongestWrite;
        while (!can_->write(frame)) {
            if (can_->gone() || now() >= end) return false;
            wait_readable(kWriteAgain);
        }
        return true;
    }

    std::optional<ports::CanFrame> read(base::Microseconds wait) override {
        ports::CanFrame frame;
        if (can_->read(frame)) return frame;
        if (wait.count() > 0) wait_readable(wait);
        if (can_->read(frame)) return frame;
        return std::nullopt;
    }

    ports::CanState state() override { return can_->state(); }
    bool gone() const override { return can_->gone(); }

    base::Instant now() const override { return host::steady_now(); }

  private:
    void wait_readable(base::Microseconds wait) const {
        pollfd ready{.fd = can_->descriptor(), .events = POLLIN, .revents = 0};
        const timespec limit{.tv_sec = static_cast<std::time_t>(wait.count() / 1'000'000),
                             .tv_nsec = static_cast<long>(wait.count() % 1'000'000 * 1000)};
        static_cast<void>(::ppoll(&ready, 1, &limit, nullptr));
    }

    std::unique_ptr<SocketCan> can_;
    std::string name_;
};

}  // namespace
}  // namespace nplc::hal_linux

namespace nplc::host {

CanClient::Opened CanClient::open(const std::string& interface) {
    auto opened = hal_linux::SocketCan::open({.interface = interface});
    if (opened.can == nullptr)
        return {nullptr, Endpoint::text(Endpoint::Kind::can, interface) + ": " + opened.error};
    return {std::make_unique<hal_linux::SocketCanClient>(std::move(opened.can), interface), {}};
}

std::string CanClient::forms() {
    return "can:can0";
}

}  // namespace nplc::host
