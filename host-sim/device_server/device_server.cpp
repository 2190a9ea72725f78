#include "sim/device_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <string_view>
#include <thread>

#include "host/printable.h"
#include "host/terminal.h"

namespace nplc::sim {
namespace {

constexpr int kFailed = 2;
/// Half a character at 19200 baud.
constexpr auto kWait = std::chrono::microseconds{250};
constexpr Time kRefresh = std::chrono::milliseconds{200};
/// After a longer halt of the whole machine virtual time does not catch up.
constexpr Time kLongestCatchUp = std::chrono::milliseconds{500};

volatile std::sig_atomic_t g_ended = 0;

void on_signal(int) {
    g_ended = 1;
}

/// Virtual time follows the wall clock, `speed` times as fast.
class Pace {
  public:
    Pace(double speed, Time wall) : speed_(speed), last_(wall) {}
    Time now(Time wall) {
        const Time passed = std::min(wall - last_, kLongestCatchUp);
        last_ = wall;
        virtual_ += std::chrono::duration_cast<Time>(passed * speed_);
        return virtual_;
    }

  private:
    double speed_;
    Time last_;
    Time virtual_{0};
};

class StatusLine {
  public:
    StatusLine(bool wanted, Time wall) : on_(wanted && host::is_terminal(stdout)), next_(wall) {}
    ~StatusLine() {
        if (on_) fmt::print("\r\033[K");
    }
    StatusLine(const StatusLine&) = delete;
    StatusLine& operator=(const StatusLine&) = delete;

    void show(const VirtualDevices& devices, Time wall) {
        if (!on_ || wall < next_) return;
        next_ = wall + kRefresh;
        const std::string text = devices.status();
        fmt::print("\r\033[K{}", std::string_view(text).substr(0, host::terminal_columns() - 1));
        std::fflush(stdout);
    }

  private:
    bool on_;
    Time next_;
};

}  // namespace

std::string Endpoint::open(const std::string& endpoint) {
    if (endpoint.empty()) return {};
    auto opened = hal_linux::ByteServer::open(endpoint);
    server_ = std::move(opened.server);
    return opened.error;
}

std::vector<std::uint8_t> Endpoint::read() {
    if (server_ == nullptr) return {};
    std::array<std::uint8_t, 4096> block{};
    const std::size_t count = server_->read(block);
    return {block.begin(), block.begin() + static_cast<std::ptrdiff_t>(count)};
}

void Endpoint::write(const std::vector<std::uint8_t>& bytes) {
    if (server_ != nullptr && !bytes.empty()) server_->write(bytes);
}

std::string Endpoint::described(const std::string& label) const {
    return server_ == nullptr ? std::string{} : fmt::format("{}: {}\n", label, server_->name());
}

int fail(const std::string& program, const std::string& message) {
    host::complain(program + ": " + message);
    return kFailed;
}

void end_on_signals() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, on_signal);
    std::signal(SIGPIPE, SIG_IGN);
}

int serve(VirtualDevices& devices, const ServeOptions& options) {
    fmt::print("{}ready\n", devices.endpoints());
    if (std::fflush(stdout) != 0) return fail(options.program, "standard output cannot be written");
    std::string error;
    {
        Pace pace(options.speed, options.wall_clock());
        StatusLine status(!devices.has_console(), options.wall_clock());
        while (g_ended == 0 && error.empty()) {
            const Time wall = options.wall_clock();
            error = devices.advance(pace.now(wall));
            status.show(devices, wall);
            std::this_thread::sleep_for(kWait);
        }
    }
    const std::string end = devices.finish();
    if (error.empty()) error = end;
    return error.empty() ? 0 : fail(options.program, error);
}

}  // namespace nplc::sim
