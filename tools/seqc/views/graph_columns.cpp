#include "views/graph_columns.h"

#include <fmt/format.h>

#include <algorithm>

#include "views/graph_text.h"

namespace nplc::seqc {
namespace {

constexpr std::size_t kByTheirLines = 14;  // boxes that lines alone lay out well
constexpr std::size_t kMostColumns = 7;
// Points of an A4 page, and about what a line and a letter take.
constexpr double kPageWidth = 525;
constexpr double kPageHeight = 770;
constexpr double kLine = 15;
constexpr double kLetter = 6.2;
constexpr double kGap = 34;

struct Card {
    std::string name;
    double width = 0;
    double height = 0;
};

class Measure {
  public:
    void line(std::size_t letters, std::size_t count = 1) {
        width_ = std::max(width_, static_cast<double>(letters) * kLetter + kGap / 2);
        height_ += static_cast<double>(count) * kLine;
    }
    void text(const std::string& text, std::size_t beside = 0) {
        for (const std::string& part : wrapped(text, kBoxWidth)) line(part.size() + beside);
    }
    Card card(std::string name) const { return {std::move(name), width_, height_ + kGap}; }

  private:
    double width_ = 0;
    double height_ = 0;
};

constexpr std::size_t kTarget = 16;  // letters of a target beside a condition

Card card_of(const GraphModel::Box& box) {
    Measure measure;
    measure.line(box.name.size() + 4);
    for (const std::string& output : box.outputs) measure.text(output);
    for (const std::string& entry : box.entry) measure.text(entry);
    for (const GraphModel::Way& way : box.ways) {
        measure.text(way.condition, kTarget);
        measure.text(way.actions, kTarget);
    }
    return measure.card(fmt::format("s{}", box.step));
}

Card card_of(const GraphModel::Note& note, std::size_t number) {
    Measure measure;
    measure.text(note.way.condition);
    measure.text(note.where);
    measure.text(note.way.actions);
    measure.line(kTarget);
    return measure.card(fmt::format("n{}", number));
}

/// By how much the page must be made smaller. Cards side by side share the height of the highest.
double scale_of(const std::vector<Card>& cards, std::size_t rows) {
    double width = 0;
    for (std::size_t at = 0; at < cards.size(); at += rows) {
        double widest = 0;
        for (std::size_t i = at; i < std::min(at + rows, cards.size()); ++i)
            widest = std::max(widest, cards[i].width);
        width += widest;
    }
    double height = 0;
    for (std::size_t row = 0; row < rows; ++row) {
        double highest = 0;
        for (std::size_t i = row; i < cards.size(); i += rows) highest = std::max(highest, cards[i].height);
        height += highest;
    }
    return std::min(kPageWidth / width, kPageHeight / height);
}

}  // namespace

std::map<LinePair, bool> lines_of(const GraphModel& model) {
    std::map<LinePair, bool> lines;
    for (const GraphModel::Box& box : model.boxes) {
        for (const GraphModel::Way& way : box.ways) {
            if (way.to == box.step) continue;
            const auto [line, is_new] = lines.try_emplace({box.step, way.by.value_or(way.to)}, way.on_error);
            if (!is_new) line->second = line->second && way.on_error;
        }
    }
    return lines;
}

std::vector<std::vector<std::string>> columns_of(const GraphModel& model) {
    std::vector<Card> cards;
    for (const GraphModel::Box& box : model.boxes) {
        for (std::size_t i = 0; i < model.notes.size(); ++i) {
            if (model.notes[i].way.to == box.step) cards.push_back(card_of(model.notes[i], i));
        }
        cards.push_back(card_of(box));
    }
    const std::size_t lines = lines_of(model).size();
    std::size_t rows = cards.size();
    if (cards.size() > kByTheirLines || lines > 3 * cards.size()) {
        double best = 0;
        for (std::size_t columns = 2; columns <= kMostColumns; ++columns) {
            const std::size_t wanted = (cards.size() + columns - 1) / columns;
            const double scale = scale_of(cards, wanted);
            if (scale <= best) continue;
            best = scale;
            rows = wanted;
        }
    }
    std::vector<std::vector<std::string>> result;
    for (std::size_t i = 0; i < cards.size(); ++i) {
        if (i % rows == 0) result.emplace_back();
        result.back().push_back(cards[i].name);
    }
    return result;
}

}  // namespace nplc::seqc
