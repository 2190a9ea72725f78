#pragma once

#include <optional>
#include <vector>

#include "explorer.h"

namespace nplc::verify {

/// Whether a form is judged by what is remembered from scan to scan.
bool is_remembered(Form form);

/// The shortest course among those explored that breaks such a property.
std::optional<std::vector<CourseScan>> breaking_course(const Explorer& explorer, const Property& property);

}  // namespace nplc::verify
