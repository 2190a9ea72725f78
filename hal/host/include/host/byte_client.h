#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "base/time.h"

namespace nplc::host {

/// Our end of a line to a device or to another program:
///     /dev/ttyUSB0, or any other path    a serial line: 8 data bits, no parity, 1 stop bit, no handshake
///     COM3                               the same on Windows
///     pty:PATH                           the same, of a program's pseudo-terminal; not on Windows
///     unix:PATH                          a stream socket in the file system; not on Windows
///     tcp:127.0.0.1:PORT                 a TCP socket of this machine, PORT 1..65535
/// A serial line is locked (flock) for other programs as long as this object lives, or in turns with others
/// that do the same, and its mode is put back afterwards.
class ByteClient {
  public:
    /// How a serial line is held; sockets have room for several clients, and Windows holds a line alone.
    enum class Holding : std::uint8_t {
        alone,
        in_turns,  ///< others have it while this one rests
        at_once,   ///< whoever holds it: for what cannot wait. Who holds it by a ByteClient gives way
    };
    struct Opened {
        std::unique_ptr<ByteClient> client;
        std::string error;   ///< what went wrong and what to do, in one line; empty when it was opened
        bool never = false;  ///< no such endpoint can be: it, or the speed, is written wrongly
        bool full = false;   ///< somebody listens there, and has no room at the moment
    };
    /// `baud`: 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200, 230400, 460800 or 921600, on Windows what
    /// the port takes; sockets have none.
    static Opened open(const std::string& endpoint, std::uint32_t baud, Holding holding = Holding::alone);
    /// For the user: what an endpoint may be on this system, "a serial line's path such as ...".
    static std::string forms();

    virtual ~ByteClient() = default;
    ByteClient(const ByteClient&) = delete;
    ByteClient& operator=(const ByteClient&) = delete;

    virtual const std::string& name() const = 0;
    /// Takes all bytes. False if the other end is gone, or takes nothing for a second.
    virtual bool write(std::span<const std::uint8_t> bytes) = 0;
    /// Waits no longer than `wait` for a first byte; how many it put into `out`. Nothing if the other end is
    /// gone.
    virtual std::optional<std::size_t> read(std::span<std::uint8_t> out, base::Microseconds wait) = 0;
    /// Which other program the far end serves, "macreg (process 1234)"; empty where that cannot be told.
    virtual std::string other_client() const { return {}; }
    enum class Rest : std::uint8_t {
        not_shared,   ///< the line has not been left, and no time has passed
        held,         ///< the line is ours again; what came meanwhile was another's
        still_taken,  ///< by another program, which `holder` names; rest again, or do without
    };
    /// Leaves a line that is held in turns to others for so long (5 ms at the least), and waits 100 ms at the
    /// most to have it again. One that is taken at once is not left: from the first call on the others
    /// neither send nor read.
    virtual Rest rest(base::Microseconds /*time*/) { return Rest::not_shared; }
    /// "macreg (process 1234)", of a line that is held by another program.
    virtual std::string holder() const { return {}; }
    /// Monotonic.
    virtual base::Instant now() const = 0;

  protected:
    ByteClient() = default;
};

}  // namespace nplc::host
