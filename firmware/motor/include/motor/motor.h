#pragma once

#include <cstdint>

#include "base/time.h"
#include "registers/vocabulary.h"
#include "sequencer/state.h"

/// Lines may delay characters, as a USB adapter does. A microcontroller's own UART does not, and its image is
/// built without this.
#ifndef NPLC_LATE_LINES
#define NPLC_LATE_LINES 1
#endif

namespace nplc::motor {

inline constexpr bool kLateLines = NPLC_LATE_LINES != 0;
inline constexpr base::Microseconds kLongestEcho{40'000};  ///< a line with a longer delay is not used

/// An order of a sequence to a drive.
using Order = sequencer::MotorOrder;

/// A user's register access, carried out between the sequence's orders.
struct Access {
    bool is_write = false;
    std::uint8_t reg = 0;
    bool longword = false;
    std::uint32_t value = 0;  ///< to write
    bool operator==(const Access&) const = default;
};

enum class AccessState : std::uint8_t {
    none,
    waiting,    ///< dropped if the link is lost or a stop comes
    under_way,  ///< on the line
    done,
    failed,  ///< a read without an answer; a write that may have been executed or not
};

/// The access is still in progress: its state will change by itself.
constexpr bool is_open(AccessState state) {
    return state == AccessState::waiting || state == AccessState::under_way;
}

/// In the order of the registers from LINK_LOSSES on.
struct Counters {
    std::uint32_t link_losses = 0;
    std::uint32_t resent = 0;     ///< messages sent again
    std::uint32_t orders = 0;     ///< executed
    std::uint32_t discarded = 0;  ///< not delivered because the link was not up
    std::uint32_t accesses = 0;   ///< done
    std::uint32_t access_fails = 0;
};

using registers::gateway::Link;

constexpr bool link_is_usable(Link link) {
    return link == Link::unacknowledged || link == Link::up;
}

/// Interface of a drive for the gateway. Nothing blocks; time is passed in.
class Motor {
  public:
    /// Sends, receives and checks timeouts. To be called at least once a millisecond; or whenever something
    /// arrives on the line and when the driver's own next_poll() is due, which is not part of this interface,
    /// since boards that always poll do not need it.
    virtual void poll(base::Instant now) = 0;

    /// Begins sending what send() and stop() have queued, as far as the line is free, so that it need not
    /// wait for the next poll(). Receives nothing.
    virtual void begin_orders(base::Instant now) = 0;

    /// Every order has been executed or dropped and in_position() and error() are newer than the last order:
    /// a scan may begin. Also true while the link is down (the scan then sees error()).
    virtual bool orders_complete() const = 0;

    /// Whether the drive supports this order. A table with an unsupported order is refused when it is loaded.
    virtual bool can_execute(const Order& order) const = 0;

    /// Room for one more order.
    virtual bool has_room() const = 0;

    /// Queues an order; needs has_room(). Orders are executed in the order given. Discarded unless the link
    /// delivers: no order is ever delivered late.
    virtual void send(const Order& order) = 0;

    /// Drops the queued orders and sends the drive a stop (INIT) before anything else, as soon as the link
    /// delivers.
    virtual void stop() = 0;

    /// The drive has confirmed the last stop(): by the echo of the stop itself, or its shaft was read at
    /// standstill. True if there was no stop. Until then the stop is repeated, blind where nothing answers.
    virtual bool stop_confirmed() const = 0;

    /// Ends the repetition of an unconfirmed stop.
    virtual void give_up_stop() = 0;

    /// Starts an access; false if another one is open or the link does not deliver. It comes after all
    /// orders, and orders_complete() does not wait for it.
    virtual bool begin_access(const Access& access) = 0;
    virtual AccessState access_state() const = 0;
    virtual std::uint32_t access_value() const = 0;  ///< of a read that is done
    /// Drops the access. A waiting one is never executed; one in progress stays until it has ended.
    virtual void drop_access() = 0;

    virtual bool in_position() const = 0;

    /// The drive's own error, or a loss of the link that is not acknowledged yet.
    virtual bool error() const = 0;

    /// Reason of the error, if the driver itself detected it (REGISTERS.md, event 32); 0: none.
    virtual std::uint8_t fault_number() const { return 0; }

    virtual Link link() const = 0;

    virtual Counters counters() const = 0;

    /// From the end of a message to its echo, slowly decreasing maximum; 0: not measured.
    virtual base::Microseconds echo_time() const { return {}; }

    /// Registers are longwords only (MAC800), one per number; else words, of which a longword takes two.
    virtual bool longwords_only() const = 0;

  protected:
    ~Motor() = default;
};

}  // namespace nplc::motor
