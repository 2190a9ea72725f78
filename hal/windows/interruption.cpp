#include "host/interruption.h"

#include <windows.h>

#include <atomic>

namespace nplc::host {
namespace {

std::atomic<bool> g_interrupted = false;

/// In a thread of Windows' own. Not taken the second time, which ends the program.
BOOL WINAPI on_event(DWORD /*event*/) {
    return g_interrupted.exchange(true) ? FALSE : TRUE;
}

}  // namespace

void note_interruptions() {
    [[maybe_unused]] static const BOOL noted = ::SetConsoleCtrlHandler(on_event, TRUE);
}

bool was_interrupted() {
    return g_interrupted;
}

}  // namespace nplc::host
