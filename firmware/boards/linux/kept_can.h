#pragma once

#include <memory>
#include <string>

#include "base/time.h"
#include "hal_linux/socket_can.h"
#include "journal.h"

namespace nplc::boards {

/// A CAN interface that is looked for again when its adapter was pulled out, or was not there at the start.
/// Says what happens to it; who uses it restarts it when it is off the bus.
class KeptCan {
  public:
    /// An interface that is down may be opened; one that cannot be is gone until look() finds it.
    void open(const std::string& who, const hal_linux::CanSettings& settings);
    hal_linux::SocketCan& can() { return *can_; }
    void look(Journal& journal, base::Instant now);
    /// When look() is wanted at the latest.
    base::Instant next_look() const { return retry_at_; }

  private:
    void tell_state(Journal& journal);
    void tell_problem(Journal& journal);

    std::string who_;
    std::string interface_;
    std::string problem_;  ///< why it could not be opened the last time; empty: it was
    std::unique_ptr<hal_linux::SocketCan> can_;
    bool told_gone_ = false;
    std::string told_problem_;
    ports::CanState told_ = ports::CanState::active;
    base::Instant retry_at_ = base::kNever;
};

}  // namespace nplc::boards
