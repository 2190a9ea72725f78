#pragma once

namespace nplc::boards {

enum ExitCode : int {
    kDone = 0,
    kWrong = 2,     ///< the command line or the configuration
    kNoDevice = 3,  ///< the watchdog is not available; check-config: a resource of an axis is missing or its
                    ///< table cannot run; note-end: a service runs
};

}  // namespace nplc::boards
