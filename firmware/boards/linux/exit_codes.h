#pragma once

namespace nplc::boards {

enum ExitCode : int {
    kDone = 0,
    kWrong = 2,     ///< the command line or the configuration
    kNoDevice = 3,  ///< a device, a port or the store could not be had
};

}  // namespace nplc::boards
