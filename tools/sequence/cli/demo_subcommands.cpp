#include "cli/subcommands.h"

namespace nplc::seqc::cli {

void add_subcommands(arguments::App& app, int& exit_code) {
    add_build(app, exit_code);
    add_check(app, exit_code);
    app.footer(
        "This is the seqc that tools/demo builds. `cmake --preset release` and `cmake --build --preset "
        "release` build "
        "the one with all commands.");
}

}  // namespace nplc::seqc::cli
