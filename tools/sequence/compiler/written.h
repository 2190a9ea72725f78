#pragma once

#include "compiler/model.h"
#include "language/ast.h"
#include "seqc/written.h"

namespace nplc::seqc {

/// `plan`: including compiler-generated steps.
Written written_of(const ast::Program& program, const Plan& plan, const std::vector<Send>& initial_values);

}  // namespace nplc::seqc
