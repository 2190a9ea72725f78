#pragma once

#include <string>
#include <vector>

#include "macreg/picture.h"
#include "macreg/recording.h"

namespace nplc::macreg {

/// Steps of 1, 2 or 5 times a power of ten within `low`..`high`, about `most` of them.
struct Ticks {
    double first = 0;
    double step = 1;
    int count = 0;
    int decimals = 0;
    double at(int i) const { return first + i * step; }
};
Ticks nice_ticks(double low, double high, int most);

struct PlotOptions {
    int width = 960;
    int height = 0;  ///< 0: according to the number of panels
    std::string title{};
    std::vector<std::string> columns{};  ///< empty: all
};

inline constexpr std::size_t kMostCurves = 4;

struct Plotted {
    Picture picture{};
    std::string error{};  ///< one line; empty if it was drawn
};

/// One panel per unit, one above the other with a common time axis; curves of the same unit share a panel. At
/// most kMostCurves. Where there are more samples than pixels, minimum and maximum are kept.
Plotted plot(const Recording& recording, const PlotOptions& options);

}  // namespace nplc::macreg
