#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include "cli/input.h"
#include "cli/subcommands.h"
#include "host/paths.h"
#include "host/process.h"
#include "views/graph.h"

namespace nplc::seqc::cli {
namespace {

std::string first_line(const std::string& text) {
    return text.substr(0, text.find_first_of("\r\n"));
}

struct Rendering {
    std::string bytes;
    std::string error;  ///< why there are none, in one line
};

/// What Graphviz' `dot -Tformat` makes of `text`. No shell is involved; nothing is left behind.
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

constexpr std::array kFormats{"svg", "dot", "pdf", "png"};

struct GraphArguments {
    InputFile table;
    std::string output;
    std::string format;
};

bool is_format(const std::string& name) {
    return std::find(kFormats.begin(), kFormats.end(), name) != kFormats.end();
}

/// Said with --format, or by the output's name; "" if that says nothing known.
std::string format_of(const GraphArguments& options) {
    if (!options.format.empty()) return options.format;
    if (options.output.empty() || options.output == "-") return "svg";
    const std::string extension = host::name_of(host::path_of(options.output).extension());
    return !extension.empty() && is_format(extension.substr(1)) ? extension.substr(1) : "";
}

int graph(const GraphArguments& options) {
    const std::string format = format_of(options);
    if (format.empty()) {
        return file_problem(
            fmt::format("'{}' does not say what to draw: name it .svg, .dot, .pdf or .png, or give "
                        "--format",
                        options.output));
    }
    const Input input = read_for_view(options.table);
    if (input.exit_code != kOk) return input.exit_code;
    if (!options.output.empty() && is_same_file(options.output, options.table.file))
        return file_problem(fmt::format("'{}' is the file to draw: name another output", options.output));
    const GraphSource source{input.program ? &input.program->written : nullptr,
                             input.sources ? input.sources->text() : std::string_view()};
    const std::string text = graph_of(input.table, names_of(input),
                                      host::name_of(host::path_of(options.table.file).stem()), source);
    if (format == "dot") return print_or_write(text, options.output);
    const Rendering rendering = render_dot(text, format);
    return rendering.error.empty() ? print_or_write(rendering.bytes, options.output)
                                   : file_problem(rendering.error);
}

}  // namespace

void add_graph(arguments::App& app, int& exit_code) {
    const auto options = std::make_shared<GraphArguments>();
    arguments::App& command = *app.add_subcommand("graph", "Draw a program or table, with Graphviz");
    command.add_option("file", options->table.file, "A program, F.seq, or a table")->required();
    add_symbols_option(command, options->table);
    command.add_option("-o,--output", options->output,
                       "F.svg, F.dot, F.pdf or F.png (default: SVG to standard output)");
    command.add_option("--format", options->format, "svg, dot, pdf or png, whatever the output is called")
        ->one_of(std::vector<std::string>(kFormats.begin(), kFormats.end()));
    command.callback([options, &exit_code] { exit_code = graph(*options); });
}

}  // namespace nplc::seqc::cli
