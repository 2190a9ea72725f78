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

/// An endpoint where an outside client exchanges bytes with a device, or none.
class Endpoint {
  public:
    /// An empty text opens nothing. Returns a one-line error, or an empty text.
    std::string open(const std::string& endpoint);
    std::vector<std::uint8_t> read();
    void write(const std::vector<std::uint8_t>& bytes);
    /// "label: tcp:127.0.0.1:4001" and a line end; empty if there is none.
    std::string described(const std::string& label) const;

  private:
    std::unique_ptr<hal_linux::ByteServer> server_;
};

/// Virtual devices with their clients.
class VirtualDevices {
  public:
    virtual ~VirtualDevices() = default;
    /// Simulates up to that time. Returns a one-line error, or an empty text.
    virtual std::string advance(Time to) = 0;
    /// The endpoints for clients, one line each.
    virtual std::string endpoints() const = 0;
    /// Standard output is in use by a client: no status line.
    virtual bool has_console() const { return false; }
    /// One line for a terminal.
    virtual std::string status() const = 0;
    /// Called when the program ends. Returns an error, or an empty text.
    virtual std::string finish() { return {}; }
};

struct ServeOptions {
    std::string program;  ///< its name, as prefix of messages
    double speed = 1;     ///< virtual seconds per real second
    std::function<Time()> wall_clock;
};

/// From now on SIGINT, SIGTERM and SIGHUP end serve() instead of the program.
void end_on_signals();
/// Prints the endpoints and `ready`, and serves until a signal. Returns the exit code: 0, or 2 with one line
/// on standard error.
int serve(VirtualDevices& devices, const ServeOptions& options);
/// Prints "program: message" on standard error; returns 2.
int fail(const std::string& program, const std::string& message);

/// Main function of a program with virtual devices. `open` creates them from the options; its text parameter
/// receives a one-line error.
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
