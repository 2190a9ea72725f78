#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "base/time.h"

namespace nplc::host {

/// The client end of a line to a device or to another program:
///     /dev/ttyUSB0, or any other path    a serial line: 8 data bits, no parity, 1 stop bit, no handshake
///     COM3                               the same on Windows
///     pty:PATH                           the same, of a program's pseudo-terminal; not on Windows
///     unix:PATH                          a stream socket in the file system; not on Windows
///     tcp:127.0.0.1:PORT                 a TCP socket of this machine, PORT 1..65535
/// A serial line is locked (flock) against other programs while this object lives, or shared in turns with
/// programs that do the same; its mode is restored afterwards.
class ByteClient {
  public:
    /// How a serial line is locked; sockets serve several clients, and Windows always locks a line
    /// exclusively.
    enum class Holding : std::uint8_t {
        alone,
        in_turns,  ///< other programs use it during rest()
        at_once,   ///< with priority over the present holder, for urgent messages; a holder that is a
                   ///< ByteClient yields
    };
    struct Opened {
        std::unique_ptr<ByteClient> client;
        std::string error;    ///< the error and its remedy, one line; empty when it was opened
        bool never = false;   ///< the endpoint or the speed is invalid
        bool full = false;    ///< the server has no room for another client at the moment
        bool absent = false;  ///< no program serves it at the moment; one that is being started will
    };
    /// `baud`: 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200, 230400, 460800 or 921600, on Windows any
    /// speed of the port; not used for sockets.
    static Opened open(const std::string& endpoint, std::uint32_t baud, Holding holding = Holding::alone);
    /// For help texts: the forms of an endpoint on this system, "a serial line's path such as ...".
    static std::string forms();

    virtual ~ByteClient() = default;
    ByteClient(const ByteClient&) = delete;
    ByteClient& operator=(const ByteClient&) = delete;

    virtual const std::string& name() const = 0;
    /// Writes all bytes. False if the other end is gone, or accepts nothing for a second.
    virtual bool write(std::span<const std::uint8_t> bytes) = 0;
    /// Waits up to `wait` for a first byte; returns the number of bytes in `out`. Empty if the other end is
    /// gone.
    virtual std::optional<std::size_t> read(std::span<std::uint8_t> out, base::Microseconds wait) = 0;
    /// The other program that the far end serves, "macreg (process 1234)"; empty if unknown.
    virtual std::string other_client() const { return {}; }
    enum class Rest : std::uint8_t {
        not_shared,   ///< the line was not released, and no time has passed
        held,         ///< the line is locked again; bytes received meanwhile belonged to other programs
        still_taken,  ///< locked by another program, see `holder`; call rest() again, or give up
    };
    /// Releases a line that is shared in turns for this time (at least 5 ms), and waits up to 100 ms to lock
    /// it again. A line held with Holding::at_once is not released: from its first call on the other programs
    /// neither send nor read.
    virtual Rest rest(base::Microseconds /*time*/) { return Rest::not_shared; }
    /// "macreg (process 1234)": the other program that holds the line.
    virtual std::string holder() const { return {}; }
    /// Monotonic.
    virtual base::Instant now() const = 0;

  protected:
    ByteClient() = default;
};

}  // namespace nplc::host
