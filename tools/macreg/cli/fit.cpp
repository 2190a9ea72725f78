#include "macreg/fit.h"

#include <fmt/format.h>

#include <cmath>

#include "cli/session.h"
#include "macreg/axis_file.h"
#include "macreg/plot.h"
#include "macreg/prediction.h"
#include "macreg/values.h"
#include "whole_files/whole_files.h"

namespace nplc::macreg::cli {
namespace {

using registers::Model;

struct FitArguments {
    std::vector<std::string> recordings;
    std::vector<std::string> against;
    std::vector<std::string> move;
    std::string output;
    std::string picture;
    std::string response;
    double inertia = 0;
};

struct Material {
    std::vector<Series> all{};
    Model model = Model::mac140;
    std::string motor{};
};

void take(Material& to, const std::string& path, const Common& common) {
    const std::string name = name_of_input(path);
    SeriesReading series = series_of(read_recording(path), name, model_option(common));
    if (!series.error.empty()) throw UserError(series.error);
    if (!to.all.empty() && to.motor != series.motor)
        throw UserError(fmt::format("{}: is of a {}, and {} of a {}; name recordings of one axis", name,
                                    series.motor, to.all.front().name, to.motor));
    to.model = series.model;
    to.motor = series.motor;
    to.all.push_back(std::move(series.series));
}

void draw(const std::string& file, const Recording& recording, const std::string& title) {
    const bool png = file.ends_with(".png");
    const Plotted plotted = plot(recording, {.title = title});
    if (!plotted.error.empty()) throw UserError(fmt::format("{}: {}", file, plotted.error));
    const std::string content = png ? to_png(plotted.picture) : to_svg(plotted.picture);
    if (const std::string problem = whole_files::write_files({{file, content}}); !problem.empty())
        throw UserError(problem);
}

/// V_SOLL, A_SOLL and T_SOLL of --check-move, in their steps.
struct Wanted {
    double v_soll = -1;
    double a_soll = -1;
    double t_soll = 1023;
};

Wanted wanted_move(const FitArguments& options, Model model) {
    Wanted wanted;
    const ReadAssignments read = read_assignments(model, options.move);
    if (!read.error.empty()) throw UserError("--check-move: " + read.error);
    for (const Assignment& one : read.all) {
        const auto raw = static_cast<double>(one.raw);
        if (one.reg->number == registers::V_SOLL)
            wanted.v_soll = std::abs(raw);
        else if (one.reg->number == registers::A_SOLL)
            wanted.a_soll = raw;
        else if (one.reg->number == registers::T_SOLL)
            wanted.t_soll = std::max(raw, 1.0);
        else
            throw UserError(
                fmt::format("--check-move {}: a move is made of V_SOLL, A_SOLL and T_SOLL", one.reg->name));
    }
    if (wanted.v_soll < 0 || wanted.a_soll < 0)
        throw UserError(
            "--check-move: write V_SOLL and A_SOLL, and T_SOLL if it is not all, such as "
            "V_SOLL=1500rpm,A_SOLL=20000rpm/s");
    return wanted;
}

std::string line_of(const Shown& one) {
    if (!one.told) return fmt::format("  {:<17} not told: {}\n", one.key, one.why);
    return fmt::format("  {:<17} {:.4g}{}{}, {:.4g} to {:.4g}\n", one.key, one.value,
                       one.unit.empty() ? "" : " ", one.unit, one.low, one.high);
}

Json document_of(const Shown& one) {
    Json document{{"name", one.key}, {"unit", one.unit}, {"told", one.told}};
    if (one.told) {
        document["value"] = one.value;
        document["low"] = one.low;
        document["high"] = one.high;
    } else {
        document["why"] = one.why;
    }
    return document;
}

std::string words_of(const Response& response) {
    return fmt::format("{}, {:.0f} counts beyond the target, {:.0f} % of the torque",
                       response.settled_s > 0
                           ? fmt::format("at rest after {:.0f} ms", 1000 * response.settled_s)
                           : "does not come to rest",
                       response.overshoot, response.peak_torque / 10.23);
}

Json document_of(const Response& response) {
    return {{"kvout", response.kvout},
            {"gain", response.gain},
            {"settled_s", response.settled_s},
            {"overshoot_counts", response.overshoot},
            {"peak_torque", response.peak_torque}};
}

/// Builds what `fit` prints and its JSON document.
struct Report {
    std::string text{};
    Json document = Json::object();
};

void add_values(Report& report, const Material& material, const Fit& found, const FoundPlant& plant) {
    std::size_t samples = 0;
    for (const Series& series : material.all) samples += series.size();
    report.text += fmt::format("{}, {}, {} samples: the fitted shaft explains {:.3f} % of the velocity\n",
                               material.motor, counted(material.all.size(), "recording"), samples,
                               100 * found.r2_velocity);
    report.document["motor"] = material.motor;
    report.document["samples"] = samples;
    report.document["r2_velocity"] = found.r2_velocity;
    report.document["noise_counts"] = found.noise;
    for (const Shown& one : shown(found, plant)) {
        report.text += line_of(one);
        report.document["plant"].push_back(document_of(one));
    }
    if (found.r2_velocity < 0.95)
        report.text +=
            "  this is little: something moves that is not in it (a stop, a spring, a slipping coupling, a "
            "supply that is too weak)\n";
}

void add_others(Report& report, const FitArguments& options, const Common& common, const Material& material,
                const Fit& found) {
    for (const std::string& path : options.against) {
        Material other;
        other.motor = material.motor;
        take(other, path, common);
        const double r2 = r2_of(found, other.all.front());
        report.text +=
            fmt::format("{}, which was not fitted: {:.3f} % of the velocity is foretold\n", path, 100 * r2);
        report.document["against"].push_back({{"file", path}, {"r2_velocity", r2}});
    }
}

void add_tuning(Report& report, const FitArguments& options, const Material& material,
                const FoundPlant& plant) {
    if (!plant.plant.inertia) {
        report.text += "KVOUT: without an inertia there is nothing to recommend\n";
        if (!options.response.empty()) throw UserError("--response: without an inertia nothing is foretold");
        return;
    }
    const Tuning tuning = tuning_for(plant.plant, material.model);
    const char* gain = material.model == Model::mac800 ? "KVFX6" : "KVFX4";
    report.text += fmt::format(
        "recommended (001 §3.2.13): KVOUT {:.2f}, {}\n  a turn with A_SOLL {:.0f}: {}\n  with KVOUT 1: {}\n",
        tuning.then.kvout,
        tuning.then.gain == tuning.now.gain
            ? std::string("filters as from the box")
            : fmt::format("{} raw:{} in place of raw:{}", gain, tuning.then.gain, tuning.now.gain),
        tuning.a_soll, words_of(tuning.then), words_of(tuning.now));
    if (!tuning.remark.empty()) report.text += "  " + tuning.remark + "\n";
    report.document["recommended"] = {{"KVOUT", tuning.then.kvout},
                                      {gain, tuning.then.gain},
                                      {"foretold", document_of(tuning.then)},
                                      {"foretold_with_kvout_1", document_of(tuning.now)},
                                      {"remark", tuning.remark}};
    if (options.response.empty()) return;
    Recording recording;
    recording.rate_hz = registers::scale_of(material.model).samples_per_second;
    recording.time_s = tuning.then.time_s;
    recording.columns = {{"KVOUT 1", "counts", tuning.now.position},
                         {"as recommended", "counts", tuning.then.position},
                         {"torque, KVOUT 1", "of 1023", tuning.now.torque},
                         {"torque, as recommended", "of 1023", tuning.then.torque}};
    draw(options.response, recording, "Foretold: a turn in P_MODE");
}

void add_need(Report& report, const FitArguments& options, const Material& material, const Fit& found,
              Common& common) {
    if (options.move.empty()) return;
    const Wanted wanted = wanted_move(options, material.model);
    const MoveNeed need = need_of(found, wanted.v_soll, wanted.a_soll, wanted.t_soll);
    if (!found[Parameter::inertia].told)
        throw UserError("--check-move: the recordings do not tell the inertia; " +
                        found[Parameter::inertia].why);
    const double percent = 100 * need.excess();
    report.text += percent > 0
                       ? fmt::format("this move needs {:.0f} % more torque than the motor has", percent)
                       : fmt::format("this move leaves {:.0f} % of the torque", -percent);
    report.text += fmt::format(" ({:.0f} of {:.0f}){}\n", need.torque, need.limit,
                               need.without.empty() ? "" : ", without " + need.without + ", not told");
    report.document["move"] = {{"torque", need.torque}, {"limit", need.limit}, {"excess_percent", percent}};
    if (percent > 0) common.exit_code = command_line::kRefused;
}

void check_pictures(const FitArguments& options) {
    for (const auto& [option, file] :
         {std::pair{"--picture", &options.picture}, {"--response", &options.response}}) {
        if (!file->empty() && !file->ends_with(".svg") && !file->ends_with(".png"))
            throw UserError(fmt::format("{} {}: the name must end with .svg or .png", option, *file));
    }
}

void fit_files(Common& common, const FitArguments& options) {
    check_pictures(options);
    const std::string file = options.output.empty() ? "" : output_file(options.output, true);
    Material material;
    for (const std::string& path : options.recordings) take(material, path, common);
    const Fit found = fit(material.all, material.model);
    if (!found.problem.empty()) throw UserError(found.problem);
    const std::optional<double> known = options.inertia > 0 ? std::optional(options.inertia) : std::nullopt;
    const FoundPlant plant = found_plant(found, material.model, material.motor, known);
    Report report;
    add_values(report, material, found, plant);
    add_others(report, options, common, material, found);
    add_tuning(report, options, material, plant);
    add_need(report, options, material, found, common);
    if (!options.picture.empty())
        draw(options.picture, comparison(found, material.all, material.model), "Measured and fitted");
    if (!options.output.empty()) {
        const std::string text = axis_file(found, plant, options.recordings);
        if (file.empty()) {
            report.text = text;
        } else {
            if (const std::string problem = whole_files::write_files({{file, text}}); !problem.empty())
                throw UserError(problem);
            report.text += fmt::format("{}: written\n", file);
            report.document["file"] = file;
        }
    }
    report.text.pop_back();
    command_line::tell(common, report.text, report.document);
}

}  // namespace

void add_fit(arguments::App& app, Common& common) {
    auto [command, options] = add_command(app, common, "fit",
                                          "Find inertia, friction, load and dead time of an axis from "
                                          "recordings of it, for the simulators' --plant",
                                          fit_files);
    command
        .add_option(
            "recordings", options.recordings,
            "CSV of `macreg record P_IST,VF_OUT`, moves there and back at two speeds; - is standard input")
        ->required();
    command.add_option("-o,--output", options.output,
                       "The plant's file, such as axis.toml; - is standard output");
    command.add_option("--picture", options.picture, "Measured and fitted, as F.svg or F.png");
    command.add_option("--response", options.response, "The step response foretold, as F.svg or F.png");
    command
        .add_option("--against", options.against, "A recording that is not fitted: how well it is foretold")
        ->repeatable();
    command
        .add_option("--inertia", options.inertia,
                    "Of motor and load, kg m2, if it is known: tells the torque constant")
        ->in_range(1e-7, 1.0);
    command
        .add_option("--check-move", options.move,
                    "Whether the motor has the torque for V_SOLL=1500rpm,A_SOLL=20000rpm/s,T_SOLL=80%; exit "
                    "code 1 if not")
        ->delimiter(',');
}

}  // namespace nplc::macreg::cli
