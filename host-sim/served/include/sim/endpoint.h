#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hal_linux/byte_server.h"

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

}  // namespace nplc::sim
