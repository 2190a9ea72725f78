#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "file_descriptor.h"
#include "ports/can.h"

/// State and control of a CAN interface through the kernel (rtnetlink), besides its frames.
namespace nplc::hal_linux {

struct CanLink {
    int index = 0;
    bool is_can = false;
    ports::CanState state = ports::CanState::down;
    std::optional<std::uint32_t> bitrate{};  ///< 0: not set; empty: a virtual interface has none
};

/// Empty if there is no such interface.
std::optional<CanLink> can_link(const std::string& name);

/// Returns errno; 0: the restart has begun.
int restart_can(int index);

/// Notification of changes of any interface.
class LinkChanges {
  public:
    LinkChanges();
    int descriptor() const { return socket_.get(); }
    /// Takes all pending notifications; false if there were none.
    bool take();

  private:
    FileDescriptor socket_;
};

}  // namespace nplc::hal_linux
