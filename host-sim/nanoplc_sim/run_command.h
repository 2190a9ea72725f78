#pragma once

#include <csignal>

#include "run_options.h"

namespace nplc::sim {

/// `nanoplc-sim run`. Answers the exit code: 0, or 1 if an expectation failed. `interrupted` becomes other
/// than 0 when the user wants the run to end: it then ends in good order. Throws InputError, FileError,
/// EndlessRules.
int run(const RunOptions& options, const volatile std::sig_atomic_t& interrupted);

}  // namespace nplc::sim
