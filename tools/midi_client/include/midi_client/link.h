#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "base/time.h"
#include "mactalk_client/master.h"
#include "protocol/answer_count.h"

/// The client's end of a line or bus with MIDI Ingenierie modules: one request, one answer.
namespace nplc::midi_client {

using mactalk_client::Interrupted;
using mactalk_client::LineError;

/// A command or query of registers/midi.h, which has the same number on both transports.
struct Request {
    std::uint8_t address = 0;
    bool query = false;
    std::uint8_t number = 0;
    std::uint8_t sub_index = 0;
    std::uint32_t data = 0;
    bool operator==(const Request&) const = default;
};

struct Answer {
    enum class Kind : std::uint8_t {
        accepted,   ///< the command was carried out
        value,      ///< the query was answered
        refused,    ///< received but not carried out
        not_taken,  ///< not understood by the module: not carried out
        unclear,    ///< a damaged answer; a command may have been carried out
        silence,    ///< no answer; a command may have been carried out
    };
    Kind kind = Kind::silence;
    std::uint32_t value = 0;
    /// `refused` by 18h, as some modules answer; a single damaged bit turns Xon into it.
    bool by_18h = false;
};

class Link {
  public:
    virtual ~Link() = default;
    virtual const std::string& name() const = 0;
    virtual bool is_can() const = 0;

    /// Sends it once and waits for its answer. Throws LineError if the port is gone.
    virtual Answer ask(const Request& request) = 0;
    /// Starts what WAIT_SYNC prepared in all modules at once: command 11h to all (000 §VI), or SYNC (003
    /// §V.4), which has no answer.
    virtual Answer synchronise() = 0;
    /// The broadcast address: all act, one answers (FFh and 00 on V24, 0 and 1 on CAN).
    virtual std::uint8_t everyone() const = 0;
    /// The factory's address.
    virtual std::uint8_t usual_address() const = 0;
    /// The minimum time of a command with its answer.
    virtual base::Microseconds exchange_time() const = 0;

    /// Waits; what is received meanwhile is discarded.
    virtual void pause(base::Microseconds time) = 0;
    virtual base::Instant now() = 0;

    /// The last request and its answer, as a user writes it: "02 30 31 .. 03", "601#2313200000000320".
    virtual std::string last_sent() const = 0;
    virtual std::string last_heard() const = 0;
    /// The module has reported a restart since the last call. Only on CAN (003 §V.2).
    virtual bool take_boot(std::uint8_t) { return false; }
    /// Another master has sent SYNC since the last call. Only on CAN (003 §V.4).
    virtual bool take_foreign_sync() { return false; }
    /// Anything was received since the link was opened.
    virtual bool heard_anything() const = 0;

    /// Whether an address gives more answers than it got requests.
    const protocol::AnswerCount& answers(std::uint8_t address) const { return answers_[address]; }

  protected:
    protocol::AnswerCount& counter(std::uint8_t address) { return answers_[address]; }

  private:
    std::array<protocol::AnswerCount, 256> answers_{};
};

}  // namespace nplc::midi_client
