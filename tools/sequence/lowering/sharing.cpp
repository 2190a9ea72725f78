#include "lowering/sharing.h"

#include <algorithm>
#include <bit>

#include "lowering/cover.h"

namespace nplc::seqc {
namespace {

constexpr std::size_t kMostWork = 65'536;
constexpr std::size_t kTerm = 10'000;  // unit of a cost; smaller parts only break ties
constexpr std::size_t kClash = 100;

}  // namespace

Sharing::Sharing(const ReducedStep& error_branch)
    : error_branch_(error_branch), sender_(error_branch.behaviours.size()) {
    for (std::size_t b = 0; b < error_branch.behaviours.size(); ++b) {
        if (error_branch.behaviours[b].sends() == 0) continue;
        Branch branch{static_cast<std::uint16_t>(b), &error_branch.behaviours[b].action->sends, 0};
        for (std::size_t i = 0; i < branch.sends->size(); ++i) {
            if ((*branch.sends)[i].reg == nullptr) branch.last_fast = i + 1;
        }
        sender_[b] = Branches{1} << (branches_.size() % 32);
        branches_.push_back(branch);
    }
}

const Sharing::Regions& Sharing::regions(Branches set) {
    const auto [found, is_new] = regions_.try_emplace(set);
    if (is_new) found->second = make_regions(set);
    return found->second;
}

Sharing::Regions Sharing::make_regions(Branches set) const {
    const std::size_t layers = error_branch_.cases() >> error_branch_.inputs;
    std::vector<Points> by_zeros(layers);
    const std::size_t mask = (std::size_t{1} << error_branch_.inputs) - 1;
    for (std::size_t point = 0; point < kPoints; ++point) {
        std::size_t first = layers;
        for (std::size_t zeros = 0; zeros < layers && first == layers; ++zeros) {
            if (contains(set, (point & mask) | zeros << error_branch_.inputs)) first = zeros;
        }
        if (first == layers) continue;
        for (std::size_t zeros = first; zeros < layers; ++zeros) {
            const bool in = contains(set, (point & mask) | zeros << error_branch_.inputs);
            if (in != ((zeros & first) == first)) return std::nullopt;
        }
        by_zeros[first].set(point);
    }
    std::vector<Region> result;
    for (std::size_t zeros = 0; zeros < layers; ++zeros) {
        for (Cube cube : disjoint_cover(by_zeros[zeros]))
            result.push_back({cube.value, cube.care, static_cast<std::uint8_t>(zeros)});
    }
    return result;
}

const std::optional<Way>& Sharing::align(Branches group, bool own_ends) {
    const auto [found, is_new] = aligned_.try_emplace({group, own_ends});
    if (is_new) found->second = make_way(group, own_ends);
    return found->second;
}

/// Whether branches of `set` with different next steps have their last FastMAC order here, which carries the
/// next step.
bool Sharing::ends_clash(Branches set, const std::vector<std::size_t>& positions) const {
    const Behaviour* first = nullptr;
    for (std::size_t b = 0; b < branches_.size(); ++b) {
        if (((set >> b) & 1U) == 0 || positions[b] + 1 != branches_[b].last_fast) continue;
        const Behaviour& behaviour = error_branch_.behaviours[branches_[b].behaviour];
        if (first == nullptr) first = &behaviour;
        if (behaviour.next != first->next || behaviour.output_byte() != first->output_byte()) return true;
    }
    return false;
}

/// The next order common to all branches of `pick`.
std::optional<Column> Sharing::column_of(std::uint32_t pick, const std::vector<std::size_t>& members,
                                         const std::vector<std::size_t>& positions) const {
    Column column;
    for (std::size_t i = 0; i < members.size(); ++i) {
        if (((pick >> i) & 1U) == 0) continue;
        const std::vector<Send>& sends = *branches_[members[i]].sends;
        const std::size_t position = positions[members[i]];
        if (position == sends.size()) return std::nullopt;
        if (column.send != nullptr && !column.send->same_effect(sends[position])) return std::nullopt;
        if (column.send == nullptr) column.send = &sends[position];
        column.branches |= Branches{1} << members[i];
    }
    return column;
}

/// A state encodes how many orders of each member are sent, as one number.
void Sharing::extend(std::size_t state, const std::vector<std::size_t>& members, bool own_ends,
                     std::vector<Best>& best) {
    std::vector<std::size_t> positions(branches_.size());
    std::size_t rest = state;
    for (std::size_t b : members) {
        positions[b] = rest % (branches_[b].sends->size() + 1);
        rest /= branches_[b].sends->size() + 1;
    }
    for (std::uint32_t pick = 1; pick < (1U << members.size()); ++pick) {
        const std::optional<Column> column = column_of(pick, members, positions);
        if (!column) continue;
        const bool clash = ends_clash(column->branches, positions);
        if (clash && own_ends) continue;
        const Regions& needed = regions(column->branches);
        if (!needed) continue;
        std::size_t to = state;
        std::size_t stride = 1;
        for (std::size_t i = 0; i < members.size(); ++i) {
            if (((pick >> i) & 1U) != 0) to += stride;
            stride *= branches_[members[i]].sends->size() + 1;
        }
        const std::size_t cost = best[state].cost + needed->size() * kTerm + (clash ? kClash : 0) +
                                 static_cast<std::size_t>(std::popcount(column->branches)) - 1;
        if (cost < best[to].cost) best[to] = {cost, state, *column};
    }
}

std::optional<Way> Sharing::make_way(Branches group, bool own_ends) {
    std::vector<std::size_t> members;
    std::size_t states = 1;
    for (std::size_t b = 0; b < branches_.size(); ++b) {
        if (((group >> b) & 1U) == 0) continue;
        members.push_back(b);
        states *= branches_[b].sends->size() + 1;
        if (members.size() > 1 && states << members.size() > kMostWork) return std::nullopt;
    }
    std::vector<Best> best(states);
    best[0].cost = 0;
    for (std::size_t state = 0; state + 1 < states; ++state) {
        if (best[state].cost != SIZE_MAX) extend(state, members, own_ends, best);
    }
    if (best.back().cost == SIZE_MAX) return std::nullopt;
    Way way;
    for (std::size_t state = states - 1; state != 0; state = best[state].from) {
        way.columns.push_back(best[state].column);
        way.terms += regions(best[state].column.branches)->size();
    }
    std::reverse(way.columns.begin(), way.columns.end());
    return way;
}

}  // namespace nplc::seqc
