#pragma once

#include <string>

#include "explorer.h"

/// Proofs of nothing: what a property asks about never is.
namespace nplc::verify {

/// A target that is hit if there is something to judge; for forms that look at one scan.
Target subject_of(const Property& property);

/// Why a property that is proved says nothing; empty if it says something. `is_met`: its subject was hit.
std::string why_vacuous(const Explorer& explorer, const Property& property, bool is_met);

}  // namespace nplc::verify
