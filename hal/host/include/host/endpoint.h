#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace nplc::host {

/// The other end of a line as command lines, configurations and messages write it:
///     /dev/ttyUSB0, COM3   a device, by the system's own name for it
///     pty:PATH             a pseudo-terminal that a program has made a link to
///     unix:PATH            a stream socket in the file system
///     tcp:ADDRESS:PORT     a TCP socket
///     can:INTERFACE        a CAN bus that the system has set up
/// The one place that knows these forms. Whether such a line exists, and on this system at all, is found out
/// by who opens it: ByteClient, CanClient, hal_linux::ByteServer.
struct Endpoint {
    enum class Kind : std::uint8_t { device, pty, unix_socket, tcp, can };

    explicit Endpoint(std::string_view text);
    /// "pty:PATH" of Kind::pty and PATH.
    static std::string text(Kind kind, std::string_view place);

    /// It has no speed, and its far end is a program that may have other clients.
    bool is_socket() const { return kind == Kind::unix_socket || kind == Kind::tcp; }
    /// A program serves it, and it carries bytes.
    bool is_served() const { return kind == Kind::pty || is_socket(); }

    Kind kind = Kind::device;
    std::string place;  ///< what stands behind "pty:"; of a device the whole text. May be empty
};

}  // namespace nplc::host
