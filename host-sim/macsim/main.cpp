#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <string_view>
#include <thread>

#include "command_line.h"
#include "host/terminal.h"
#include "service.h"

namespace {

using namespace nplc;
using Clock = std::chrono::steady_clock;

constexpr int kTrouble = 2;
/// Half a character at 19200 baud.
constexpr auto kWait = std::chrono::microseconds{250};
constexpr auto kRefresh = std::chrono::milliseconds{200};
/// After a longer halt of the whole machine the motors go on from where they were.
constexpr auto kLongestCatchUp = std::chrono::milliseconds{500};

volatile std::sig_atomic_t g_ended = 0;

void on_signal(int) {
    g_ended = 1;
}

int trouble(const std::string& message) {
    fmt::print(stderr, "macsim: {}\n", message);
    return kTrouble;
}

/// Virtual time follows the wall clock, `speed` times as fast.
class Pace {
  public:
    explicit Pace(double speed) : speed_(speed) {}
    sim::Time now() {
        const auto wall = Clock::now();
        const auto passed = std::min<Clock::duration>(wall - last_, kLongestCatchUp);
        last_ = wall;
        virtual_ += std::chrono::duration_cast<sim::Time>(passed * speed_);
        return virtual_;
    }

  private:
    double speed_;
    Clock::time_point last_ = Clock::now();
    sim::Time virtual_{0};
};

class StatusLine {
  public:
    ~StatusLine() {
        if (on_) fmt::print("\r\033[K");
    }
    void show(const sim::Service& service) {
        if (!on_ || Clock::now() < next_) return;
        next_ = Clock::now() + kRefresh;
        const std::string text = service.status();
        fmt::print("\r\033[K{}", std::string_view(text).substr(0, host::terminal_columns() - 1));
        std::fflush(stdout);
    }

  private:
    bool on_ = host::is_terminal(stdout);
    Clock::time_point next_ = Clock::now();
};

int serve(const sim::MacsimOptions& options) {
    std::string error;
    sim::Service service(options, error);
    if (!error.empty()) return trouble(error);
    fmt::print("{}ready\n", service.endpoints());
    if (std::fflush(stdout) != 0) return trouble("standard output cannot be written");
    Pace pace(options.speed);
    StatusLine status;
    while (g_ended == 0) {
        error = service.advance(pace.now());
        if (!error.empty()) return trouble(error);
        status.show(service);
        std::this_thread::sleep_for(kWait);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, on_signal);
    std::signal(SIGPIPE, SIG_IGN);
    const sim::MacsimCommandLine command = sim::parse_macsim(argc, argv);
    if (!command.error.empty()) return trouble(command.error);
    return command.options ? serve(*command.options) : 0;
}
