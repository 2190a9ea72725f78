#pragma once

#include <algorithm>

#include "sim/bounds.h"

namespace nplc::sim {

/// The motor's power supply: a source that gives but does not take, the capacitor of the bus, and the power
/// dump that turns what comes back from the shaft into heat (001 §3.2.18, §4.5.2).
class Supply {
  public:
    struct Constants {
        double source_volts;  ///< without load
        double dump_volts;    ///< above it the dump is on: 52 V on MAC50-141 (001 §3.2.18)
        double source_ohms;
        double dump_ohms;
        double farads;
    };
    static constexpr double kLeast = 1;  // V, what keeps a division alive
    static constexpr double kMost = 1000;
    static constexpr double kBleedSeconds = 0.5;  ///< time constant with which the bus falls to its source
    static constexpr double kHold = 1.004;        ///< times dump_volts: what the dump keeps the bus at

    /// `seconds`: of a step.
    Supply(const Constants& constants, double seconds)
        : constants_(constants),
          volts_of_ampere_(seconds / constants.farads),
          charged_(volts_of_ampere_ / (volts_of_ampere_ + constants.source_ohms)),
          bled_(seconds / (seconds + kBleedSeconds)),
          dumped_(volts_of_ampere_ / (volts_of_ampere_ + constants.dump_ohms)),
          held_(constants.dump_volts * kHold),
          volts_(constants.source_volts) {}

    /// What the source gives without load; may be changed at any time.
    void set_source(double volts) { constants_.source_volts = std::clamp(volts, 0.0, kMost); }
    double source() const { return constants_.source_volts; }

    double volts() const { return volts_; }
    bool dumping() const { return volts_ > constants_.dump_volts; }

    /// `watts` go to the windings for a step; negative: they come back. Source and dump in implicit steps,
    /// which no step is too long for.
    void step(double watts) {
        double volts = volts_ - watts / volts_ * volts_of_ampere_;
        if (volts > held_) volts = std::max(volts - volts * dumped_, held_);
        if (volts > constants_.source_volts) volts = std::max(volts - volts * bled_, constants_.source_volts);
        if (volts < constants_.source_volts) volts += (constants_.source_volts - volts) * charged_;
        volts_ = within(volts, kLeast, kMost);
    }
    /// The bus of a source that was switched off and on, or one that has had time.
    void settle() { volts_ = std::max(constants_.source_volts, kLeast); }

  private:
    Constants constants_;
    double volts_of_ampere_;
    double charged_;  // of what is missing, in a step
    double bled_;
    double dumped_;
    double held_;  // what the dump keeps the bus at
    double volts_;
};

}  // namespace nplc::sim
