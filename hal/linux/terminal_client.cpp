#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <termios.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "descriptor_client.h"
#include "terminal_port.h"

namespace nplc::hal_linux {
namespace {

struct Speed {
    std::uint32_t baud;
    speed_t code;
};
constexpr std::array<Speed, 11> kSpeeds{{{1200, B1200},
                                         {2400, B2400},
                                         {4800, B4800},
                                         {9600, B9600},
                                         {19'200, B19200},
                                         {38'400, B38400},
                                         {57'600, B57600},
                                         {115'200, B115200},
                                         {230'400, B230400},
                                         {460'800, B460800},
                                         {921'600, B921600}}};

using Holding = host::ByteClient::Holding;

constexpr base::Microseconds kLook{1'000};
constexpr base::Microseconds kSlice{20'000};  ///< interval of the check for a program with priority
constexpr base::Microseconds kLeastRest{5'000};
constexpr base::Microseconds kShortWait{100'000};
/// A program that shares the line in turns releases it sooner.
constexpr base::Microseconds kLongWait{3'000'000};
/// A stop ends sooner than this.
constexpr base::Microseconds kLongestStop{12'000'000};

void sleep_for(base::Microseconds time) {
    std::this_thread::sleep_for(std::chrono::microseconds(time.count()));
}

/// Lock on the whole line, for Holding::at_once. Meanwhile other programs neither send nor read.
struct flock at_once_lock() {
    struct flock lock {};
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    return lock;
}

class TerminalClient final : public DescriptorClient {
  public:
    TerminalClient(FileDescriptor descriptor, const std::string& name, std::string path, speed_t speed,
                   Holding holding)
        : DescriptorClient(std::move(descriptor), name),
          path_(std::move(path)),
          speed_(speed),
          holding_(holding) {
        ::tcgetattr(this->descriptor(), &before_);
    }
    ~TerminalClient() override {
        if (has_set_up_ && (held_ || try_lock())) ::tcsetattr(descriptor(), TCSANOW, &before_);
    }

    bool write(std::span<const std::uint8_t> bytes) override {
        const base::Instant end = now() + kLongestStop;
        while (gives_way() && now() < end) sleep_for(kLook);
        return DescriptorClient::write(bytes);
    }

    std::optional<std::size_t> read(std::span<std::uint8_t> out, base::Microseconds wait) override {
        const base::Instant end = now() + wait;
        for (;;) {
            const base::Microseconds slice = std::clamp(end - now(), base::Microseconds(0), kSlice);
            if (!gives_way()) {
                const auto count = read_once(out, slice);
                if (!count || *count > 0) return count;
            } else {
                sleep_for(slice);
            }
            if (now() >= end) return 0;
        }
    }

    Rest rest(base::Microseconds time) override {
        if (holding_ == Holding::alone) return Rest::not_shared;
        if (holding_ == Holding::at_once) return take_at_once();
        ::flock(descriptor(), LOCK_UN);
        held_ = false;
        sleep_for(std::max(time, kLeastRest));
        return hold_within(kShortWait) ? Rest::held : Rest::still_taken;
    }
    std::string holder() const override { return held_ ? std::string() : holder_of(path_); }

    /// Sets the line's mode before sending: another program may have left another speed.
    bool hold_within(base::Microseconds wait) {
        const base::Instant end = now() + wait;
        while (!try_lock()) {
            if (now() >= end) return false;
            sleep_for(kLook);
        }
        held_ = true;
        const termios mode = raw_mode(before_, speed_);
        has_set_up_ = ::tcsetattr(descriptor(), TCSANOW, &mode) == 0;
        ::tcflush(descriptor(), TCIFLUSH);
        return true;
    }
    bool has_set_up() const { return has_set_up_; }

  private:
    bool try_lock() const { return ::flock(descriptor(), LOCK_EX | LOCK_NB) == 0; }

    bool gives_way() const {
        if (holding_ == Holding::at_once) return false;
        struct flock lock = at_once_lock();
        return ::fcntl(descriptor(), F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
    }

    /// After one slice no other program reads.
    Rest take_at_once() {
        if (is_alone_) return Rest::held;
        struct flock lock = at_once_lock();
        is_alone_ = ::fcntl(descriptor(), F_OFD_SETLK, &lock) == 0;
        sleep_for(kSlice + kLook);
        return is_alone_ ? Rest::held : Rest::still_taken;
    }

    /// Another program may have read the bytes; the line is lost only on a hang-up.
    std::optional<std::size_t> read_once(std::span<std::uint8_t> out, base::Microseconds wait) {
        const auto count = DescriptorClient::read(out, wait);
        if (count) return count;
        pollfd state{.fd = descriptor(), .events = 0, .revents = 0};
        const bool is_gone = ::poll(&state, 1, 0) != 0;
        return is_gone ? std::nullopt : std::optional<std::size_t>(0);
    }

    std::string path_;
    speed_t speed_;
    Holding holding_;
    termios before_{};
    bool held_ = false;
    bool is_alone_ = false;  ///< held with Holding::at_once
    bool has_set_up_ = false;
};

}  // namespace

host::ByteClient::Opened open_terminal_client(const std::string& path, const std::string& name,
                                              std::uint32_t baud, Holding holding) {
    const Speed* speed = nullptr;
    for (const Speed& known : kSpeeds) {
        if (known.baud == baud) speed = &known;
    }
    if (speed == nullptr)
        return {nullptr,
                name + ": no serial line has " + std::to_string(baud) +
                    " baud; take 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200, 230400, "
                    "460800 or 921600",
                true};
    OpenedPort port = open_unheld(path, name);
    if (!port.error.empty()) return {nullptr, port.error};
    auto client =
        std::make_unique<TerminalClient>(std::move(port.descriptor), name, path, speed->code, holding);
    const base::Microseconds wait = holding == Holding::in_turns ? kLongWait : base::Microseconds{0};
    const bool is_held = client->hold_within(wait);
    if (!is_held && holding != Holding::at_once) return {nullptr, held_by_another(name, path)};
    if (is_held && !client->has_set_up())
        return {nullptr, name + ": cannot be set up: " + std::strerror(errno)};
    return {std::move(client), {}};
}

}  // namespace nplc::hal_linux
