#include "lsp/run.h"

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <variant>

#include "lsp/server.h"
#include "rpc/message.h"
#include "rpc/queue.h"

namespace nplc::seqc::lsp {
namespace {

/// Delay after the last change.
constexpr std::chrono::milliseconds kQuiet{300};

using Item = std::variant<rpc::Incoming, VerifyOutcome>;

/// Messages from the reader and the verifier to the answering thread.
class Mailbox : public rpc::Queue<Item> {
  public:
    void put(Item item) {
        Queue::put(std::move(item), [this](const Item& coming, const std::deque<Item>& waiting) {
            note_cancellation(coming, waiting);
        });
    }
    /// True once for a request that was already cancelled.
    bool take_cancellation(const Json& id) {
        const std::lock_guard lock(mutex_);
        return cancelled_.erase(id.dump()) > 0;
    }

  private:
    /// Only while its request is still queued.
    void note_cancellation(const Item& coming, const std::deque<Item>& waiting) {
        const auto* incoming = std::get_if<rpc::Incoming>(&coming);
        if (incoming == nullptr || incoming->kind != rpc::Incoming::Kind::message) return;
        if (incoming->message.value("method", Json()) != "$/cancelRequest") return;
        const Json id = incoming->message.value("/params/id"_json_pointer, Json());
        const std::lock_guard lock(mutex_);
        for (const Item& item : waiting) {
            const auto* other = std::get_if<rpc::Incoming>(&item);
            if (other != nullptr && other->message.is_object() && other->message.value("id", Json()) == id)
                cancelled_.insert(id.dump());
        }
    }

    std::mutex mutex_;
    std::set<std::string> cancelled_;
};

/// Verifies one program at a time; of several queued versions only the newest.
class VerifierThread {
  public:
    explicit VerifierThread(std::shared_ptr<Mailbox> mailbox) : state_(std::make_shared<State>()) {
        std::thread([state = state_, mailbox = std::move(mailbox)] { work(*state, *mailbox); }).detach();
    }
    void put(VerifyJob job) {
        const std::lock_guard lock(state_->mutex);
        std::erase_if(state_->jobs, [&](const VerifyJob& other) { return other.uri == job.uri; });
        state_->jobs.push_back(std::move(job));
        state_->changed.notify_all();
    }

  private:
    struct State {
        std::mutex mutex;
        std::condition_variable changed;
        std::deque<VerifyJob> jobs;
    };

    static void work(State& state, Mailbox& mailbox) {
        for (;;) {
            std::unique_lock lock(state.mutex);
            state.changed.wait(lock, [&] { return !state.jobs.empty(); });
            const VerifyJob job = std::move(state.jobs.front());
            state.jobs.pop_front();
            lock.unlock();
            mailbox.put(verify_program(job));
        }
    }

    std::shared_ptr<State> state_;
};

/// False at the end of the input.
bool handle(Server& server, Mailbox& mailbox, const Item& item) {
    if (const auto* outcome = std::get_if<VerifyOutcome>(&item)) {
        server.verified(*outcome);
        return true;
    }
    const auto& incoming = std::get<rpc::Incoming>(item);
    if (incoming.kind == rpc::Incoming::Kind::end) return false;
    if (incoming.kind == rpc::Incoming::Kind::malformed) {
        server.malformed(incoming.problem);
        return true;
    }
    const bool is_request = incoming.message.contains("id") && incoming.message.contains("method");
    if (is_request && mailbox.take_cancellation(incoming.message["id"])) {
        server.cancelled(incoming.message);
    } else {
        server.receive(incoming.message);
    }
    return true;
}

}  // namespace

int run_server(std::istream& in, std::ostream& out) {
    const auto mailbox = std::make_shared<Mailbox>();
    std::thread([mailbox, &in] {
        for (;;) {
            rpc::Incoming incoming = rpc::read_message(in);
            const bool ends = incoming.kind == rpc::Incoming::Kind::end;
            mailbox->put(std::move(incoming));
            if (ends) return;
        }
    }).detach();
    VerifierThread verifier(mailbox);
    Server server([&out](const Json& message) { rpc::write_message(out, message); });
    bool quiet = true;
    while (!server.ended() && out) {
        const auto item = mailbox->take(quiet ? std::nullopt : std::optional(kQuiet));
        if (!item) {
            for (VerifyJob& job : server.take_jobs()) verifier.put(std::move(job));
            quiet = true;
            continue;
        }
        if (!handle(server, *mailbox, *item)) break;
        quiet = std::holds_alternative<VerifyOutcome>(*item) && quiet;
        if (mailbox->empty()) server.catch_up();
    }
    out.flush();
    // The reader and the verifier may be blocked or busy for long: they end with the process.
    std::_Exit(server.exit_code());
}

}  // namespace nplc::seqc::lsp
