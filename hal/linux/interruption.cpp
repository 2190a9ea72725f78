#include "host/interruption.h"

#include <csignal>
#include <initializer_list>

namespace nplc::host {
namespace {

volatile std::sig_atomic_t g_interrupted = 0;

void on_signal(int signal) {
    g_interrupted = 1;
    std::signal(signal, SIG_DFL);
}

void on_held_signal(int /*signal*/) {
    g_interrupted = 1;
}

/// Under nohup the signal is ignored, which is kept.
void hold_hang_up() {
    if (std::signal(SIGHUP, on_held_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

}  // namespace

void hold_interruptions() {
    for (const int signal : {SIGINT, SIGTERM, SIGQUIT}) std::signal(signal, on_held_signal);
    hold_hang_up();
    std::signal(SIGPIPE, SIG_IGN);
}

void note_interruptions() {
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, on_signal);
    std::signal(SIGPIPE, SIG_IGN);
}

void end_at_interruptions() {
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
}

bool was_interrupted() {
    return g_interrupted != 0;
}

}  // namespace nplc::host
