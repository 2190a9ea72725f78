#pragma once

#include <string>

#include "explorer.h"

/// Vacuous proofs: the condition of a property never occurs.
namespace nplc::verify {

/// A target that is reached if there is something to judge; for forms about one scan.
Target subject_of(const Property& property);

/// Why a proved property is vacuous; empty if it is not. `is_met`: its subject was reached.
std::string why_vacuous(const Explorer& explorer, const Property& property, bool is_met);

}  // namespace nplc::verify
