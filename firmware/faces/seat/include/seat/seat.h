#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/time.h"
#include "registers/vocabulary.h"

namespace nplc::faces {

/// A client's side: at the machine, or in the plant's control system.
enum class Side : std::uint8_t {
    person,  ///< a local user port or a panel
    plant,   ///< a PLC or a SCADA system
};

/// The sides from which the axis may be operated.
enum class Control : std::uint8_t { any, local, remote };

/// A client: `number` is unique over all faces and ports of an axis. All clients of one `user` are one
/// operator; empty: the client is an operator of its own.
struct Sitter {
    std::uint64_t number = 0;
    Side side = Side::person;
    std::string name{};
    registers::gateway::OperatorWay way = registers::gateway::OperatorWay::other;
    std::uint32_t peer = 0;  ///< user number or address, depending on the way
    std::string user{};
};

/// Only one client at a time operates an axis; all may watch, and stop, safe and hold need no seat. The seat
/// is taken by the first operating command, or explicitly, and is freed when its client leaves (for a user
/// the last client that has operated), gives it back, or has not operated for `silence`; another client may
/// take it over. Used by the axis's loop; others see its state in AxisImage.
class Seat {
  public:
    enum class Verdict : std::uint8_t {
        granted,
        taken,       ///< another client has it
        local,       ///< only local clients may operate now
        remote,      ///< only the plant may
        taken_over,  ///< another client has it, which took it over from this one
    };
    struct TakeOver {
        Sitter from;
        Sitter by;
    };

    explicit Seat(base::Microseconds silence = kSilence) : silence_(silence) {}
    static constexpr base::Microseconds kSilence{10'000'000};

    /// Whether this client may operate now. If granted it has the seat, and `silence` restarts.
    Verdict take(const Sitter& client, base::Instant now);
    /// The same, for any holder.
    Verdict take_over(const Sitter& client, base::Instant now);
    /// The client has left.
    void leave(std::uint64_t client);
    /// The client gives the seat back, for all clients of its user. False: it does not have it.
    bool give_back(const Sitter& client);
    /// A take-over since the last call, for reporting.
    std::optional<TakeOver> take_news() { return std::exchange(news_, std::nullopt); }
    /// Frees the seat if its holder has been silent for too long, or is now on the wrong side.
    void look(base::Instant now);

    void set_silence(base::Microseconds silence) { silence_ = silence; }
    void set_control(Control control) { control_ = control; }
    Control control() const { return control_; }
    /// Null: the seat is free.
    const Sitter* holder() const { return holder_ ? &*holder_ : nullptr; }
    bool is_holder(const Sitter& client) const { return holder_ && is_same(*holder_, client); }
    bool was_taken_from(const Sitter& client) const { return taken_from_ && is_same(*taken_from_, client); }
    /// When look() has work to do.
    base::Instant ends() const { return holder_ ? since_ + silence_ : base::kNever; }

    /// A number that is unique in this process.
    static std::uint64_t new_number();

  private:
    static bool is_same(const Sitter& a, const Sitter& b);
    void sit(const Sitter& client, base::Instant now);
    void free();
    std::optional<Verdict> wrong_side(Side side) const;

    base::Microseconds silence_;
    Control control_ = Control::any;
    std::optional<Sitter> holder_;
    std::vector<std::uint64_t> sitting_;  ///< numbers of its user's clients that have operated
    std::optional<Sitter> taken_from_;    ///< by holder_
    std::optional<TakeOver> news_;
    base::Instant since_{};
};

/// For a verdict other than granted: the detail of result seat_taken.
constexpr std::uint16_t detail_of(Seat::Verdict verdict) {
    return static_cast<std::uint16_t>(static_cast<unsigned>(verdict) - 1U);
}
static_assert(detail_of(Seat::Verdict::taken) == registers::gateway::kSeatOfAnother);
static_assert(detail_of(Seat::Verdict::taken_over) == registers::gateway::kSeatTakenOver);

}  // namespace nplc::faces
