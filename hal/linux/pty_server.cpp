#include "pty_server.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <termios.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "file_descriptor.h"
#include "host/endpoint.h"
#include "name_lock.h"
#include "reason.h"

namespace nplc::hal_linux {
namespace {

namespace fs = std::filesystem;

class PtyServer final : public ByteServer {
  public:
    PtyServer(NameLock lock, FileDescriptor master, const std::string& path, std::string terminal)
        : lock_(std::move(lock)),
          master_(std::move(master)),
          path_(path),
          terminal_(std::move(terminal)),
          name_(host::Endpoint::text(host::Endpoint::Kind::pty, path)) {}
    ~PtyServer() override {
        // A link that was replaced by another program is kept.
        std::error_code error;
        if (fs::read_symlink(path_, error) == terminal_) fs::remove(path_, error);
    }

    const std::string& name() const override { return name_; }

    /// A master whose terminal is not open reports a hang-up, after it has been open once.
    bool has_client() override {
        pollfd state{.fd = master_.get(), .events = 0, .revents = 0};
        return poll(&state, 1, 0) == 0 || (state.revents & POLLHUP) == 0;
    }

    std::size_t read(std::span<std::uint8_t> out) override {
        const ssize_t count = ::read(master_.get(), out.data(), out.size());
        return count > 0 ? static_cast<std::size_t>(count) : 0;
    }

    void write(std::span<const std::uint8_t> bytes) override {
        if (!has_client()) return;
        [[maybe_unused]] const ssize_t taken = ::write(master_.get(), bytes.data(), bytes.size());
    }

    int descriptor() const override { return master_.get(); }

  private:
    NameLock lock_;
    FileDescriptor master_;
    fs::path path_;
    std::string terminal_;
    std::string name_;
};

/// Opened and closed once, in raw mode: the client finds it without echo, as a serial line.
bool prepare_terminal(const char* terminal) {
    const FileDescriptor slave(::open(terminal, O_RDWR | O_NOCTTY | O_CLOEXEC));
    termios mode{};
    if (!slave || tcgetattr(slave.get(), &mode) != 0) return false;
    cfmakeraw(&mode);
    cfsetspeed(&mode, B19200);
    return tcsetattr(slave.get(), TCSANOW, &mode) == 0;
}

/// A killed program leaves a link to a pseudo-terminal.
std::string what_else_is_at(const std::string& path) {
    std::error_code error;
    if (!fs::exists(fs::symlink_status(path, error))) return {};
    if (!fs::is_symlink(path, error)) return "there is a file of this name";
    const std::string target = fs::read_symlink(path, error);
    return target.starts_with("/dev/pts/") ? std::string() : "there is a link of this name, to " + target;
}

}  // namespace

ByteServer::Opened open_pty_server(const std::string& path, bool at_once) {
    const std::string name = host::Endpoint::text(host::Endpoint::Kind::pty, path);
    auto [lock, taken] = NameLock::take(name, path, at_once);
    if (!taken.empty()) return {nullptr, taken};
    if (const std::string foreign = what_else_is_at(path); !foreign.empty())
        return {nullptr, name + ": " + foreign + "; name another path, or remove it"};
    FileDescriptor master(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (!master || grantpt(master.get()) != 0 || unlockpt(master.get()) != 0)
        return {nullptr, name + ": no pseudo-terminal to be had: " + reason()};
    char terminal[64] = {};
    if (ptsname_r(master.get(), terminal, sizeof terminal) != 0 || !prepare_terminal(terminal))
        return {nullptr, name + ": the pseudo-terminal cannot be set up: " + reason()};
    std::error_code error;
    fs::remove(path, error);  // left by a killed program
    if (!error) fs::create_symlink(terminal, path, error);
    if (error) return {nullptr, name + ": the link cannot be made: " + error.message()};
    return {std::make_unique<PtyServer>(std::move(lock), std::move(master), path, terminal), {}};
}

}  // namespace nplc::hal_linux
