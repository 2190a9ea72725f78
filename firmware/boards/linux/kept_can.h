#pragma once

#include <memory>
#include <string>

#include "base/time.h"
#include "hal_linux/socket_can.h"
#include "journal.h"

namespace nplc::boards {

/// A CAN interface that is looked for again when its adapter was pulled out. Says what happens to it; who
/// uses it restarts it when it is off the bus.
class KeptCan {
  public:
    /// Empty, or one line. An interface that is down may be opened.
    std::string open(const std::string& who, const hal_linux::CanSettings& settings);
    hal_linux::SocketCan& can() { return *can_; }
    void look(Journal& journal, base::Instant now);
    /// When look() is wanted at the latest.
    base::Instant next_look() const { return retry_at_; }

  private:
    void tell_state(Journal& journal);
    void tell_problem(Journal& journal);

    std::string who_;
    std::string interface_;
    std::unique_ptr<hal_linux::SocketCan> can_;
    bool told_gone_ = false;
    std::string told_problem_;
    ports::CanState told_ = ports::CanState::active;
    base::Instant retry_at_ = base::kNever;
};

}  // namespace nplc::boards
