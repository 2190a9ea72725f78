#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/time.h"
#include "mactalk_client/line.h"
#include "protocol/mactalk.h"

/// A MacTalk master (001 §5.1), with one pending request at a time. Answers that match no request are
/// discarded; after noise it synchronises with the next complete answer.
namespace nplc::mactalk_client {

struct MasterOptions {
    std::uint32_t baud = 19'200;  ///< for transmission times; sockets are assumed to be as slow
    /// In addition to the transmission time of request and answer; includes the host's driver delays.
    base::Microseconds patience{150'000};
    unsigned attempts = 4;
};

/// Bytes of a register's write. On MAC50-141 a longword written to a number reaches the next number too.
enum class Width : std::uint8_t { word = 2, longword = 4 };

/// Repeats a request after a timeout, up to `attempts` times, where that can do no harm. Every function
/// throws LineError.
class Master {
  public:
    struct Counters {
        std::uint64_t questions = 0;  ///< sent, including repeats
        std::uint64_t answers = 0;    ///< complete ones
        std::uint64_t timeouts = 0;
        std::uint64_t stray_bytes = 0;  ///< received, but part of no answer
    };

    explicit Master(host::ByteClient& wire, const MasterOptions& options = {});

    /// The four bytes of the answer: on MAC50-141 a 16-bit register in the lower word and the next one above.
    std::uint32_t read(std::uint8_t address, std::uint8_t reg);
    /// 64 bytes from the register on.
    std::array<std::uint8_t, protocol::mactalk::kBlockBytes> read_block(std::uint8_t address,
                                                                        std::uint8_t reg);
    /// The same, requested once: for reads with a side effect. nullopt without an answer.
    std::optional<std::array<std::uint8_t, protocol::mactalk::kBlockBytes>> try_read_block(
        std::uint8_t address, std::uint8_t reg);
    /// The next sample (53h): four words, or four longwords with `bytes` 16. Requested once, since each
    /// request advances the buffer: after no_answer rewind the buffer (REWIND) and start again.
    std::vector<std::uint8_t> read_sample(std::uint8_t address, std::size_t bytes);

    /// Repeated if no accept comes, so only for registers that may be written twice.
    void write(std::uint8_t address, std::uint8_t reg, std::uint32_t value, Width width);
    /// Once. False without an accept: the request was lost or refused, or it was done and the accept lost.
    bool try_write(std::uint8_t address, std::uint8_t reg, std::uint32_t value, Width width,
                   base::Microseconds more_patience = {});
    /// 4 to 128 bytes to the gateway's table window, once.
    bool try_write_long(std::uint8_t address, std::uint8_t reg, std::span<const std::uint8_t> data,
                        base::Microseconds more_patience = {});

    /// Once and immediately, even with an answer pending; an accept is not awaited.
    void send_write(std::uint8_t address, std::uint8_t reg, std::uint32_t value, Width width);

    /// 54h, 55h: repeated until accepted.
    void safe_mode(std::uint8_t address);
    void init_mode(std::uint8_t address);
    /// 56h, 57h: sent once; they have no answer.
    void write_flash(std::uint8_t address);
    void reset(std::uint8_t address);

    /// No answer is waited for after this instant.
    void set_deadline(base::Instant deadline) { line_.set_deadline(deadline); }
    /// Waits; what is received meanwhile is discarded.
    void pause(base::Microseconds time);

    host::ByteClient& wire() { return line_.port(); }
    const Counters& counters() const { return counters_; }

  private:
    using Reply = protocol::mactalk::Reply;

    struct Question {
        std::uint8_t address;
        std::uint8_t reg;  ///< the one that the answer must name; 0: none
        protocol::mactalk::Answer answer;
        std::size_t data_bytes;
        std::span<const std::uint8_t> bytes;
        base::Microseconds more_patience{};
    };

    std::optional<Reply> ask_once(const Question& question);
    Reply ask(const Question& question);
    Reply ask(const protocol::mactalk::Request& request, std::size_t data_bytes, unsigned attempts);
    [[noreturn]] void no_answer(std::uint8_t address, unsigned attempts, std::uint64_t bytes) const;

    Line line_;
    unsigned attempts_;
    Counters counters_;
    std::uint64_t heard_ = 0;  ///< bytes since the request
};

}  // namespace nplc::mactalk_client
