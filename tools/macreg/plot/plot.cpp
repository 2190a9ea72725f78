#include "macreg/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace nplc::macreg {
namespace {

using Anchor = Picture::Words::Anchor;
using Column = Recording::Column;

constexpr double kLeft = 84;
constexpr double kRight = 24;
constexpr double kTop = 48;
constexpr double kBottom = 48;
constexpr double kGap = 34;  // between panels, for the upper one's legend
constexpr double kPanel = 200;
constexpr double kPixelsATick = 32;
constexpr double kPixelsATime = 90;
constexpr Colour kInk = 0x333333;
constexpr Colour kFaint = 0xE3E3E3;
constexpr Colour kAxis = 0x888888;
// Distinguishable for colour-blind users, and dark enough on white.
constexpr std::array<Colour, kMostCurves> kColours{0x0072B2, 0xD55E00, 0x009E73, 0xAA4499};

struct Panel {
    std::string unit;
    std::vector<std::size_t> columns;
};

struct Box {
    double left, top, right, bottom;
    double low_x, high_x, low_y, high_y;
    double x(double value) const { return left + (value - low_x) / (high_x - low_x) * (right - left); }
    double y(double value) const { return bottom - (value - low_y) / (high_y - low_y) * (bottom - top); }
};

std::string number_words(double value, int decimals) {
    const std::string text = fmt::format("{:.{}f}", value, decimals);
    return text.find_first_not_of("-0.") == std::string::npos && text.front() == '-' ? text.substr(1) : text;
}

class Plotter {
  public:
    Plotter(const Recording& recording, const std::vector<std::size_t>& columns, const PlotOptions& options)
        : recording_(recording), columns_(columns), options_(options) {
        for (const std::size_t column : columns)
            panel_of(recording.columns[column].unit).columns.push_back(column);
        const double panels = static_cast<double>(panels_.size());
        out_.width = options.width;
        out_.height = options.height > 0
                          ? options.height
                          : static_cast<int>(kTop + kBottom + panels * kPanel + (panels - 1) * kGap);
        panel_height_ = (out_.height - kTop - kBottom - (panels - 1) * kGap) / panels;
        low_ = recording.time_s.front();
        high_ = std::max(recording.time_s.back(), low_ + 1e-6);
        in_ms_ = high_ - low_ < 1;
    }

    Picture draw() {
        double top = kTop;
        for (const Panel& panel : panels_) {
            draw_panel(panel, top);
            top += panel_height_ + kGap;
        }
        words({kLeft, 16}, title(), Anchor::start, kInk, 13);
        words({(kLeft + right()) / 2, out_.height - 10.0}, in_ms_ ? "time [ms]" : "time [s]", Anchor::middle,
              kInk);
        return std::move(out_);
    }

  private:
    Panel& panel_of(const std::string& unit) {
        const auto found = std::find_if(panels_.begin(), panels_.end(),
                                        [&](const Panel& panel) { return panel.unit == unit; });
        return found != panels_.end() ? *found : panels_.emplace_back(Panel{unit, {}});
    }

    double right() const { return out_.width - kRight; }

    std::string title() const {
        std::string text = options_.title;
        if (!recording_.incomplete.empty()) text += " (incomplete: " + recording_.incomplete + ")";
        return text;
    }

    Colour colour_of(std::size_t column) const {
        const auto at = std::find(columns_.begin(), columns_.end(), column) - columns_.begin();
        return kColours[static_cast<std::size_t>(at)];
    }

    Box box_of(const Panel& panel, double top) const {
        double low = recording_.columns[panel.columns.front()].values.front();
        double high = low;
        for (const std::size_t column : panel.columns) {
            const auto [least, most] = std::minmax_element(recording_.columns[column].values.begin(),
                                                           recording_.columns[column].values.end());
            low = std::min(low, *least);
            high = std::max(high, *most);
        }
        const double room = high > low ? (high - low) * 0.06 : std::max(std::abs(high) * 0.1, 1.0);
        const double scale = in_ms_ ? 1e3 : 1;
        return {kLeft,        top,           right(),    top + panel_height_,
                low_ * scale, high_ * scale, low - room, high + room};
    }

    void draw_panel(const Panel& panel, double top) {
        const Box box = box_of(panel, top);
        const int most = std::max(2, static_cast<int>(panel_height_ / kPixelsATick));
        const Ticks ticks = nice_ticks(box.low_y, box.high_y, most);
        for (int i = 0; i < ticks.count; ++i) {
            const double y = box.y(ticks.at(i));
            line({{box.left, y}, {box.right, y}}, kFaint);
            words({box.left - 8, y + 4}, number_words(ticks.at(i), ticks.decimals), Anchor::end, kInk, 11);
        }
        draw_times(box, &panel == &panels_.back());
        line({{box.left, box.top}, {box.left, box.bottom}, {box.right, box.bottom}}, kAxis);
        draw_legend(panel, box);
        for (const std::size_t column : panel.columns)
            line(curve(recording_.columns[column], box), colour_of(column), 1.6);
    }

