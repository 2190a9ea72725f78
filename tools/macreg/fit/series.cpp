#include "macreg/series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "registers/scale.h"

namespace nplc::macreg {
namespace {

using registers::Register;

constexpr std::string_view kAnySmall = "MAC50-141";
constexpr const char* kHow = "record again: macreg record P_IST,VF_OUT -o move.csv --move P_SOLL=+20480";
constexpr double kWhole = 0.02;  // largest distance from a raw step of a value that was converted from one
constexpr double kWholeCount = 4294967296.0;  // P_IST wraps around

/// The error, one line.
struct Unfit {
    std::string why;
};

[[noreturn]] void refuse(const std::string& why) {
    throw Unfit{why};
}

registers::Model model_in(const Recording& recording, std::optional<registers::Model> model) {
    const bool small = recording.model == kAnySmall;
    const auto said = small ? registers::Model::mac140 : registers::model_of(recording.model);
    if (!said && !model) refuse("it does not say of which motor it is; add --model, such as --model MAC140");
    if (said && model && (*said != *model && !(small && *model != registers::Model::mac800)))
        refuse(fmt::format("it is of a {} and not of a {}; leave --model out", recording.model,
                           registers::name_of(*model)));
    return model.value_or(said.value_or(registers::Model::mac140));
}

void check_rate(const Recording& recording, registers::Model model) {
    const double wanted = registers::scale_of(model).samples_per_second;
    if (recording.rate_hz <= 0)
        refuse(fmt::format("it was polled, so its times are not those of the motor's samples; {}", kHow));
    if (recording.rate_hz > 2 * wanted)
        refuse(fmt::format("it has {:g} samples a second, the current loop's; record without --rate fast",
                           recording.rate_hz));
    if (std::abs(recording.rate_hz - wanted) > 0.01 * wanted)
        refuse(fmt::format(
            "it has {:g} samples a second and a {} makes {:.2f}; was it recorded of another motor?",
            recording.rate_hz, registers::name_of(model), wanted));
    const double seconds = recording.time_s.back() - recording.time_s.front();
    const double expected = static_cast<double>(recording.size() - 1) / wanted;
    if (std::abs(seconds - expected) > 0.02 * expected)
        refuse(fmt::format("its times span {:.4f} s and its samples {:.4f} s; rows are missing, {}", seconds,
                           expected, kHow));
}

std::optional<std::vector<double>> raw_of(const Recording& recording, registers::Model model,
                                          std::string_view name) {
    const auto column = std::find_if(recording.columns.begin(), recording.columns.end(),
                                     [&](const Recording::Column& one) { return one.name == name; });
    if (column == recording.columns.end()) return std::nullopt;
    const Register* reg = registers::find(model, name);
    const auto ratio = registers::raw_per_unit(*reg, model, column->unit);
    if (!ratio)
        refuse(fmt::format("{} is in [{}], which is no unit of it; mend the header, or {}", name,
                           column->unit, kHow));
    const double factor = static_cast<double>(ratio->numerator) / static_cast<double>(ratio->denominator);
    std::vector<double> raw;
    double worst = 0;
    for (const double value : column->values) {
        raw.push_back(std::round(value * factor));
        worst = std::max(worst, std::abs(value * factor - raw.back()));
        if (raw.back() < static_cast<double>(reg->min) || raw.back() > static_cast<double>(reg->max))
            refuse(fmt::format(
                "{} = {} {} in sample {} is beyond what a {} can show; is the unit in the header right?",
                name, value, column->unit, raw.size(), registers::name_of(model)));
    }
    if (worst > kWhole + 1e-3 * factor)
        refuse(fmt::format(
            "values of {} lie between the motor's steps; the unit [{}] is wrong, or another program "
            "has smoothed it",
            name, column->unit));
    return raw;
}

bool is_constant(const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [&](double value) { return value == values.front(); });
}

std::vector<double> unwrapped(const std::vector<double>& positions) {
    std::vector<double> counts{0};
    for (std::size_t i = 1; i < positions.size(); ++i) {
        const double step = positions[i] - positions[i - 1];
        counts.push_back(counts.back() + step - kWholeCount * std::round(step / kWholeCount));
    }
    return counts;
}

std::vector<double> summed(const std::vector<double>& velocities) {
    std::vector<double> counts{0};
    for (std::size_t i = 1; i < velocities.size(); ++i) counts.push_back(counts.back() + velocities[i]);
    return counts;
}

/// Samples around which it stays within two counts for as long as no relevant motion takes.
std::vector<char> rests_in(const std::vector<double>& counts) {
    constexpr std::size_t kAround = 5;
    constexpr double kStill = 2;
    std::vector<char> rests(counts.size(), 0);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const auto from = counts.begin() + static_cast<std::ptrdiff_t>(i - std::min(i, kAround));
        const auto to =
            counts.begin() + static_cast<std::ptrdiff_t>(std::min(i + kAround + 1, counts.size()));
        const auto [low, high] = std::minmax_element(from, to);
        rests[i] = *high - *low <= kStill ? 1 : 0;
    }
    return rests;
}

