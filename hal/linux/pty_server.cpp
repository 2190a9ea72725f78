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

namespace nplc::hal_linux {
namespace {

namespace fs = std::filesystem;

class PtyServer final : public ByteServer {
  public:
    PtyServer(FileDescriptor master, const std::string& path, std::string terminal)
        : master_(std::move(master)), path_(path), terminal_(std::move(terminal)), name_("pty:" + path) {}
    ~PtyServer() override {
        // Whoever made another link of it since keeps that one.
        std::error_code error;
        if (fs::read_symlink(path_, error) == terminal_) fs::remove(path_, error);
    }

    const std::string& name() const override { return name_; }

    /// A master without an open terminal behind it reports a hang-up, once that was open for the first time.
    bool has_client() override {
        pollfd state{.fd = master_.get(), .events = 0, .revents = 0};
        return poll(&state, 1, 0) == 0 || (state.revents & POLLHUP) == 0;
    }

    std::size_t read_seat(std::size_t /*seat*/, std::span<std::uint8_t> out) override {
        const ssize_t count = ::read(master_.get(), out.data(), out.size());
        return count > 0 ? static_cast<std::size_t>(count) : 0;
    }

    void write_seat(std::size_t /*seat*/, std::span<const std::uint8_t> bytes) override {
        if (!has_client()) return;
        [[maybe_unused]] const ssize_t taken = ::write(master_.get(), bytes.data(), bytes.size());
    }

    int descriptor() const override { return master_.get(); }

  private:
    FileDescriptor master_;
    fs::path path_;
    std::string terminal_;
    std::string name_;
};

/// Opened and closed once, raw: without echo a client finds it as a serial line would be.
bool prepare_terminal(const char* terminal) {
    const FileDescriptor slave(::open(terminal, O_RDWR | O_NOCTTY | O_CLOEXEC));
    termios mode{};
    if (!slave || tcgetattr(slave.get(), &mode) != 0) return false;
    cfmakeraw(&mode);
    cfsetspeed(&mode, B19200);
    return tcsetattr(slave.get(), TCSANOW, &mode) == 0;
}

std::string reason() {
    return std::strerror(errno);
}

}  // namespace

ByteServer::Opened open_pty_server(const std::string& path) {
    std::error_code error;
    const bool is_link = fs::is_symlink(path, error);
    if (!is_link && fs::exists(fs::symlink_status(path, error)))
        return {nullptr, "pty:" + path + ": there is a file of this name; name another, or remove it"};
    FileDescriptor master(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (!master || grantpt(master.get()) != 0 || unlockpt(master.get()) != 0)
        return {nullptr, "pty:" + path + ": no pseudo-terminal to be had: " + reason()};
    char terminal[64] = {};
    if (ptsname_r(master.get(), terminal, sizeof terminal) != 0 || !prepare_terminal(terminal))
        return {nullptr, "pty:" + path + ": the pseudo-terminal cannot be set up: " + reason()};
    // The new link takes the old one's place in one step.
    const std::string temporary = path + "." + std::to_string(::getpid());
    fs::create_symlink(terminal, temporary, error);
    if (!error) fs::rename(temporary, path, error);
    if (error) return {nullptr, "pty:" + path + ": the link cannot be made: " + error.message()};
    return {std::make_unique<PtyServer>(std::move(master), path, terminal), {}};
}

}  // namespace nplc::hal_linux
