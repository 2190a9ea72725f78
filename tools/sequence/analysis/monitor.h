#pragma once

#include <optional>
#include <vector>

#include "conflict.h"
#include "explorer.h"

namespace nplc::verify {

/// Whether a form is judged by facts stored from scan to scan.
bool is_remembered(Form form);

/// The shortest counterexample of such a property among the explored courses, without the excluded ones.
std::optional<std::vector<CourseScan>> breaking_course(const Explorer& explorer, const Property& property,
                                                       Excluded* excluded = nullptr);

}  // namespace nplc::verify
