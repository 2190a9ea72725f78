#pragma once

#include <iosfwd>

namespace nplc::dap {

/// The debug adapter on two streams, until it is disconnected or `in` ends. Answers the exit code.
int run_adapter(std::istream& in, std::ostream& out);

}  // namespace nplc::dap
