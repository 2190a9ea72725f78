#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace nplc::host {

/// The far end of a line, as written in command lines, configurations and messages:
///     /dev/ttyUSB0, COM3   a device, by the system's own name for it
///     pty:PATH             a pseudo-terminal that a program has made a link to
///     unix:PATH            a stream socket in the file system
///     tcp:ADDRESS:PORT     a TCP socket
///     can:INTERFACE        a CAN bus that the system has set up
/// The only parser of these forms. Whether the line exists, and is supported on this system, is checked when
/// it is opened: ByteClient, CanClient, hal_linux::ByteServer.
struct Endpoint {
    enum class Kind : std::uint8_t { device, pty, unix_socket, tcp, can };

    explicit Endpoint(std::string_view text);
    /// "pty:PATH" for Kind::pty and PATH.
    static std::string text(Kind kind, std::string_view place);

    /// It has no baud rate, and its far end is a program that may have other clients.
    bool is_socket() const { return kind == Kind::unix_socket || kind == Kind::tcp; }
    /// A byte stream served by a program.
    bool is_served() const { return kind == Kind::pty || is_socket(); }

    Kind kind = Kind::device;
    std::string place;  ///< the text after "pty:"; for a device the whole text. May be empty
};

}  // namespace nplc::host
