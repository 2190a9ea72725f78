#include "sim/served.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <string_view>
#include <thread>

#include "host/terminal.h"

namespace nplc::sim {
namespace {

constexpr int kTrouble = 2;
/// Half a character at 19200 baud.
constexpr auto kWait = std::chrono::microseconds{250};
constexpr Time kRefresh = std::chrono::milliseconds{200};
/// After a longer halt of the whole machine the devices go on from where they were.
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
    explicit StatusLine(Time wall) : next_(wall) {}
    ~StatusLine() {
        if (on_) fmt::print("\r\033[K");
    }
    StatusLine(const StatusLine&) = delete;
    StatusLine& operator=(const StatusLine&) = delete;

    void show(const Served& served, Time wall) {
        if (!on_ || wall < next_) return;
        next_ = wall + kRefresh;
        const std::string text = served.status();
        fmt::print("\r\033[K{}", std::string_view(text).substr(0, host::terminal_columns() - 1));
        std::fflush(stdout);
    }

  private:
    bool on_ = host::is_terminal(stdout);
    Time next_;
};

}  // namespace

int trouble(const std::string& program, const std::string& message) {
    fmt::print(stderr, "{}: {}\n", program, message);
    return kTrouble;
}

void end_on_signals() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, on_signal);
    std::signal(SIGPIPE, SIG_IGN);
}

int serve(Served& served, const ServeOptions& options) {
    fmt::print("{}ready\n", served.endpoints());
    if (std::fflush(stdout) != 0) return trouble(options.program, "standard output cannot be written");
    std::string error;
    {
        Pace pace(options.speed, options.wall_clock());
        StatusLine status(options.wall_clock());
        while (g_ended == 0 && error.empty()) {
            const Time wall = options.wall_clock();
            error = served.advance(pace.now(wall));
            status.show(served, wall);
            std::this_thread::sleep_for(kWait);
        }
    }
    const std::string end = served.finish();
    if (error.empty()) error = end;
    return error.empty() ? 0 : trouble(options.program, error);
}

}  // namespace nplc::sim
