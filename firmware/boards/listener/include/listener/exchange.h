#pragma once

#include <optional>

#include "base/time.h"
#include "gateway/controller.h"
#include "hal_linux/connections.h"
#include "listener/listener.h"
#include "protocol/mactalk.h"

namespace nplc::boards {

/// Carries between the sockets of a user's port, its listener and a controller without a line of its own.
class Exchange {
  public:
    Exchange(hal_linux::Connections& connections, Listener& listener)
        : connections_(connections), listener_(listener) {}

    /// Before the controller's poll: what has come, and the next message. `now`: of the clients and of the
    /// controller; a simulated one lives in another time.
    void bring(gateway::Controller& controller, base::Instant now, base::Instant controllers_now);
    /// After it: answers.
    void take_back(gateway::Controller& controller, base::Instant now, base::Instant controllers_now);
    /// When bring() is wanted at the latest.
    base::Instant next(base::Instant now) const;

  private:
    void hear(hal_linux::Connections::Id client, base::Instant now);
    void look(base::Instant now);
    void expect(const protocol::mactalk::Request& message);
    void collect(gateway::Controller& controller, base::Instant now, base::Instant controllers_now);
    bool has_ended(const gateway::UserPort& port, base::Instant now);
    void send_unsent(base::Instant now);
    void close_dropped();

    hal_linux::Connections& connections_;
    Listener& listener_;
    protocol::mactalk::Answer expected_{};
    protocol::mactalk::ReplyDecoder reply_;  ///< of what the motor itself answers
    bool is_whole_ = false;
    std::optional<base::Instant> last_sample_;
};

}  // namespace nplc::boards
