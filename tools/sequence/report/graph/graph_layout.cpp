#include "report/graph/graph_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "report/graph/graph_columns.h"
#include "report/graph/graph_font.h"
#include "report/graph/graph_routes.h"
#include "report/graph/graph_text.h"

namespace nplc::seqc {
namespace {

using TextKind = Picture::TextKind;

// Points of an A4 page minus its margins.
constexpr double kShort = 539;
constexpr double kLong = 786;
constexpr double kAcross = 0.92;   // weight of a landscape page
constexpr double kAsGood = 1.001;  // minimum improvement for a candidate
constexpr std::size_t kMostColumns = 8;
constexpr std::array<std::size_t, 3> kLetters{44, 34, 26};
constexpr std::array<std::pair<LinesDrawn, double>, 3> kLines{
    {{LinesDrawn::all, 1}, {LinesDrawn::beside, 0.8}, {LinesDrawn::neighbours, 0.65}}};
constexpr double kLeastHeading = 240;
constexpr double kPageMargin = 8;
constexpr double kUnderHeading = 14;

/// Lines of text, one below the other.
class Lines {
  public:
    void add(TextKind kind, const std::string& text) {
        const TextStyle style = style_of(kind);
        y_ += style.size * 1.3;
        texts_.push_back({.kind = kind,
                          .anchor = Picture::Anchor::start,
                          .x = kPageMargin,
                          .y = y_ - style.size * 0.3,
                          .width = text_width(text, style.size, style.bold),
                          .text = text});
    }
    /// Adds parts side by side, as many as fit per line.
    void add(TextKind kind, const std::vector<std::string>& parts, std::string_view between, double width) {
        std::string line;
        for (const std::string& part : parts) {
            std::string longer = line.empty() ? part : line + std::string(between) + part;
            if (!line.empty() && text_width(longer, style_of(kind).size) > width) {
                add(kind, line + std::string(between.substr(0, 1)));
                longer = part;
            }
            line = std::move(longer);
        }
        if (!line.empty()) add(kind, line);
    }
    double height() const { return y_; }
    double width() const {
        double width = 0;
        for (const Picture::Text& text : texts_) width = std::max(width, text.width);
        return width;
    }
    void move_to(double y, std::vector<Picture::Text>& texts) const {
        for (Picture::Text text : texts_) {
            text.y += y;
            texts.push_back(std::move(text));
        }
    }

  private:
    std::vector<Picture::Text> texts_;
    double y_ = 0;
};

Lines heading_of(const GraphModel& model, double width) {
    Lines lines;
    lines.add(TextKind::title, model.title);
    std::vector<std::string> machine;
    if (!model.motor.empty()) machine.push_back("Motor: " + model.motor);
    if (!model.scale.empty()) machine.push_back("Scale: " + model.scale);
    lines.add(TextKind::motor, machine, ", ", width);
    for (const std::string_view kind : {"IN", "OUT"}) {
        std::vector<std::string> terminals;
        for (const auto& [terminal, name] : model.terminals) {
            if (terminal.starts_with(kind)) terminals.push_back(fmt::format("{} = {}", terminal, name));
        }
        lines.add(TextKind::terminal, terminals, ", ", width);
    }
    lines.add(TextKind::terminal, model.set_points, "; ", width);
    return lines;
}

Lines footer_of(const GraphModel& model, double width) {
    Lines lines;
    std::vector<std::string> parts{model.footer};
    if (const std::string_view legend = legend_of(model); !legend.empty()) parts.emplace_back(legend);
    lines.add(TextKind::footer, parts, "; ", width);
    return lines;
}

void move(Picture::Box& box, double x, double y) {
    box.x += x;
    box.y += y;
    for (Picture::Text& text : box.texts) {
        text.x += box.x;
        text.y += box.y;
    }
    for (double& rule : box.rules) rule += box.y;
}

double scale_on(const Picture& picture, double width, double height) {
    return std::min({width / picture.width, height / picture.height, 1.0});
}

/// Readability of a page with this picture.
double fit(Picture& picture) {
    const double upright = scale_on(picture, kShort, kLong);
    const double across = scale_on(picture, kLong, kShort);
    picture.scale = upright >= across * kAcross ? upright : across;
    return std::max(upright, across * kAcross);
}

Picture laid_out(const GraphModel& model, std::size_t columns, std::size_t letters, LinesDrawn drawn) {
    CardColumns cards = columns_of(model, columns, letters);
    Routes routes = route(cards, model, drawn);
    const Lines heading = heading_of(model, std::max(routes.width, kLeastHeading));
    const Lines footer = footer_of(model, std::max(routes.width, kLeastHeading));
    const double inner = std::max({routes.width, heading.width(), footer.width()});
    const double x = kPageMargin + (inner - routes.width) / 2;
    const double y = kPageMargin + heading.height() + kUnderHeading;
    Picture picture;
    picture.width = inner + 2 * kPageMargin;
    heading.move_to(kPageMargin, picture.texts);
    footer.move_to(y + routes.height + kUnderHeading / 2, picture.texts);
    picture.height = y + routes.height + kUnderHeading / 2 + footer.height() + kPageMargin;
    for (std::vector<Card>& column : cards) {
        for (Card& card : column) {
            move(card.box, x, y);
            picture.boxes.push_back(std::move(card.box));
        }
    }
    for (Picture::Line& line : routes.lines) {
        for (auto& [px, py] : line.points) {
            px += x;
            py += y;
        }
        picture.lines.push_back(std::move(line));
    }
    std::stable_sort(picture.lines.begin(), picture.lines.end(),
                     [](const Picture::Line& a, const Picture::Line& b) { return a.kind < b.kind; });
    return picture;
}

}  // namespace

Picture picture_of(const GraphModel& model) {
    Picture best;
    double worth = 0;
    for (const auto& [drawn, share] : kLines) {
        if (worth > share) break;
        for (std::size_t columns = 1; columns <= std::min(kMostColumns, model.boxes.size()); ++columns) {
            for (const std::size_t letters : kLetters) {
                Picture picture = laid_out(model, columns, letters, drawn);
                const double now = fit(picture) * share;
                if (now <= worth * kAsGood) continue;
                worth = now;
                best = std::move(picture);
            }
        }
    }
    return best;
}

}  // namespace nplc::seqc
