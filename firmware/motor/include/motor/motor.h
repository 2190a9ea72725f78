#pragma once

#include <cstdint>

#include "base/time.h"
#include "registers/vocabulary.h"
#include "sequencer/state.h"

namespace nplc::motor {

/// What a sequence asks of a drive.
using Order = sequencer::MotorOrder;

/// A register that the user reads or writes between the sequence's orders.
struct Access {
    bool is_write = false;
    std::uint8_t reg = 0;
    bool longword = false;
    std::uint32_t value = 0;  ///< to write
    bool operator==(const Access&) const = default;
};

enum class AccessState : std::uint8_t {
    none,
    waiting,    ///< dropped without a trace if the link is lost or a stop comes
    under_way,  ///< on the line
    done,
    failed,  ///< a read that was not answered; a write that may have been executed or not
};

/// It will become another state without being asked for anything.
constexpr bool is_open(AccessState state) {
    return state == AccessState::waiting || state == AccessState::under_way;
}

/// In the order of the user's registers from LINK_LOSSES on.
struct Counters {
    std::uint32_t link_losses = 0;
    std::uint32_t resent = 0;     ///< messages sent again
    std::uint32_t orders = 0;     ///< executed
    std::uint32_t discarded = 0;  ///< not delivered because the link was not up
    std::uint32_t accesses = 0;   ///< done
    std::uint32_t access_fails = 0;
};

using registers::gateway::Link;

constexpr bool delivers(Link link) {
    return link == Link::unacknowledged || link == Link::up;
}

/// A drive as the gateway sees it. Nothing blocks; time is passed in.
class Motor {
  public:
    /// Moves bytes and time limits on. To be called at least once a millisecond; or whenever something
    /// arrives on the line, and when the driver's own next_poll() is due, which a board that always polls
    /// does not have.
    virtual void poll(base::Instant now) = 0;

    /// Begins what send() and stop() have left to do, as far as the line is free, so that it need not wait
    /// for the next poll(). Reads nothing.
    virtual void begin_orders(base::Instant now) = 0;

    /// Every order has been executed or dropped and in_position() and error() are newer than the last of
    /// them: a scan may begin. Also true while the link is down (the scan then sees error()).
    virtual bool settled() const = 0;

    /// Has the drive anything that this order could be? A table with one that it has not is refused when it
    /// is loaded.
    virtual bool can_execute(const Order& order) const = 0;

    /// Room for one more order.
    virtual bool has_room() const = 0;

    /// Takes an order; needs has_room(). Orders are executed in the order given. Discarded unless the link
    /// delivers: no order is ever delivered late.
    virtual void send(const Order& order) = 0;

    /// Drops the waiting orders and tells the drive to stop (INIT) before anything else; as soon as the link
    /// delivers.
    virtual void stop() = 0;

    /// The drive has confirmed the last stop() since it was given: the echo of the stop itself, or its shaft
    /// read at rest. True if there was none. Until then it is repeated, blind where nothing answers.
    virtual bool stop_confirmed() const = 0;

    /// Ends the repetition of a stop that is not confirmed.
    virtual void give_up_stop() = 0;

    /// Takes an access, unless there is one that waits or is under way, or the link does not deliver. It
    /// comes after all orders, and settled() does not wait for it.
    virtual bool begin_access(const Access& access) = 0;
    virtual AccessState access_state() const = 0;
    virtual std::uint32_t access_value() const = 0;  ///< of a read that is done
    /// Forgets the access. One that still waits is never executed; one under way stays until it has ended.
    virtual void drop_access() = 0;

    virtual bool in_position() const = 0;

    /// The drive's own error, or a link that went down and is not acknowledged yet.
    virtual bool error() const = 0;

    /// Why it has an error, where the driver itself found it (REGISTERS.md, event 32); 0: for no such reason.
    virtual std::uint8_t fault_number() const { return 0; }

    virtual Link link() const = 0;

    virtual Counters counters() const = 0;

    /// From the end of a message to its echo, the worst of late; 0: not measured.
    virtual base::Microseconds echo_time() const { return {}; }

    /// Registers are longwords only (MAC800), one a number; else words, of which a longword takes two.
    virtual bool longwords_only() const = 0;

  protected:
    ~Motor() = default;
};

}  // namespace nplc::motor
