#pragma once

#include <string>
#include <vector>

#include "command_line.h"
#include "rack.h"
#include "sim/endpoint.h"
#include "sim/served.h"

namespace nplc::sim {

/// The rack with its clients and its flash files. Time is given: `advance` does all that happens until then.
class Service final : public Served {
  public:
    /// Opens everything; `error` says in one line what could not be.
    Service(const MacsimOptions& options, std::string& error);

    /// Bytes in, time on, bytes out, flash to its file. Answers what went wrong, or nothing.
    std::string advance(Time to) override;

    /// "fastmac: tcp:127.0.0.1:4001", a line each.
    std::string endpoints() const override;
    /// One line about the motors, for a terminal.
    std::string status() const override;

  private:
    struct Flash {
        std::string path;
        std::uint32_t written = 0;
    };
    std::string open_flash(const MacsimOptions& options);
    std::string keep_flash();

    Rack rack_;
    Endpoint fastmac_;
    Endpoint mactalk_;
    std::vector<Flash> flash_;
};

}  // namespace nplc::sim
