#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hal_linux/byte_server.h"
#include "sim/device_options.h"
#include "sim/text.h"

namespace nplc::sim {

/// A place where an outside client exchanges bytes with a device, or none.
class Endpoint {
  public:
    /// An empty text opens nothing. Answers what went wrong, in one line, or nothing.
    std::string open(const std::string& endpoint);
    std::vector<std::uint8_t> read();
    void write(const std::vector<std::uint8_t>& bytes);
    /// "label: tcp:127.0.0.1:4001" and a line's end; nothing if it is none.
    std::string described(const std::string& label) const;

  private:
    std::unique_ptr<hal_linux::ByteServer> server_;
};

/// Virtual devices with their clients.
class VirtualDevices {
  public:
    virtual ~VirtualDevices() = default;
    /// All that happens until then. Answers what went wrong, in one line, or nothing.
    virtual std::string advance(Time to) = 0;
    /// Where clients find it, a line each.
    virtual std::string endpoints() const = 0;
    /// Standard output belongs to somebody: no status line.
    virtual bool has_console() const { return false; }
    /// One line for a terminal.
    virtual std::string status() const = 0;
    /// The program ends. Answers what went wrong.
    virtual std::string finish() { return {}; }
};

struct ServeOptions {
    std::string program;  ///< its name, before messages
    double speed = 1;     ///< virtual seconds in a real one
    std::function<Time()> wall_clock;
};

/// From its start on SIGINT, SIGTERM and SIGHUP end serve() instead of the program.
void end_on_signals();
/// Prints the endpoints and `ready`, and serves until a signal. The program's exit code: 0, or 2 with one
/// line on standard error.
int serve(VirtualDevices& devices, const ServeOptions& options);
/// "program: message" on standard error; answers 2.
int fail(const std::string& program, const std::string& message);

/// A program of virtual devices behind its command line. `open` makes them of the options; the text it is
/// given says in one line what could not be opened.
template <class Options>
int serve_devices(const std::string& program, const DeviceCommandLine<Options>& command,
                  std::unique_ptr<VirtualDevices> (*open)(const Options&, std::string&),
                  const std::function<Time()>& wall_clock) {
    if (!command.error.empty()) return fail(program, command.error);
    if (!command.options) return 0;
    std::string error;
    const std::unique_ptr<VirtualDevices> devices = open(*command.options, error);
    if (!error.empty()) return fail(program, error);
    return serve(*devices, {program, command.options->speed, wall_clock});
}

}  // namespace nplc::sim
