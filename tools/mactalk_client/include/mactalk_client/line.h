#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>

#include "base/time.h"
#include "host/byte_client.h"

namespace nplc::mactalk_client {

/// What a task may end with, as a program's exit code.
enum Exit : int {
    kOk = 0,
    kRefused = 1,        ///< the other end said no, or two things differ
    kUsageOrFile = 2,    ///< wrong usage, or a file that cannot be read, written or understood
    kNoAnswer = 3,       ///< the port cannot be opened, or nobody answers
    kNotConfirmed = 4,   ///< a stop, safe or hold that was not seen to be done
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
        port_full,  ///< it may be had a moment later
        no_answer,
        no_message,  ///< what no message can say: register 0, a wrong length
    };
    LineError(Kind kind, const std::string& what) : EndedWith(what), kind_(kind) {}
    Kind kind() const { return kind_; }

  private:
    Kind kind_;
};

/// The user has had enough: thrown by what takes long, between two questions.
class Interrupted : public EndedWith<kInterrupted> {
    using EndedWith::EndedWith;
};

/// What a master of any protocol does on a serial line on which one question is under way at a time:
/// deadlines, time that passes, silence after a question without an answer, and what is said when the far end
/// is gone.
class Line {
  public:
    struct Options {
        std::uint32_t baud;           ///< what messages take on the line; sockets are taken to be as slow
        base::Microseconds patience;  ///< beyond the time that question and answer take on the line
        /// Of a far end that takes no other client: what it does, and what the user is to do.
        const char* full;
        const char* perhaps_full;
        /// Sees all that comes, whatever it is part of.
        std::function<void(std::span<const std::uint8_t>)> received{};
    };

    Line(host::ByteClient& port, Options options) : port_(port), options_(std::move(options)) {}

    host::ByteClient& port() { return port_; }
    const std::string& name() const { return port_.name(); }
    base::Instant now() const { return port_.now(); }
    /// Something came since it was opened.
    bool heard_anything() const { return heard_any_; }
    /// What so many bytes take on the line.
    base::Microseconds time_of(std::size_t bytes) const;

    /// This and what follows throws LineError if the far end is gone.
    void send(std::span<const std::uint8_t> bytes);
    /// Gives what comes to `take`, a piece at a time, until it is content or the time for a question and its
    /// answer of so many bytes is over, and says whether it was content.
    template <class Take>
    bool listen(std::size_t bytes, Take take, base::Microseconds more_patience = {}) {
        const base::Instant end = now() + options_.patience + more_patience + time_of(bytes);
        std::array<std::uint8_t, 256> piece{};
        for (base::Instant time = now(); time < end; time = now()) {
            if (take(std::span<const std::uint8_t>(piece).first(receive(piece, end - time)))) return true;
        }
        return false;
    }
    /// An answer to the last question may still be on its way.
    void expect_late_answer();
    /// Reads over what came before the next question; how many bytes. With `in_silence`, where an answer does
    /// not say whose it is, the line must have been silent for as long as a late one may take.
    std::uint64_t settle(bool in_silence);
    /// Lets time pass; how many bytes came meanwhile and were read over.
    std::uint64_t pause(base::Microseconds time);

  private:
    std::size_t receive(std::span<std::uint8_t> out, base::Microseconds wait);
    [[noreturn]] void gone();

    host::ByteClient& port_;
    Options options_;
    std::uint64_t sent_ = 0;  ///< messages
    bool heard_any_ = false;
    bool late_answer_ = false;
    base::Instant silent_since_{};
};

}  // namespace nplc::mactalk_client
