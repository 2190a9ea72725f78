#include "cli/dot_process.h"

#include <fmt/format.h>

#include "host/process.h"

namespace nplc::seqc::cli {
namespace {

std::string first_line(const std::string& text) {
    return text.substr(0, text.find_first_of("\r\n"));
}

}  // namespace

Rendering render_dot(const std::string& text, const std::string& format) {
    host::Ran ran = host::run_program("dot", {"-T" + format}, text);
    if (ran.missing) {
        return {{},
                "Graphviz' program 'dot' is missing: install it (on Debian: apt-get install graphviz), or "
                "take --format "
                "dot, which needs no Graphviz"};
    }
    if (!ran.problem.empty()) return {{}, ran.problem};
    if (!ran.done) return {{}, fmt::format("'dot' failed: {}", first_line(ran.errors))};
    return {std::move(ran.output), {}};
}

}  // namespace nplc::seqc::cli
