#include "macreg/plot.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/files.h"
#include "cli/session.h"
#include "host/paths.h"
#include "whole_files/whole_files.h"

namespace nplc::macreg::cli {
namespace {

struct PlotArguments {
    std::string recording;
    std::string output;
    PlotOptions how;
};

bool ends_with(const std::string& text, std::string_view end) {
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string usual_title(const Recording& recording, const std::string& path) {
    std::string title = host::name_of(host::path_of(path).filename());
    if (recording.model.empty()) return title;
    title += fmt::format(": {}, address {}", recording.model, recording.address);
    if (recording.rate_hz > 0) title += fmt::format(", {:g} Hz", recording.rate_hz);
    return recording.start.empty() || recording.start == "now" ? title : title + ", " + recording.start;
}

void plot_file(const Common& common, const PlotArguments& options) {
    const bool png = ends_with(options.output, ".png");
    if (!png && !ends_with(options.output, ".svg"))
        throw UserError(fmt::format("-o {}: the name must end with .svg or .png", options.output));
    const whole_files::FileText file =
        options.recording == "-" ? whole_files::FileText{.text = read_standard_input(), .error = {}}
                                 : whole_files::read_file(options.recording, whole_files::kMostInput);
    if (!file.error.empty()) throw UserError(file.error);
    const RecordingReading reading =
        from_csv(file.text, options.recording == "-" ? "standard input" : options.recording);
    if (!reading.error.empty()) throw UserError(reading.error);
    PlotOptions how = options.how;
    if (how.title.empty()) how.title = usual_title(reading.recording, options.recording);
    const Plotted plotted = plot(reading.recording, how);
    if (!plotted.error.empty()) throw UserError(fmt::format("{}: {}", options.recording, plotted.error));
    const std::string problem =
        whole_files::write_files({{options.output, png ? to_png(plotted.picture) : to_svg(plotted.picture)}});
    if (!problem.empty()) throw UserError(problem);
    command_line::tell(common,
                       fmt::format("{}: {} samples, {} by {} pixels", options.output,
                                   reading.recording.size(), plotted.picture.width, plotted.picture.height),
                       {{"file", options.output},
                        {"samples", reading.recording.size()},
                        {"width", plotted.picture.width},
                        {"height", plotted.picture.height}});
}

}  // namespace

void add_plot(arguments::App& app, Common& common) {
    const auto options = std::make_shared<PlotArguments>();
    arguments::App& command = add_command(app, "plot", "Draw a recording as an SVG or PNG picture");
    command.add_option("recording", options->recording, "CSV of `macreg record`; - is standard input")
        ->required();
    command.add_option("-o,--output", options->output, "The picture: F.svg or F.png")->required();
    command.add_option("--columns", options->how.columns, "At most four of its columns; all if not said")
        ->delimiter(',');
    command.add_option("--width", options->how.width, "Pixels")->capture_default_str()->in_range(320, 8000);
    command.add_option("--height", options->how.height, "Pixels; 200 a panel and the rest if not said")
        ->in_range(240, 8000);
    command.add_option("--title", options->how.title, "Instead of file, model and rate");
    command.callback([options, &common] { guard(common, [&] { plot_file(common, *options); }); });
}

}  // namespace nplc::macreg::cli
