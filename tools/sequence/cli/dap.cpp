#include <iostream>

#include "cli/subcommands.h"
#include "dap/run.h"

namespace nplc::seqc::cli {

void add_dap(arguments::App& app, int& exit_code) {
    arguments::App& command =
        *app.add_subcommand("dap", "Debug adapter for editors, on standard input and output");
    command.footer(
        "Speaks the Debug Adapter Protocol: launch rehearses a program with a scenario in virtual time, "
        "attach debugs a\n"
        "gateway, which stops its motor before it holds. Their arguments: tools/sequence/dap/README.md.\n"
        "Exit codes: 0 after disconnect, 1 if the editor left without it.");
    command.callback([&exit_code] {
        std::ios::sync_with_stdio(false);
        std::cin.tie(nullptr);  // reading and writing are in different threads
        exit_code = dap::run_adapter(std::cin, std::cout);
    });
}

}  // namespace nplc::seqc::cli
