#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/input.h"
#include "cli/subcommands.h"
#include "host/paths.h"
#include "host/process.h"
#include "report/graph/graph.h"
#include "report/graph/graph_json.h"
#include "report/graph/graph_layout.h"
#include "report/graph/graph_print.h"
#include "report/graph/graph_svg.h"

namespace nplc::seqc::cli {
namespace {

std::string first_line(const std::string& text) {
    return text.substr(0, text.find_first_of("\r\n"));
}

struct Rendering {
    std::string bytes;
    std::string error;  ///< one-line error
};

/// Runs Graphviz on `text`. Uses no shell and leaves no files.
Rendering render_dot(const std::string& text, const std::string& format) {
    host::Ran ran = host::run_program("dot", {"-Kneato", "-n2", "-Gdpi=200", "-T" + format}, text);
    if (ran.missing) {
        return {{},
                "Graphviz' program 'dot' is missing: install it (on Debian: apt-get install graphviz), or "
                "take --format svg, which needs no Graphviz"};
    }
    if (!ran.problem.empty()) return {{}, ran.problem};
    if (!ran.done) return {{}, fmt::format("'dot' failed: {}", first_line(ran.errors))};
    return {std::move(ran.output), {}};
}

constexpr std::array kFormats{"svg", "png", "pdf", "json", "dot"};

struct GraphArguments {
    InputFile table;
    std::string output;
    std::string format;
};

bool is_format(const std::string& name) {
    return std::find(kFormats.begin(), kFormats.end(), name) != kFormats.end();
}

/// Format by --format or the output's extension; "" if unknown.
std::string format_of(const GraphArguments& options) {
    if (!options.format.empty()) return options.format;
    if (options.output.empty() || options.output == "-") return "svg";
    const std::string extension = host::name_of(host::path_of(options.output).extension());
    return !extension.empty() && is_format(extension.substr(1)) ? extension.substr(1) : "";
}

std::string json_text(const GraphModel& model, const Picture& picture) {
    return graph_json_of(model, picture)
               .dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) +
           "\n";
}

int graph(const GraphArguments& options) {
    const std::string format = format_of(options);
    if (format.empty()) {
        return file_problem(
            fmt::format("'{}' does not say what to draw: name it .svg, .png, .pdf, .json or .dot, or give "
                        "--format",
                        options.output));
    }
    const Input input = read_for_view(options.table);
    if (input.exit_code != kOk) return input.exit_code;
    if (!options.output.empty() && is_same_file(options.output, options.table.file))
        return file_problem(fmt::format("'{}' is the file to draw: name another output", options.output));
    const GraphSource source{input.program ? &input.program->written : nullptr,
                             input.sources ? input.sources->text() : std::string_view()};
    const std::string title = host::name_of(host::path_of(options.table.file).stem());
    if (format == "dot")
        return print_or_write(graph_of(input.table, names_of(input), title, source), options.output);
    const GraphModel model = graph_model_of(input.table, names_of(input), title, source);
    const Picture picture = picture_of(model);
    if (format == "svg") return print_or_write(svg_of(picture, model.title), options.output);
    if (format == "json") return print_or_write(json_text(model, picture), options.output);
    const Rendering rendering = render_dot(print_of(picture), format);
    return rendering.error.empty() ? print_or_write(rendering.bytes, options.output)
                                   : file_problem(rendering.error);
}

}  // namespace

void add_graph(arguments::App& app, int& exit_code) {
    const auto options = std::make_shared<GraphArguments>();
    arguments::App& command = *app.add_subcommand("graph", "Draw a program or table for an A4 page");
    command.add_option("file", options->table.file, "A program, F.seq, or a table")->required();
    add_symbols_option(command, options->table);
    command.add_option("-o,--output", options->output,
                       "F.svg, F.png, F.pdf, F.json or F.dot (default: SVG to standard output)");
    command
        .add_option("--format", options->format, "svg, png, pdf, json or dot, whatever the output is called")
        ->one_of(std::vector<std::string>(kFormats.begin(), kFormats.end()));
    command.callback([options, &exit_code] { exit_code = graph(*options); });
}

}  // namespace nplc::seqc::cli
