#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nplc::seqc {

/// A drawing with all coordinates: x to the right, y down. Independent of fonts and programs.
struct Picture {
    enum class TextKind : std::uint8_t {
        title,
        motor,
        terminal,
        footer,
        number,
        name,
        made_as,
        output,
        entry,
        condition,
        action,
        target,
        note,
        error_note,
        where
    };
    enum class Anchor : std::uint8_t { start, middle, end };
    struct Text {
        TextKind kind = TextKind::name;
        Anchor anchor = Anchor::start;
        double x = 0;
        double y = 0;      ///< baseline
        double width = 0;  ///< maximum width
        std::string text = {};
        std::optional<std::size_t> way = {};  ///< of its box
    };
    enum class BoxKind : std::uint8_t { step, helper, copy, note };
    struct Box {
        std::string id;  ///< "s5" for a step, "n5" for a note of its incoming transitions
        BoxKind kind = BoxKind::step;
        std::uint8_t step = 0;
        bool reachable = true;
        bool on_error = false;  ///< a note for errors only
        double x = 0;
        double y = 0;
        double width = 0;
        double height = 0;
        std::vector<Text> texts = {};
        std::vector<double> rules = {};  ///< heights of horizontal lines
    };
    enum class LineKind : std::uint8_t {
        error,
        back,
        forward,
        note
    };  ///< in order of drawing: later ones are on top
    using Point = std::pair<double, double>;
    struct Line {
        std::string from;
        std::string to;
        std::optional<std::size_t> way;  ///< of the box where it begins
        LineKind kind = LineKind::forward;
        std::vector<Point> points;  ///< empty: only the arrow in the box shows the target
    };

    double width = 0;
    double height = 0;
    double scale = 1;  ///< points of the paper per unit
    std::vector<Text> texts;
    std::vector<Box> boxes;
    std::vector<Line> lines;  ///< back to front
};

inline constexpr double kNoteFold = 12;     ///< of a note's upper right corner, as Graphviz folds it
inline constexpr double kInnerFrame = 2.5;  ///< of POWER_UP, from its outer frame

struct TextStyle {
    double size;
    bool bold;
    bool italic;
    std::string_view colour;
    std::string_view name;  ///< name of the kind
};

TextStyle style_of(Picture::TextKind kind);
std::string_view colour_of(Picture::LineKind kind);
std::string_view name_of(Picture::LineKind kind);
std::string_view name_of(Picture::BoxKind kind);
std::string_view colour_of(const Picture::Box& box);
/// Distance from the outer frame to the start of rules.
double inset_of(const Picture::Box& box);
/// Colour of a text in it.
std::string_view colour_of(const Picture::Box& box, const Picture::Text& text);
std::string_view fill_of(const Picture::Box& box);

}  // namespace nplc::seqc
