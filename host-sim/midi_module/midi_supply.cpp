#include "sim/midi_supply.h"

#include "registers/midi_scale.h"

namespace nplc::sim {
namespace {

namespace midi = registers::midi;

constexpr std::int64_t kRelease = std::int64_t{midi::kTicksPerSecond} / 200;

}  // namespace

bool MidiSupply::is_over_release(std::int32_t millivolts) const {
    return std::int64_t{millivolts} * 100 > std::int64_t{facts_.max_supply} * midi::kReleasePercent;
}

bool MidiSupply::trips_amplifier() const {
    return std::int64_t{voltage()} * 100 > std::int64_t{facts_.max_supply} * midi::kTripPercent;
}

void MidiSupply::cut_excess(Ticks now) {
    if (!is_over_release(voltage()) || now < release_until_ + kRelease) return;
    release_until_ = now + kRelease;
    brakes_ = false;
}

}  // namespace nplc::sim
