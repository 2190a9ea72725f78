#pragma once

#include "semantics/model.h"
#include "seqc/written.h"
#include "syntax/ast.h"

namespace nplc::seqc {

/// `plan`: including compiler-generated steps.
Written written_of(const ast::Program& program, const Plan& plan, const std::vector<Send>& initial_values);

}  // namespace nplc::seqc
