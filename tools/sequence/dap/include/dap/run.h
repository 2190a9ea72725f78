#pragma once

#include <iosfwd>

namespace nplc::dap {

/// Runs the debug adapter on two streams until it is disconnected or `in` ends. Returns the exit code.
int run_adapter(std::istream& in, std::ostream& out);

}  // namespace nplc::dap
