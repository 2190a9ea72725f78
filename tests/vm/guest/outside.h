#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

/// What is around the virtual board, as its tests see it.
namespace nplc::board_tests {

/// The hand on the lines, at the other end of /dev/ttyS0 (board.py's serve_lines).
class Outside {
  public:
    Outside() : port_(::open("/dev/ttyS0", O_RDWR | O_NOCTTY | O_CLOEXEC)) {
        termios mode{};
        ::tcgetattr(port_, &mode);
        ::cfmakeraw(&mode);
        ::tcsetattr(port_, TCSANOW, &mode);
    }
    ~Outside() { ::close(port_); }
    Outside(const Outside&) = delete;
    Outside& operator=(const Outside&) = delete;

    void drive(unsigned line, bool level) {
        EXPECT_EQ(ask("set " + std::to_string(line) + (level ? " 1" : " 0")), "ok");
    }
    bool level(unsigned line) { return ask("get " + std::to_string(line)) == "1"; }

    void unplug(const std::string& adapter) { EXPECT_EQ(ask("unplug " + adapter), "ok"); }
    void plug(const std::string& adapter) { EXPECT_EQ(ask("plug " + adapter), "ok"); }

  private:
    std::string ask(const std::string& question) {
        const std::string line = question + "\n";
        EXPECT_EQ(::write(port_, line.data(), line.size()), std::ssize(line));
        std::string answer;
        for (char c = 0; ::read(port_, &c, 1) == 1 && c != '\n';) answer += c;
        return answer;
    }

    int port_;
};

/// A program of another author: what it prints.
inline std::string output_of(const std::string& command) {
    std::string all;
    FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
    std::array<char, 512> some;
    while (std::fgets(some.data(), some.size(), pipe) != nullptr) all += some.data();
    ::pclose(pipe);
    return all;
}

inline void run(const std::string& command) {
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
}

inline bool readable(int descriptor, int milliseconds = 0) {
    pollfd state{.fd = descriptor, .events = POLLIN, .revents = 0};
    return ::poll(&state, 1, milliseconds) > 0;
}

constexpr int kSoon = 60'000;  ///< ms; ends a test that would wait for ever

/// Another process; its exit status is what `work` answers. Killed with the object.
class Process {
  public:
    explicit Process(const std::function<int()>& work) : id_(::fork()) {
        if (id_ == 0) ::_exit(work());
    }
    ~Process() { kill(); }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    int status() {
        int status = 0;
        ::waitpid(id_, &status, 0);
        id_ = -1;
        return WEXITSTATUS(status);
    }
    void kill() {
        if (id_ < 0) return;
        ::kill(id_, SIGKILL);
        ::waitpid(id_, nullptr, 0);
        id_ = -1;
    }

  private:
    pid_t id_;
};

/// The output of `work` as a user without rights.
inline std::string as_nobody(const std::function<std::string()>& work) {
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe(ends.data()), 0);
    Process process([&] {
        if (::setgid(65534) != 0 || ::setuid(65534) != 0) return 1;
        const std::string said = work();
        return ::write(ends[1], said.data(), said.size()) == std::ssize(said) ? 0 : 1;
    });
    EXPECT_EQ(process.status(), 0);
    ::close(ends[1]);
    std::string said(1024, '\0');
    const ssize_t count = ::read(ends[0], said.data(), said.size());
    ::close(ends[0]);
    said.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return said;
}

}  // namespace nplc::board_tests
