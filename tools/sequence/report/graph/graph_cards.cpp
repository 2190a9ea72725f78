#include "report/graph/graph_cards.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "report/graph/graph_font.h"
#include "report/graph/graph_text.h"

namespace nplc::seqc {
namespace {

using TextKind = Picture::TextKind;
using TextAnchor = Picture::Anchor;

constexpr double kCardPad = 6;
constexpr double kRowLead = 1.3;  // times the size, from line to line
constexpr double kRise = 0.35;    // times the size, from the baseline to the middle of letters
constexpr double kBetweenWays = 2;
constexpr double kLetter = 6.02;      // of 10 points
constexpr double kBesideTarget = 12;  // between a condition and its target

class CardWriter {
  public:
    explicit CardWriter(std::string id) { card_.box.id = std::move(id); }

    void line(TextKind kind, const std::string& text, TextAnchor anchor = TextAnchor::start) {
        const TextStyle style = style_of(kind);
        y_ += style.size * kRowLead;
        put(kind, text, anchor, y_ - style.size * (kRowLead - 1));
        take(card_.box.texts.back().width);
    }
    void lines(TextKind kind, std::string_view text, std::size_t letters) {
        for (const std::string& part : wrapped(text, letters)) line(kind, part);
    }
    void rule() {
        card_.box.rules.push_back(y_ + kCardPad / 2);
        y_ += kCardPad;
    }

    void head(const GraphModel::Box& box) {
        const std::string number = box.shows_number ? fmt::format("{}", box.step) : "";
        line(TextKind::name, box.name, TextAnchor::middle);
        const Picture::Text& name = card_.box.texts.back();
        card_.entry_height = middle_of(name);
        const double y = name.y;
        const double name_width = name.width;
        if (number.empty()) return;
        put(TextKind::number, number, TextAnchor::start, y);
        take(name_width + 2 * (card_.box.texts.back().width + kCardPad));
    }

    /// With the target step next to it, or below if both are too wide.
    void way(const GraphModel::Way& way, const std::string& target, std::size_t letters, double room) {
        way_ = card_.way_heights.size();
        if (*way_ > 0) y_ += kBetweenWays;
        const std::string condition = target.empty() ? "EVERY_SCAN, " + way.condition : way.condition;
        const std::size_t first = card_.box.texts.size();
        lines(TextKind::condition, condition, letters);
        const Picture::Text begin = card_.box.texts[first];
        if (!way.actions.empty()) lines(TextKind::action, "/ " + way.actions, letters);
        double height = middle_of(begin);
        if (!target.empty()) {
            const double both =
                begin.width + kBesideTarget + text_width(target, style_of(TextKind::target).size);
            if (both <= room) {
                put(TextKind::target, target, TextAnchor::end, begin.y);
                take(both);
            } else {
                line(TextKind::target, target, TextAnchor::end);
                height = middle_of(card_.box.texts.back());
            }
        }
        card_.way_heights.push_back(height);
        way_.reset();
    }

    /// The first line ends before the folded corner.
    void make_room_for_fold() { take(card_.box.texts.front().width + kNoteFold - kCardPad); }

    Picture::Box& box() { return card_.box; }
    bool has_text() const { return !card_.box.texts.empty(); }

    Card done() {
        card_.box.height = y_ + kCardPad;
        return std::move(card_);
    }

  private:
    static double middle_of(const Picture::Text& text) { return text.y - style_of(text.kind).size * kRise; }
    void put(TextKind kind, const std::string& text, TextAnchor anchor, double y) {
        const TextStyle style = style_of(kind);
        card_.box.texts.push_back({.kind = kind,
                                   .anchor = anchor,
                                   .x = kCardPad,
                                   .y = y,
                                   .width = text_width(text, style.size, style.bold),
                                   .text = text,
                                   .way = way_});
    }
    void take(double width) { card_.box.width = std::max(card_.box.width, width + 2 * kCardPad); }

