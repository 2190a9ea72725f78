#include "host/interruption.h"

#include <windows.h>

#include <atomic>

namespace nplc::host {
namespace {

std::atomic<bool> g_interrupted = false;
std::atomic<bool> g_noted = false;
std::atomic<bool> g_held = false;

constexpr DWORD kWindowsPatienceMs = 5'000;

/// Called in a thread of Windows. The second event is not handled and ends the program. When the console is
/// closed, Windows ends the program on return from here: until then it can restore line and motor.
BOOL WINAPI on_event(DWORD event) {
    if (g_interrupted.exchange(true) && !g_held) return FALSE;
    if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) ::Sleep(kWindowsPatienceMs);
    return TRUE;
}

}  // namespace

void note_interruptions() {
    if (!g_noted.exchange(true)) ::SetConsoleCtrlHandler(on_event, TRUE);
}

void hold_interruptions() {
    g_held = true;
    note_interruptions();
}

void end_at_interruptions() {
    if (g_noted.exchange(false)) ::SetConsoleCtrlHandler(on_event, FALSE);
}

bool was_interrupted() {
    return g_interrupted;
}

}  // namespace nplc::host
