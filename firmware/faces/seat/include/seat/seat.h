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

/// Where a client stands: at the machine, or at the plant's controls.
enum class Side : std::uint8_t {
    person,  ///< a person's port or a panel
    plant,   ///< a PLC or a SCADA system
};

/// From which side the axis may be operated.
enum class Control : std::uint8_t { any, local, remote };

/// Who sits: `number` is another one for every client of every face and port of an axis. All clients of one
/// `user` are one operator; empty: it is one by itself.
struct Sitter {
    std::uint64_t number = 0;
    Side side = Side::person;
    std::string name{};
    registers::gateway::OperatorWay way = registers::gateway::OperatorWay::other;
    std::uint32_t peer = 0;  ///< by that way
    std::string user{};
};

/// Only one client at a time operates an axis; all may watch, and stop, safe and hold ask nobody. The seat
/// is taken by the first operating command, or by taking it, and is free again when its client leaves (of a
/// user's clients the last one that has operated), gives it back, or has not operated for `silence`; another
/// client may take it over. Belongs to the axis's loop; what others see of it is in AxisImage.
class Seat {
  public:
    enum class Verdict : std::uint8_t {
        granted,
        taken,       ///< another client has it
        local,       ///< only persons may operate now
        remote,      ///< only the plant may
        taken_over,  ///< another client has it, which took it over from this one
    };
    struct TakeOver {
        Sitter from;
        Sitter by;
    };

    explicit Seat(base::Microseconds silence = kSilence) : silence_(silence) {}
    static constexpr base::Microseconds kSilence{10'000'000};

    /// May this client operate now? Granted, it has the seat, for `silence` anew.
    Verdict take(const Sitter& client, base::Instant now);
    /// The same, whoever has it.
    Verdict take_over(const Sitter& client, base::Instant now);
    /// The client has left.
    void leave(std::uint64_t client);
    /// The client gives the seat up, for all clients of its user. False: it has not got it.
    bool give_back(const Sitter& client);
    /// For who reports it, since the last call.
    std::optional<TakeOver> take_news() { return std::exchange(news_, std::nullopt); }
    /// Frees the seat of who has been silent for too long, or is on the wrong side by now.
    void look(base::Instant now);

    void set_silence(base::Microseconds silence) { silence_ = silence; }
    void set_control(Control control) { control_ = control; }
    Control control() const { return control_; }
    /// Null: the seat is free.
    const Sitter* holder() const { return holder_ ? &*holder_ : nullptr; }
    bool is_holder(const Sitter& client) const { return holder_ && is_same(*holder_, client); }
    bool was_taken_from(const Sitter& client) const { return taken_from_ && is_same(*taken_from_, client); }
    /// When look() has something to do.
    base::Instant ends() const { return holder_ ? since_ + silence_ : base::kNever; }

    /// A number that no other client of this process has.
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

/// Of a verdict other than granted: the detail of result seat_taken.
constexpr std::uint16_t detail_of(Seat::Verdict verdict) {
    return static_cast<std::uint16_t>(static_cast<unsigned>(verdict) - 1U);
}
static_assert(detail_of(Seat::Verdict::taken) == registers::gateway::kSeatOfAnother);
static_assert(detail_of(Seat::Verdict::taken_over) == registers::gateway::kSeatTakenOver);

}  // namespace nplc::faces
