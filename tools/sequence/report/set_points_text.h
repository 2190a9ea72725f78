#pragma once

#include <string>
#include <vector>

#include "seqc/seqc.h"

namespace nplc::seqc {

/// "80 mm, 10 mm to 200 mm in steps of 0.1 mm"
std::string text_of(const set_points::SetPoint& point);

/// Each set-point with its range and places; empty without any.
std::string set_points_text(const Symbols& symbols);

/// A change of a set-point between two tables.
struct SetPointChange {
    std::string name;
    std::string before;  ///< empty: there was none
    std::string now;     ///< empty: there is none
};
std::vector<SetPointChange> set_point_changes(const Symbols* before, const Symbols* now);

}  // namespace nplc::seqc