    Card card_;
    double y_ = kCardPad / 2;
    std::optional<std::size_t> way_;
};

std::string name_of(const GraphModel& model, std::uint8_t step) {
    const auto box = std::find_if(model.boxes.begin(), model.boxes.end(),
                                  [&](const GraphModel::Box& b) { return b.step == step; });
    if (box == model.boxes.end()) return fmt::format("step {}", step);
    return box->shows_number ? fmt::format("{} {}", step, box->name) : box->name;
}

std::string target_of(const GraphModel& model, const GraphModel::Way& way) {
    const std::string by = way.by ? fmt::format(", by {}", *way.by) : "";
    return "\u2192 " + name_of(model, way.to) + by;
}

/// Empty for a way that stays and does something in every scan.
std::string target_in(const GraphModel& model, const GraphModel::Box& box, const GraphModel::Way& way) {
    if (way.to != box.step) return target_of(model, way);
    return way.actions.empty() ? "stays" : "";
}

/// `room`: width for a condition and its target.
Card step_card(const GraphModel& model, const GraphModel::Box& box, std::size_t letters, double room) {
    CardWriter writer(fmt::format("s{}", box.step));
    writer.box().step = box.step;
    writer.box().reachable = box.reachable;
    writer.box().kind = !box.is_of_compiler                   ? Picture::BoxKind::step
                        : box.made_as.starts_with("copy of ") ? Picture::BoxKind::copy
                                                              : Picture::BoxKind::helper;
    writer.head(box);
    if (!box.reachable) writer.line(TextKind::made_as, "never reached", TextAnchor::middle);
    if (!box.made_as.empty()) writer.line(TextKind::made_as, box.made_as, TextAnchor::middle);
    if (box.steps.size() > 1) writer.line(TextKind::made_as, numbers_text(box.steps), TextAnchor::middle);
    if (!box.outputs.empty() || !box.entry.empty()) writer.rule();
    for (const std::string& output : box.outputs) writer.lines(TextKind::output, output, letters);
    for (const std::string& entry : box.entry) writer.lines(TextKind::entry, entry, letters);
    if (!box.ways.empty()) writer.rule();
    for (const GraphModel::Way& way : box.ways) writer.way(way, target_in(model, box, way), letters, room);
    return writer.done();
}

}  // namespace

std::vector<Card> step_cards(const GraphModel& model, std::size_t letters) {
    std::vector<Card> cards;
    for (const GraphModel::Box& box : model.boxes)
        cards.push_back(step_card(model, box, letters, static_cast<double>(letters) * kLetter));
    return cards;
}

void widen(Card& card, double width, const GraphModel& model, std::size_t letters) {
    if (card.box.kind != Picture::BoxKind::note) {
        const auto box = std::find_if(model.boxes.begin(), model.boxes.end(),
                                      [&](const GraphModel::Box& b) { return b.step == card.box.step; });
        card = step_card(model, *box, letters, width - 2 * kCardPad);
        card.box.width = width;
    }
    for (Picture::Text& text : card.box.texts) {
        text.x = text.anchor == TextAnchor::start    ? kCardPad
                 : text.anchor == TextAnchor::middle ? card.box.width / 2
                                                     : card.box.width - kCardPad;
    }
}

std::vector<Card> note_cards(const GraphModel& model, std::size_t letters) {
    std::map<std::uint8_t, CardWriter> writers;
    for (const GraphModel::Note& note : model.notes) {
        const std::uint8_t to = note.way.to;
        CardWriter& writer = writers.try_emplace(to, fmt::format("n{}", to)).first->second;
        writer.box().on_error = note.way.on_error && (!writer.has_text() || writer.box().on_error);
        if (writer.has_text()) writer.rule();
        writer.lines(note.way.on_error ? TextKind::error_note : TextKind::note, note.way.condition, letters);
        writer.lines(TextKind::where, note.where, letters);
        if (!note.way.actions.empty()) writer.lines(TextKind::action, "/ " + note.way.actions, letters);
    }
    std::vector<Card> cards;
    for (auto& [to, writer] : writers) {
        writer.line(TextKind::target, "\u2192 " + name_of(model, to));
        writer.make_room_for_fold();
        writer.box().kind = Picture::BoxKind::note;
        writer.box().step = to;
        cards.push_back(writer.done());
    }
    return cards;
}

}  // namespace nplc::seqc
