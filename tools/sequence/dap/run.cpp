#include "dap/run.h"

#include <cstdlib>
#include <memory>
#include <ostream>
#include <thread>

#include "adapter.h"
#include "rpc/message.h"
#include "rpc/queue.h"

namespace nplc::dap {
namespace {

using Mailbox = rpc::Queue<rpc::Incoming>;

/// Timeout for a message while the debuggee runs.
std::optional<std::chrono::milliseconds> patience_of(const Adapter& adapter) {
    constexpr std::chrono::milliseconds kPace{20};  // step of a rehearsal in real time
    constexpr std::chrono::milliseconds kGlance{200};
    if (!adapter.runs()) return adapter.looks_on() ? std::optional(kGlance) : std::nullopt;
    return adapter.realtime() ? kPace : std::chrono::milliseconds{0};
}

}  // namespace

int run_adapter(std::istream& in, std::ostream& out) {
    const auto mailbox = std::make_shared<Mailbox>();
    std::thread([mailbox, &in] {
        for (;;) {
            rpc::Incoming incoming = rpc::read_message(in);
            const bool ends = incoming.kind == rpc::Incoming::Kind::end;
            mailbox->put(std::move(incoming));
            if (ends) return;
        }
    }).detach();
    Adapter adapter([&out](const Json& message) { rpc::write_message(out, message); });
    bool left = false;
    while (!adapter.ended() && !left && out) {
        const auto incoming = mailbox->take(patience_of(adapter));
        if (!incoming && adapter.runs()) {
            adapter.tick();
        } else if (!incoming) {
            adapter.look();
        } else if (incoming->kind == rpc::Incoming::Kind::end) {
            left = true;
        } else if (incoming->kind == rpc::Incoming::Kind::message) {
            adapter.receive(incoming->message);
        }
    }
    if (left && !adapter.ended())
        adapter.receive({{"type", "request"}, {"seq", 0}, {"command", "disconnect"}});
    out.flush();
    std::_Exit(left ? 1 : 0);  // the reader thread may be blocked forever
}

}  // namespace nplc::dap
