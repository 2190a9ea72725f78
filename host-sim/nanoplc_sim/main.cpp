#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <exception>

#include "command_line.h"
#include "host/printable.h"
#include "input_file.h"
#include "run_command.h"
#include "scan_command.h"

namespace {

constexpr int kBadInput = 2;

volatile std::sig_atomic_t g_interrupted = 0;

void on_signal(int signal) {
    g_interrupted = signal;
}

int run_command_line(int argc, const char* const* argv) {
    using namespace nplc::sim;
    const CommandLine command = parse_command_line(argc, argv);
    if (const auto* scan = std::get_if<ScanOptions>(&command)) {
        run_scan(scan->table, scan->stimulus);
        return 0;
    }
    if (const auto* fmu = std::get_if<FmuCommand>(&command)) {
        write_fmu(*fmu);
        return 0;
    }
    if (const auto* page = std::get_if<Page>(&command)) {
        fmt::print("{}", page->text);
        return 0;
    }
    const auto* options = std::get_if<RunOptions>(&command);
    if (options == nullptr) return 0;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) std::signal(signal, on_signal);
    return run(*options, g_interrupted);
}

}  // namespace

int main(int argc, char** argv) {
    int code = kBadInput;
    try {
        code = run_command_line(argc, argv);
    } catch (const std::exception& error) {
        std::fflush(stdout);
        nplc::host::complain(error.what());
        return kBadInput;
    }
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        nplc::host::complain("standard output: cannot be written; the output is not complete");
        return kBadInput;
    }
    return code;
}