void add_field(Series& series, registers::Model model) {
    const double field = model == registers::Model::mac800 ? 2000 : 2048;  // counts in one turn of the field
    for (std::size_t i = 0; i < series.size(); ++i) {
        const double middle = (series.counts[i] + series.counts[i - std::min<std::size_t>(i, 1)]) / 2;
        series.sine.push_back(std::sin(2 * std::numbers::pi * middle / field));
        series.cosine.push_back(std::cos(2 * std::numbers::pi * middle / field));
    }
}

/// Both are of the same shaft.
void check_both(const std::vector<double>& positions, const std::vector<double>& velocities) {
    for (std::size_t i = 1; i < positions.size(); ++i) {
        if (std::abs(positions[i] - positions[i - 1] - velocities[i]) <= 4) continue;
        refuse(fmt::format(
            "P_IST goes on by {} counts in sample {} where V_IST says {}; P_IST was written meanwhile, "
            "or a unit is wrong; {}",
            positions[i] - positions[i - 1], i + 1, velocities[i], kHow));
    }
}

Series taken(const Recording& recording, registers::Model model) {
    auto torque = raw_of(recording, model, "VF_OUT");
    const auto position = raw_of(recording, model, "P_IST");
    const auto velocity = raw_of(recording, model, "V_IST");
    if (!torque) refuse(fmt::format("it has no VF_OUT, the torque; {}", kHow));
    if (!position && !velocity) refuse(fmt::format("it has neither P_IST nor V_IST; {}", kHow));
    Series series{.torque = std::move(*torque)};
    series.counts = position ? unwrapped(*position) : summed(*velocity);
    add_field(series, model);
    series.at_rest = rests_in(series.counts);
    if (position && velocity) check_both(series.counts, *velocity);
    if (is_constant(series.torque))
        refuse(
            fmt::format("VF_OUT is {:g} of 1023 in all samples, which tells nothing; was the motor passive? "
                        "Set a mode, then {}",
                        series.torque.front(), kHow));
    const auto [low, high] = std::minmax_element(series.counts.begin(), series.counts.end());
    if (*high - *low < 16)
        refuse(fmt::format("the shaft turned by {:g} counts only; {}", *high - *low, kHow));
    return series;
}

}  // namespace

SeriesReading series_of(const Recording& recording, const std::string& name,
                        std::optional<registers::Model> model) {
    SeriesReading result;
    try {
        if (!recording.incomplete.empty())
            refuse(fmt::format("it is incomplete ({}); {}", recording.incomplete, kHow));
        result.model = model_in(recording, model);
        result.motor = model ? std::string(registers::name_of(*model)) : recording.model;
        if (recording.size() < kFewestSamples)
            refuse(fmt::format("{} samples are too few, {} are the least; {}", recording.size(),
                               kFewestSamples, kHow));
        check_rate(recording, result.model);
        result.series = taken(recording, result.model);
        result.series.name = name;
    } catch (const Unfit& unfit) {
        result.error = fmt::format("{}: {}", name, unfit.why);
    }
    return result;
}

}  // namespace nplc::macreg
