#pragma once

#include <cstdint>
#include <vector>

#include "lowering/lower.h"
#include "semantics/model.h"
#include "semantics/scope.h"

/// Where in a table the values of set-points lie. While terms are made, each has a value that nothing else in
/// the program has, so that no term of it is shared with another one's or with a constant's.
namespace nplc::seqc {

class SetPointMarks {
  public:
    SetPointMarks(const Plan& plan, const std::vector<DeclaredSetPoint>& points);

    /// The plan with a mark in place of each set-point's value. The plan it was made from must stay alive.
    const Plan& plan() const { return marked_; }

    /// Puts the defaults into terms that were made from plan(), and notes their numbers in `points`.
    void place(std::vector<LoweredTerm>& terms, std::vector<set_points::SetPoint>& points) const;

  private:
    std::uint32_t free_value(const DeclaredSetPoint& declared) const;
    void mark(Action& action) const;

    const std::vector<DeclaredSetPoint>& points_;
    Plan marked_;
    std::vector<std::uint32_t> marks_;
};

/// What goes with the table: the set-points that something uses, and the steps that take changed values.
set_points::Record record_of(const Plan& plan, const std::vector<DeclaredSetPoint>& declared,
                             const std::vector<set_points::SetPoint>& placed);

}  // namespace nplc::seqc
