#pragma once

#include <string>

#include "explorer.h"

/// Vacuous proofs: the condition of a property never occurs.
namespace nplc::verify {

/// A target that is reached if there is something to judge; for forms about one scan.
Target subject_of(const Property& property);

/// Why a property that is proved says nothing; empty if it says something. `is_met`: its subject was hit.
std::string why_vacuous(const Explorer& explorer, const Property& property, bool is_met);

}  // namespace nplc::verify
