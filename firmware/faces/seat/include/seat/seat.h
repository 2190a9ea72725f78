#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/time.h"

namespace nplc::faces {

/// Where a client stands: at the machine, or at the plant's controls.
enum class Side : std::uint8_t {
    person,  ///< a person's port or a panel
    plant,   ///< a PLC or a SCADA system
};

/// From which side the axis may be operated.
enum class Control : std::uint8_t { any, local, remote };

/// Who sits: `number` is another one for every client of every face and port of an axis.
struct Sitter {
    std::uint64_t number = 0;
    Side side = Side::person;
    std::string name{};
};

/// Only one client at a time operates an axis; all may watch, and stop, safe and hold ask nobody. The seat
/// is taken by the first operating command, or by taking it, and is free again when its client leaves or has
/// not operated for `silence`. Belongs to the axis's loop; what others see of it is in AxisImage.
class Seat {
  public:
    enum class Verdict : std::uint8_t {
        granted,
        taken,   ///< another client has it
        local,   ///< only persons may operate now
        remote,  ///< only the plant may
    };

    explicit Seat(base::Microseconds silence = kSilence) : silence_(silence) {}
    static constexpr base::Microseconds kSilence{10'000'000};

    /// May this client operate now? Granted, it has the seat, for `silence` anew.
    Verdict take(const Sitter& client, base::Instant now);
    /// The client has left, or gives the seat up.
    void leave(std::uint64_t client);
    /// Frees the seat of who has been silent for too long, or is on the wrong side by now.
    void look(base::Instant now);

    void set_control(Control control) { control_ = control; }
    Control control() const { return control_; }
    /// Null: the seat is free.
    const Sitter* holder() const { return holder_ ? &*holder_ : nullptr; }
    /// When look() has something to do.
    base::Instant ends() const { return holder_ ? since_ + silence_ : base::kNever; }

    /// A number that no other client of this process has.
    static std::uint64_t new_number();

  private:
    std::optional<Verdict> wrong_side(Side side) const;

    base::Microseconds silence_;
    Control control_ = Control::any;
    std::optional<Sitter> holder_;
    base::Instant since_{};
};

/// Of a verdict other than granted: the detail of result seat_taken.
constexpr std::uint16_t detail_of(Seat::Verdict verdict) {
    return static_cast<std::uint16_t>(static_cast<unsigned>(verdict) - 1U);
}

}  // namespace nplc::faces
