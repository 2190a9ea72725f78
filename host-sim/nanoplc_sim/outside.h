#pragma once

#include <csignal>
#include <memory>

#include "ports/storage.h"
#include "program.h"
#include "run_command.h"

namespace nplc::sim {

class Session;

/// What a run shares with other programs and people while it lasts: the file of its flash and, with
/// --realtime, keys, the gateway's port and the faces.
class Outside {
  public:
    virtual ~Outside() = default;
    /// Null without --flash.
    virtual ports::Storage* flash() = 0;
    /// Virtual time follows the wall clock until the session has ended or `interrupted` is not 0. The session
    /// must not outlive this.
    virtual void run(Session& session, const volatile std::sig_atomic_t& interrupted) = 0;
};

/// Opens what the options name. `program` must outlive it. Throws InputError.
std::unique_ptr<Outside> open_outside(const RunOptions& options, const Program& program);

}  // namespace nplc::sim
