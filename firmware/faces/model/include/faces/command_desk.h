#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "base/ring.h"
#include "faces/command.h"
#include "seat/seat.h"

namespace nplc::faces {

/// Wakes a sleeping thread; rung at most once per arm(). `ring` must neither block nor fail.
class Bell {
  public:
    explicit Bell(std::function<void()> ring) : ring_(std::move(ring)) {}
    Bell(const Bell&) = delete;
    Bell& operator=(const Bell&) = delete;

    /// To be called before the last check for events.
    void arm() { armed_.store(true, std::memory_order_seq_cst); }
    void strike() {
        if (armed_.exchange(false, std::memory_order_seq_cst)) ring_();
    }

  private:
    std::function<void()> ring_;
    std::atomic<bool> armed_{true};
};

/// Where the clients of an axis leave commands for its loop and get the outcomes. Bounded: 64 clients, with 8
/// pending commands each. The loop only tries the lock, and retries later if it is taken.
class CommandDesk {
  public:
    static constexpr std::size_t kMostClients = 64;
    static constexpr std::size_t kMostWaiting = 8;  ///< per client
    static constexpr base::Milliseconds kUnread{750};
    static constexpr base::Milliseconds kUnended{1'100};
    static constexpr base::Milliseconds kHalted{500};  ///< without a take(): the face itself was halted

    /// One client of a face. Its destructor drops unread outcomes and pending commands (except stops) and
    /// frees its seat. Used by one thread.
    class Client {
      public:
        ~Client();
        Client(const Client&) = delete;
        Client& operator=(const Client&) = delete;

        /// The command's id; empty: too many pending commands of this client (busy). A stop is always
        /// accepted; earlier commands of this client that have not begun end as too_late.
        std::optional<std::uint32_t> submit(const Command& command);
        /// The next outcome. For an axis that does not answer a stop gets an outcome after a timeout: kUnread
        /// after the first take() that finds it unread, or kUnended after the axis's loop has read it without
        /// ending it. It is carried out nevertheless, and its real outcome follows. The timeouts start again
        /// after kHalted without a take().
        std::optional<Completion> take(base::Instant now);
        /// The same, without timeouts: only outcomes reported by the loop.
        std::optional<Completion> take();
        std::uint64_t number() const { return number_; }

      private:
        friend class CommandDesk;
        Client(CommandDesk& desk, std::size_t place, std::uint64_t number)
            : desk_(desk), place_(place), number_(number) {}

        CommandDesk& desk_;
        std::size_t place_;
        std::uint64_t number_;
    };

    /// For a face. `loop` wakes the axis's loop, `bell` the face when a command has ended. Null: kMostClients
    /// are registered.
    std::unique_ptr<Client> join(Side side, std::string name, Bell& bell);
    void wake_loop_with(Bell& loop) { loop_ = &loop; }

    // For the axis's loop. Each returns false ("retry") if the lock is taken.

    struct Work {
        std::size_t place = 0;
        Sitter client{};
        Command command{};
        std::uint32_t id = 0;
    };
    /// Stops of all clients first, stop and safe before hold; then other commands in turns. `stops_only`:
    /// while a command is in progress.
    bool take(std::optional<Work>& work, bool stops_only);
    /// Ends a command in progress. False: retry.
    bool end(const Work& work, const Completion& completion);
    /// After a stop: earlier operating commands of other clients end as too_late.
    bool drop_all_that_operates();
    /// Clients that have left since the last call.
    bool take_leavers(base::Ring<std::uint64_t, kMostClients>& leavers);

  private:
    struct Waiting {
        std::uint32_t id = 0;
        Command command{};
    };
    /// A stop that has not been answered.
    struct OpenStop {
        std::uint32_t id = 0;
        bool is_read = false;
        std::optional<base::Instant> seen{};  ///< the first take(), or the first after a halt
        base::Instant looked{};               ///< the last take()
    };
    struct Place {
        std::uint64_t number = 0;  ///< 0: free
        Sitter sitter{};
        Bell* bell = nullptr;
        bool has_left = false;
        std::uint32_t last_id = 0;
        std::size_t open = 0;  ///< submitted without stops, outcome not yet taken
        base::Ring<Waiting, kMostWaiting> waiting{};
        base::Ring<Waiting, 3> stops{};
        base::Ring<OpenStop, kMostWaiting> open_stops{};
        base::Ring<Completion, kMostWaiting + 4> ended{};
    };

    void leave(std::size_t which);
    void drop_waiting(Place& place, bool all);
    static void open_stop(Place& place, std::uint32_t id);
    static void answer_stops(Place& place, base::Instant now);
    static void complete(Place& place, const Completion& completion);
    bool take_stop(std::optional<Work>& work);

    std::mutex mutex_;
    Bell* loop_ = nullptr;
    std::size_t last_ = kMostClients - 1;                        ///< the client of the last turn
    std::array<std::unique_ptr<Place>, kMostClients> places_{};  ///< null: not used yet
};

}  // namespace nplc::faces
