#include <iostream>
#include <memory>

#include "cli/subcommands.h"
#include "lsp/run.h"

namespace nplc::seqc::cli {

void add_lsp(arguments::App& app, int& exit_code) {
    arguments::App& command =
        *app.add_subcommand("lsp", "Language server for editors, on standard input and output");
    const auto stdio = std::make_shared<bool>(false);
    command.add_flag("--stdio", *stdio, "Standard input and output, as it does anyway; some editors say so");
    command.footer(
        "Speaks LSP 3.17. What it offers, and how to set up VS Code and Neovim: "
        "tools/sequence/lsp/README.md.\n"
        "Exit codes: 0 after shutdown and exit, 1 if the editor left without them.");
    command.callback([stdio, &exit_code] {
        std::ios::sync_with_stdio(false);
        std::cin.tie(nullptr);  // reading and writing are in different threads
        exit_code = lsp::run_server(std::cin, std::cout);
    });
}

}  // namespace nplc::seqc::cli
