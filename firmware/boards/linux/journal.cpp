#include "journal.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace nplc::boards {
namespace {

/// JOURNAL_STREAM is DEVICE:INODE of the service's original standard error.
bool stderr_is_journal() {
    const char* stream = std::getenv("JOURNAL_STREAM");
    struct stat status {};
    if (stream == nullptr || ::fstat(STDERR_FILENO, &status) != 0) return false;
    return fmt::format("{}:{}", status.st_dev, status.st_ino) == stream;
}

int open_socket(std::string_view path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.size() >= sizeof address.sun_path) return -1;
    path.copy(address.sun_path, path.size());
    const int socket = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (socket < 0) return -1;
    if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return socket;
    ::close(socket);
    return -1;
}

/// A value with a line feed is preceded by its length, 8 bytes, little-endian.
void put_field(std::string& message, std::string_view name, const std::string& value) {
    message += name;
    if (value.find('\n') == std::string::npos) {
        message += '=';
    } else {
        message += '\n';
        for (unsigned byte = 0; byte < 8; ++byte)
            message += static_cast<char>(value.size() >> 8 * byte & 0xFF);
    }
    message += value;
    message += '\n';
}

/// In the journal's native protocol.
std::string journal_message(LogLevel level, const EventKey& event, const std::string& text,
                            const JournalFields& fields) {
    std::string message;
    put_field(message, "MESSAGE", text);
    put_field(message, "PRIORITY", std::to_string(static_cast<int>(level)));
    put_field(message, "SYSLOG_IDENTIFIER", "nanoplc");
    put_field(message, "NANOPLC_EVENT", event.text);
    for (const JournalField& field : fields) put_field(message, "NANOPLC_" + field.name, field.value);
    return message;
}

}  // namespace

JournalFields cause_field(gateway::SafeReason reason) {
    return {{"CAUSE", std::string(registers::gateway::key_of_log_code(static_cast<std::uint8_t>(reason)))}};
}

Journal::Journal(LogLevel most) : most_(most), is_journal_(stderr_is_journal()) {
    const char* other = std::getenv("NANOPLC_JOURNAL_SOCKET");
    if (is_journal_) socket_ = open_socket(other != nullptr ? other : "/run/systemd/journal/socket");
}

Journal::~Journal() {
    if (socket_ >= 0) ::close(socket_);
}

void Journal::write(LogLevel level, const EventKey& event, const std::string& text,
                    const JournalFields& fields) {
    if (!writes(level)) return;
    if (socket_ >= 0) {
        const std::string message = journal_message(level, event, text, fields);
        const ssize_t sent = ::send(socket_, message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent == static_cast<ssize_t>(message.size())) return;
    }
    const std::string prefix = is_journal_ ? fmt::format("<{}>", static_cast<int>(level)) : "";
    const std::string line = prefix + text + "\n";
    // One write per line: nothing is buffered, and lines of other programs do not mix in.
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
}

}  // namespace nplc::boards
