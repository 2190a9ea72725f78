#pragma once

#include <algorithm>

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

    explicit Supply(const Constants& constants)
        : constants_(constants),
          source_siemens_(1 / constants.source_ohms),
          dump_siemens_(1 / constants.dump_ohms),
          per_farad_(1 / constants.farads),
          volts_(constants.source_volts) {}

    /// What the source gives without load; may be changed at any time.
    void set_source(double volts) { constants_.source_volts = std::clamp(volts, 0.0, kMost); }
    double source() const { return constants_.source_volts; }

    double volts() const { return volts_; }
    bool dumping() const { return volts_ > constants_.dump_volts; }

    /// `watts` go to the windings for `seconds`; negative: they come back.
    void step(double watts, double seconds) {
        double amperes = -watts / volts_;
        const double missing = constants_.source_volts - volts_;
        if (missing > 0) amperes += missing * source_siemens_;
        if (dumping()) amperes -= volts_ * dump_siemens_;
        volts_ = std::clamp(volts_ + amperes * seconds * per_farad_, kLeast, kMost);
    }
    /// The bus of a source that was switched off and on, or one that has had time.
    void settle() { volts_ = std::max(constants_.source_volts, kLeast); }

  private:
    Constants constants_;
    double source_siemens_;
    double dump_siemens_;
    double per_farad_;
    double volts_;
};

}  // namespace nplc::sim
