#pragma once

#include <iosfwd>

namespace nplc::seqc::lsp {

/// Runs the language server on two streams, until `exit` or the end of `in`. Returns the exit code: 0 after
/// shutdown and exit, else 1.
int run_server(std::istream& in, std::ostream& out);

}  // namespace nplc::seqc::lsp
