#pragma once

#include <string_view>
#include <vector>

#include "analysis/property.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

struct PropertyReading {
    std::vector<verify::Property> properties;
    std::vector<verify::Assumption> assumptions;
    std::vector<Span> names;              ///< where each property's name stands
    std::vector<Diagnostic> diagnostics;  ///< with an error there are no properties
};

/// The properties of a program that compiles without errors; `symbols` are those of its compilation.
PropertyReading properties_of(const Sources& program, const Symbols& symbols);

/// A file of properties: `PROPERTY Name: claim;` and `ASSUME`, comments as in programs. Takes any bytes.
PropertyReading read_properties(std::string_view text, const Symbols& symbols);

}  // namespace nplc::seqc
