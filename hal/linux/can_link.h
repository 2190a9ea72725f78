#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "file_descriptor.h"
#include "ports/can.h"

/// What the kernel tells of a CAN interface, and takes for one, beside its frames (rtnetlink).
namespace nplc::hal_linux {

struct CanLink {
    int index = 0;
    bool is_can = false;
    ports::CanState state = ports::CanState::down;
    std::optional<std::uint32_t> bitrate{};  ///< 0: none is set; nothing: a virtual one has none
};

/// Nothing: there is no such interface.
std::optional<CanLink> can_link(const std::string& name);

/// errno; 0: the restart is under way.
int restart_can(int index);

/// Hears that an interface changed, whichever.
class LinkChanges {
  public:
    LinkChanges();
    int descriptor() const { return socket_.get(); }
    /// Takes all that wait; false if there were none.
    bool take();

  private:
    FileDescriptor socket_;
};

}  // namespace nplc::hal_linux
