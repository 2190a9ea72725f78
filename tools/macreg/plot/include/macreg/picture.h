#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// A picture of lines and texts, and its conversion to a file.
namespace nplc::macreg {

struct Point {
    double x = 0;
    double y = 0;
};

using Colour = std::uint32_t;  ///< 0xRRGGBB

/// In pixels from the upper left corner; drawn in order.
struct Picture {
    struct Line {
        std::vector<Point> points;
        Colour colour = 0;
        double width = 1;
    };
    struct Words {
        enum class Anchor : std::uint8_t { start, middle, end };
        Point at;  ///< of the baseline
        std::string text;
        Anchor anchor = Anchor::start;
        Colour colour = 0;
        double size = 12;  ///< of the letters' line, in pixels
    };

    int width = 0;
    int height = 0;
    std::vector<Line> lines{};
    std::vector<Words> words{};
};

std::string to_svg(const Picture& picture);
/// ASCII letters only.
std::string to_png(const Picture& picture);

}  // namespace nplc::macreg
