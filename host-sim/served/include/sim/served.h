#pragma once

#include <functional>
#include <string>

#include "sim/text.h"

namespace nplc::sim {

/// Virtual devices with their clients.
class Served {
  public:
    virtual ~Served() = default;
    /// All that happens until then. Answers what went wrong, in one line, or nothing.
    virtual std::string advance(Time to) = 0;
    /// Where clients find it, a line each.
    virtual std::string endpoints() const = 0;
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
int serve(Served& served, const ServeOptions& options);
/// "program: message" on standard error; answers 2.
int trouble(const std::string& program, const std::string& message);

}  // namespace nplc::sim
