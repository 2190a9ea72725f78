#include "cli/subcommands.h"

namespace nplc::seqc::cli {

void add_subcommands(arguments::App& app, int& exit_code) {
    add_build(app, exit_code);
    add_check(app, exit_code);
    add_dap(app, exit_code);
    add_decompile(app, exit_code);
    add_diff(app, exit_code);
    add_disasm(app, exit_code);
    add_explain(app, exit_code);
    add_fmt(app, exit_code);
    add_graph(app, exit_code);
    add_lsp(app, exit_code);
    add_report(app, exit_code);
    add_verify(app, exit_code);
}

}  // namespace nplc::seqc::cli
