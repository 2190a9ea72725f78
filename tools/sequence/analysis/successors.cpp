#include "successors.h"

namespace nplc::verify {
namespace {

using Motor = Place::Motor;

constexpr std::uint8_t bit_of(Motor motor) {
    return static_cast<std::uint8_t>(1U << static_cast<unsigned>(motor));
}

}  // namespace

Successors::Successors(const Machine& machine, const Precision& precision)
    : machine_(machine),
      precision_(precision),
      uses_zones_(precision.times_timer || precision.deadline != nullptr),
      times_moves_(uses_zones_ && machine.move_ms() != 0) {
    allowed_.fill(machine.permitted());
    if (machine.assume() != Assume::any) {
        for (const Motor motor : {Motor::error, Motor::cut})
            allowed_[static_cast<std::size_t>(motor)] &= images_of_error();
        allowed_[static_cast<std::size_t>(Motor::lost)] &= images_of_lost_link();
    }
    find_next_motors();
}

Successors::Parts Successors::parts(const Place& place, const View& view, const ImageSet& images) const {
    if (precision_.deadline == nullptr) return {Part{images, false, false}, Part{}};
    const ImageSet kept = images_where(precision_.deadline->then, view);
    if (is_hold()) return {Part{images & ~kept, false, false}, Part{images & kept, !place.pending, true}};
    if (place.pending) return {Part{images & kept, false, false}, Part{images & ~kept, false, true}};
    const ImageSet begun = images_where(precision_.deadline->condition, view) & ~kept;
    return {Part{images & ~begun, false, false}, Part{images & begun, true, true}};
}

/// Whether a scan that meets the deadline when it begins may end after it.
bool Successors::ends_late(const Zone& zone, const Group& group) const {
    if (machine_.assume() == Assume::any || group.delay.end == 0) return false;
    return std::int64_t{zone.passed.most} + group.delay.end > precision_.deadline->within_ms;
}

/// Whether what NEVER .. WHILE forbids holds after the scan, and WHILE's condition may have held for the
/// time.
bool Successors::keeps_too_long(const Place& place, const Zone& zone, const Group& group, const View& view,
                                const ImageSet& images) const {
    const Property& hold = *precision_.deadline;
    const std::uint32_t end = machine_.assume() == Assume::any ? 0 : group.delay.end;
    return place.pending && std::int64_t{zone.passed.most} + end >= hold.within_ms &&
           (images & images_where(hold.then, view) & images_where(hold.condition, view)).any();
}

/// The same as `after` and `each` say, for every place at once.
void Successors::find_next_motors() {
    const bool driver = machine_.assume() == Assume::driver;
    for (const Group& group : machine_.all_groups()) {
        auto& motors = next_motors_.emplace_back();
        for (const Motor motor : {Motor::free, Motor::error, Motor::lost, Motor::cut}) {
            const ImageSet images = group.images & allowed_[static_cast<std::size_t>(motor)];
            if (images.none() || (!driver && motor != Motor::free)) continue;
            std::uint8_t& next = motors[static_cast<std::size_t>(motor)];
            const bool shows_error = group.error && !group.resets_error;
            if (!(shows_error && motor == Motor::lost))
                next |= bit_of(shows_error ? Motor::error : Motor::free);
            const bool may_be_lost = (images & images_of_lost_link()).any();
            if (shows_error && precision_.knows_lost_link && motor != Motor::error && may_be_lost)
                next |= bit_of(Motor::lost);
            if (driver && !shows_error && group.outcome.sends()) next |= bit_of(Motor::cut);
            for (const Motor then : {Motor::free, Motor::error, Motor::lost, Motor::cut}) {
                if (allowed_[static_cast<std::size_t>(then)].none())
                    next &= static_cast<std::uint8_t>(~bit_of(then));
            }
        }
    }
}

}  // namespace nplc::verify