    void draw_times(const Box& box, bool with_numbers) {
        const Ticks ticks = nice_ticks(box.low_x, box.high_x,
                                       std::max(2, static_cast<int>((box.right - box.left) / kPixelsATime)));
        for (int i = 0; i < ticks.count; ++i) {
            const double x = box.x(ticks.at(i));
            line({{x, box.top}, {x, box.bottom}}, kFaint);
            if (with_numbers)
                words({x, box.bottom + 17}, number_words(ticks.at(i), ticks.decimals), Anchor::middle, kInk,
                      11);
        }
    }

    void draw_legend(const Panel& panel, const Box& box) {
        words({kLeft - 8, box.top - 8}, panel.unit.empty() ? "value" : "[" + panel.unit + "]", Anchor::end,
              kInk, 11);
        double x = kLeft + 4;
        for (const std::size_t column : panel.columns) {
            const std::string& name = recording_.columns[column].name;
            line({{x, box.top - 12}, {x + 18, box.top - 12}}, colour_of(column), 3);
            words({x + 24, box.top - 8}, name, Anchor::start, kInk);
            x += 48 + 8.0 * static_cast<double>(name.size());
        }
    }

    /// With more samples than pixels: the first, minimum, maximum and last of each pixel.
    std::vector<Point> curve(const Column& column, const Box& box) const {
        const double scale = in_ms_ ? 1e3 : 1;
        const auto point = [&](std::size_t i) {
            return Point{box.x(recording_.time_s[i] * scale), box.y(column.values[i])};
        };
        std::vector<Point> points;
        const std::size_t size = recording_.size();
        for (std::size_t i = 0; i < size;) {
            std::size_t end = i + 1;
            const double pixel = std::floor(point(i).x);
            while (end < size && std::floor(point(end).x) == pixel) ++end;
            if (end - i <= 4) {
                for (; i < end; ++i) points.push_back(point(i));
                continue;
            }
            const auto begin = column.values.begin();
            const auto [least, most] = std::minmax_element(begin + static_cast<std::ptrdiff_t>(i),
                                                           begin + static_cast<std::ptrdiff_t>(end));
            std::array<std::size_t, 4> kept{i, static_cast<std::size_t>(least - begin),
                                            static_cast<std::size_t>(most - begin), end - 1};
            std::sort(kept.begin(), kept.end());
            for (const std::size_t one : kept) points.push_back(point(one));
            i = end;
        }
        return points;
    }

    void line(std::vector<Point> points, Colour colour, double width = 1) {
        out_.lines.push_back({std::move(points), colour, width});
    }
    void words(Point at, std::string text, Anchor anchor, Colour colour, double size = 12) {
        out_.words.push_back({at, std::move(text), anchor, colour, size});
    }

    const Recording& recording_;
    const std::vector<std::size_t>& columns_;
    const PlotOptions& options_;
    std::vector<Panel> panels_;
    double panel_height_ = 0;
    double low_ = 0;
    double high_ = 0;
    bool in_ms_ = false;
    Picture out_;
};

}  // namespace

Ticks nice_ticks(double low, double high, int most) {
    const double raw = (high - low) / std::max(1, most);
    const double power = std::pow(10, std::floor(std::log10(raw)));
    double step = 10 * power;
    for (const double factor : {5.0, 2.0, 1.0}) {
        if (factor * power >= raw * (1 - 1e-9)) step = factor * power;
    }
    Ticks ticks{.first = std::ceil(low / step - 1e-9) * step, .step = step};
    ticks.count = static_cast<int>(std::floor((high - ticks.first) / step + 1e-9)) + 1;
    ticks.decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
    return ticks;
}

Plotted plot(const Recording& recording, const PlotOptions& options) {
    std::vector<std::size_t> columns;
    for (std::size_t i = 0; i < recording.columns.size() && options.columns.empty(); ++i)
        columns.push_back(i);
    std::string known;
    for (const Column& column : recording.columns) known += (known.empty() ? "" : ", ") + column.name;
    for (const std::string& name : options.columns) {
        const auto found = std::find_if(recording.columns.begin(), recording.columns.end(),
                                        [&](const Column& column) { return column.name == name; });
        if (found == recording.columns.end())
            return {.error = fmt::format("the recording has no column '{}', only {}", name, known)};
        columns.push_back(static_cast<std::size_t>(found - recording.columns.begin()));
    }
    if (columns.size() > kMostCurves)
        return {.error = fmt::format("{} columns are more than {} curves; choose some of {} with --columns",
                                     columns.size(), kMostCurves, known)};
    if (recording.size() < 2) return {.error = "there are fewer than two samples, nothing to draw"};
    return {.picture = Plotter(recording, columns, options).draw()};
}

}  // namespace nplc::macreg
