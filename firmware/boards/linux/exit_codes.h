#pragma once

namespace nplc::boards {

enum ExitCode : int {
    kDone = 0,
    kWrong = 2,     ///< the command line or the configuration
    kNoDevice = 3,  ///< the watchdog could not be had; of check-config: what an axis cannot have or run
};

}  // namespace nplc::boards
