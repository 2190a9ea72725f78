#include "report/graph/graph_columns.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

namespace nplc::seqc {
namespace {

constexpr double kCardGap = 18;

class Reading {
  public:
    explicit Reading(const GraphModel& model) : model_(model) {
        for (const GraphModel::Note& note : model.notes) noted_.insert(note.way.to);
        for (const GraphModel::Box& box : model.boxes) {
            std::set<std::uint8_t> targets;
            for (const GraphModel::Way& way : box.ways) targets.insert(way.by.value_or(way.to));
            for (const std::uint8_t to : targets) ++entries_[to];
        }
    }

    std::vector<std::size_t> order() {
        while (order_.size() < model_.boxes.size()) {
            std::optional<std::size_t> next = first();
            while (next) {
                order_.push_back(*next);
                placed_.insert(model_.boxes[*next].step);
                next = after(*next);
            }
        }
        return order_;
    }

  private:
    /// Among the targets, the one with the fewest other sources.
    std::optional<std::size_t> after(std::size_t at) const {
        std::optional<std::size_t> best;
        for (const GraphModel::Way& way : model_.boxes[at].ways) {
            const std::uint8_t to = way.by.value_or(way.to);
            const std::optional<std::size_t> box = place_of(to);
            if (!box || way.on_error || noted_.contains(to)) continue;
            if (!best || entries_[to] < entries_[model_.boxes[*best].step]) best = box;
        }
        return best;
    }

    std::optional<std::size_t> first() const {
        for (auto placed = order_.rbegin(); placed != order_.rend(); ++placed) {
            if (const auto next = after(*placed)) return next;
        }
        std::optional<std::size_t> any;
        for (std::size_t i = 0; i < model_.boxes.size(); ++i) {
            const std::uint8_t step = model_.boxes[i].step;
            if (placed_.contains(step)) continue;
            if (step == 0 || noted_.contains(step)) return i;
            if (!any) any = i;
        }
        return any;
    }

    std::optional<std::size_t> place_of(std::uint8_t step) const {
        if (placed_.contains(step)) return std::nullopt;
        for (std::size_t i = 0; i < model_.boxes.size(); ++i) {
            if (model_.boxes[i].step == step) return i;
        }
        return std::nullopt;
    }

    const GraphModel& model_;
    std::set<std::uint8_t> noted_;
    std::set<std::uint8_t> placed_;
    std::array<std::size_t, kStepNumbers> entries_{};
    std::vector<std::size_t> order_;
};

/// A step with the note above it.
using Group = std::vector<Card>;

std::vector<Group> groups_of(const GraphModel& model, std::size_t letters) {
    std::vector<Card> notes = note_cards(model, letters);
    std::vector<Card> steps = step_cards(model, letters);
    std::vector<Group> groups;
    for (const std::size_t at : reading_order(model)) {
        Group group;
        for (Card& note : notes) {
            if (note.box.step == steps[at].box.step) group.push_back(std::move(note));
        }
        group.push_back(std::move(steps[at]));
        groups.push_back(std::move(group));
    }
    return groups;
}

double height_of(const Group& group) {
    double height = 0;
    for (const Card& card : group) height += card.box.height + kCardGap;
    return height;
}

/// Starts of columns such that none is higher than `limit`, except for a single larger group.
std::vector<std::size_t> breaks(const std::vector<double>& heights, double limit) {
    std::vector<std::size_t> begins;
    double height = 0;
    for (std::size_t i = 0; i < heights.size(); ++i) {
        if (i == 0 || height + heights[i] > limit) {
            begins.push_back(i);
            height = 0;
        }
        height += heights[i];
    }
    return begins;
}

std::vector<std::size_t> even_breaks(const std::vector<double>& heights, std::size_t columns) {
    double low = 0;
    double high = 0;
    for (const double height : heights) {
        low = std::max(low, height);
        high += height;
    }
    constexpr int kHalvings = 20;
    for (int i = 0; i < kHalvings; ++i) {
        const double limit = (low + high) / 2;
        (breaks(heights, limit).size() > columns ? low : high) = limit;
    }
    return breaks(heights, high);
}

void stack(std::vector<Card>& column, const GraphModel& model, std::size_t letters) {
    double width = 0;
    for (const Card& card : column) width = std::max(width, card.box.width);
    double y = 0;
    for (Card& card : column) {
        widen(card, width, model, letters);
        card.box.y = y;
        y += card.box.height + kCardGap;
    }
}

}  // namespace

std::vector<std::size_t> reading_order(const GraphModel& model) {
    return Reading(model).order();
}

CardColumns columns_of(const GraphModel& model, std::size_t columns, std::size_t letters) {
    std::vector<Group> groups = groups_of(model, letters);
    std::vector<double> heights;
    for (const Group& group : groups) heights.push_back(height_of(group));
    const std::vector<std::size_t> begins = even_breaks(heights, columns);
    CardColumns result;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        if (std::find(begins.begin(), begins.end(), i) != begins.end()) result.emplace_back();
        for (Card& card : groups[i]) result.back().push_back(std::move(card));
    }
    for (std::vector<Card>& column : result) stack(column, model, letters);
    return result;
}

}  // namespace nplc::seqc
