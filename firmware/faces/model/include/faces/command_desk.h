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

/// Wakes a thread that sleeps; rung at most once for every arm(). `ring` must neither wait nor fail.
class Bell {
  public:
    explicit Bell(std::function<void()> ring) : ring_(std::move(ring)) {}
    Bell(const Bell&) = delete;
    Bell& operator=(const Bell&) = delete;

    /// Before the last look at what may have come.
    void arm() { armed_.store(true, std::memory_order_seq_cst); }
    void strike() {
        if (armed_.exchange(false, std::memory_order_seq_cst)) ring_();
    }

  private:
    std::function<void()> ring_;
    std::atomic<bool> armed_{true};
};

/// Where the clients of an axis leave commands for its loop, and hear how they ended. Bounded: 64 clients,
/// 8 commands of each that wait. The loop only ever tries the lock, and comes back if it has not got it.
class CommandDesk {
  public:
    static constexpr std::size_t kMostClients = 64;
    static constexpr std::size_t kMostWaiting = 8;  ///< of one client

    /// One client of a face. When it is destroyed what it has not yet been told is forgotten, its commands
    /// that still wait are not carried out (stops are), and its seat is free. Used by one thread.
    class Client {
      public:
        ~Client();
        Client(const Client&) = delete;
        Client& operator=(const Client&) = delete;

        /// The command's id; nothing: too many of this client wait already (busy). A stop is always taken;
        /// what this client gave before it and was not begun ends with too_late.
        std::optional<std::uint32_t> submit(const Command& command);
        /// The next command that has ended.
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

    /// Of a face. `loop` wakes the axis's loop, `bell` the face when a command has ended. Null: there are
    /// kMostClients already.
    std::unique_ptr<Client> join(Side side, std::string name, Bell& bell);
    void wake_loop_with(Bell& loop) { loop_ = &loop; }

    // For the axis's loop. Each says "come back" (false) if the lock is not to be had at once.

    struct Work {
        std::size_t place = 0;
        Sitter client{};
        Command command{};
        std::uint32_t id = 0;
    };
    /// Stops of all clients first, stop and safe before hold; then others by turns. `stops_only`: while
    /// something is under way.
    bool take(std::optional<Work>& work, bool stops_only);
    /// Ends a command taken. False: come back.
    bool end(const Work& work, const Completion& completion);
    /// A stop was taken: what others gave before it and that operates ends with too_late.
    bool drop_all_that_operates();
    /// Clients that have left since the last time.
    bool take_leavers(base::Ring<std::uint64_t, kMostClients>& leavers);

  private:
    struct Waiting {
        std::uint32_t id = 0;
        Command command{};
    };
    struct Place {
        std::uint64_t number = 0;  ///< 0: free
        Sitter sitter{};
        Bell* bell = nullptr;
        bool has_left = false;
        std::uint32_t last_id = 0;
        std::size_t open = 0;  ///< submitted, no stops, and not yet taken back
        base::Ring<Waiting, kMostWaiting> waiting{};
        base::Ring<Waiting, 3> stops{};
        base::Ring<Completion, kMostWaiting + 4> ended{};
    };

    void leave(std::size_t which);
    void drop_waiting(Place& place, bool all);
    static void complete(Place& place, const Completion& completion);
    bool take_stop(std::optional<Work>& work);

    std::mutex mutex_;
    Bell* loop_ = nullptr;
    std::size_t last_ = kMostClients - 1;                        ///< whose turn it was
    std::array<std::unique_ptr<Place>, kMostClients> places_{};  ///< null: nobody was there yet
};

}  // namespace nplc::faces
