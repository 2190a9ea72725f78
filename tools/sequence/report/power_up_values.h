#pragma once

#include <map>
#include <vector>

#include "report/machine.h"
#include "report/table_diff.h"

namespace nplc::seqc {

/// The register values that POWER_UP writes in two tables, so that a changed value is reported once and not
/// for each transition from POWER_UP.
class PowerUpValues {
  public:
    PowerUpValues(const Machine& before, const Machine& now);

    std::vector<TableDiff::Value> changes(const Symbols* names_before, const Symbols* names_now) const;

    /// Makes orders of step 0 equal if they differ only by such a value.
    void level(std::vector<sequencer::MotorOrder>& before, std::vector<sequencer::MotorOrder>& now) const;

  private:
    using Writes = std::map<std::uint8_t, sequencer::MotorOrder>;
    static Writes writes_of(const Machine& machine);

    Writes before_;
    Writes now_;
};

}  // namespace nplc::seqc
