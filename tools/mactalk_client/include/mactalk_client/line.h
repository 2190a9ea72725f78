#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>

#include "base/time.h"
#include "host/byte_client.h"

namespace nplc::mactalk_client {

/// The result of a task, as a program's exit code.
enum Exit : int {
    kOk = 0,
    kRefused = 1,        ///< the other end refused, or two things differ
    kUsageOrFile = 2,    ///< wrong usage, or a file that cannot be read, written or understood
    kNoAnswer = 3,       ///< the port cannot be opened, or there is no answer
    kNotConfirmed = 4,   ///< a stop, safe or hold that was not confirmed
    kInterrupted = 130,  ///< by SIGINT or SIGTERM, before it was done
};

/// A task ended before it was done.
class Ended : public std::runtime_error {
  public:
    Ended(int exit_code, const std::string& what) : std::runtime_error(what), exit_code_(exit_code) {}
    int exit_code() const { return exit_code_; }

  private:
    int exit_code_;
};

template <Exit kExit>
class EndedWith : public Ended {
  public:
    explicit EndedWith(const std::string& what) : Ended(kExit, what) {}
};

class LineError : public EndedWith<kNoAnswer> {
  public:
    enum class Kind : std::uint8_t {
        port_gone,
        port_full,  ///< temporary: may be free a moment later
        no_answer,
        no_message,  ///< not representable in a message: register 0, a wrong length
    };
    LineError(Kind kind, const std::string& what) : EndedWith(what), kind_(kind) {}
    Kind kind() const { return kind_; }

  private:
    Kind kind_;
};

/// The user has cancelled: thrown by long operations, between two requests.
class Interrupted : public EndedWith<kInterrupted> {
    using EndedWith::EndedWith;
};

/// The part common to masters of all protocols on a serial line with one pending request at a time:
/// deadlines, waiting, silence after a request without an answer, and the error text when the far end is
/// gone.
class Line {
  public:
    struct Options {
        std::uint32_t baud;           ///< for transmission times; sockets are assumed to be as slow
        base::Microseconds patience;  ///< in addition to the transmission time of request and answer
        /// The error text for a far end that refuses a second client: what it does, and what the user should
        /// do.
        const char* full;
        const char* perhaps_full;
        /// Called with all bytes received.
        std::function<void(std::span<const std::uint8_t>)> received{};
    };

    Line(host::ByteClient& port, Options options) : port_(port), options_(std::move(options)) {}

    host::ByteClient& port() { return port_; }
    const std::string& name() const { return port_.name(); }
    base::Instant now() const { return port_.now(); }
    /// Bytes have been received since it was opened.
    bool heard_anything() const { return heard_any_; }
    /// The transmission time of so many bytes.
    base::Microseconds time_of(std::size_t bytes) const;

    /// Nothing is waited for after this instant: an answer has not come then.
    void set_deadline(base::Instant deadline) { deadline_ = deadline; }

    /// This and the following functions throw LineError if the far end is gone.
    void send(std::span<const std::uint8_t> bytes);
    /// Passes received bytes to `take`, a piece at a time, until it returns true or the time for a request
    /// and an answer of so many bytes is over; returns whether it returned true.
    template <class Take>
    bool listen(std::size_t bytes, Take take, base::Microseconds more_patience = {}) {
        const base::Instant end =
            std::min(now() + options_.patience + more_patience + time_of(bytes), deadline_);
        std::array<std::uint8_t, 256> piece{};
        for (base::Instant time = now(); time < end; time = now()) {
            if (take(std::span<const std::uint8_t>(piece).first(receive(piece, end - time)))) return true;
        }
        return false;
    }
    /// An answer to the last request may still arrive.
    void expect_late_answer();
    /// Discards what was received before the next request; returns how many bytes. With `in_silence`, for
    /// answers that carry no address, the line must have been silent for as long as a late answer may take; 2
    /// s at the most.
    std::uint64_t settle(bool in_silence);
    /// Waits; returns how many bytes were received meanwhile and discarded.
    std::uint64_t pause(base::Microseconds time);

  private:
    std::size_t receive(std::span<std::uint8_t> out, base::Microseconds wait);
    [[noreturn]] void gone();

    host::ByteClient& port_;
    Options options_;
    std::uint64_t sent_ = 0;  ///< messages
    bool heard_any_ = false;
    bool late_answer_ = false;
    base::Instant deadline_ = base::kNever;
    base::Instant silent_since_{};
};

}  // namespace nplc::mactalk_client
