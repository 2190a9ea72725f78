#pragma once

#include <cstdint>
#include <vector>

#include "compiler/model.h"
#include "compiler/scope.h"
#include "lowering/lower.h"

/// The places of set-point values in a table. While terms are generated, each has a unique marker value, so
/// that its terms are not shared with those of another set-point or a constant.
namespace nplc::seqc {

class SetPointMarks {
  public:
    SetPointMarks(const Plan& plan, const std::vector<DeclaredSetPoint>& points);

    /// The plan with a marker in place of each set-point's value. The original plan must stay valid.
    const Plan& plan() const { return marked_; }

    /// Puts the defaults into terms generated from plan(), and stores their numbers in `points`.
    void place(std::vector<LoweredTerm>& terms, std::vector<set_points::SetPoint>& points) const;

  private:
    std::uint32_t free_value(const DeclaredSetPoint& declared) const;
    void mark(Action& action) const;

    const std::vector<DeclaredSetPoint>& points_;
    Plan marked_;
    std::vector<std::uint32_t> marks_;
};

/// The record for the table: the set-points in use, and the steps that take changed values.
set_points::Record record_of(const Plan& plan, const std::vector<DeclaredSetPoint>& declared,
                             const std::vector<set_points::SetPoint>& placed);

}  // namespace nplc::seqc
