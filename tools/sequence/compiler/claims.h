#pragma once

#include <vector>

#include "analysis/property.h"
#include "compiler/scope.h"
#include "diagnostics/report.h"
#include "language/ast.h"

namespace nplc::seqc {

/// Properties and assumptions in numbers of steps, signals and milliseconds.
struct Claims {
    std::vector<verify::Property> properties;
    std::vector<verify::Assumption> assumptions;
};

/// Resolves the names in a program's properties and assumptions. `is_whole`: all compiler-generated steps
/// have their names.
Claims resolve_claims(const ast::Program& program, Scope& scope, bool is_whole, Report& report);
/// The same for a table whose names are known.
Claims resolve_claims(const ast::Program& claims, const Symbols& symbols, Report& report);

}  // namespace nplc::seqc
