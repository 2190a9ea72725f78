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

}  // namespace

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
