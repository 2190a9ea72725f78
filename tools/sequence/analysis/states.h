#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <unordered_map>
#include <vector>

#include "place.h"

namespace nplc::verify {

/// The states that were found, numbered in their order, each a place and, if times count, a zone; found again
/// by their place.
class States {
  public:
    using Node = std::uint32_t;
    static constexpr Node kNone = ~Node{0};

    /// The scan that led to a state first.
    struct Origin {
        Node parent = kNone;
        std::uint32_t group = 0;
        std::uint8_t part = 0;  ///< of the images: which of what the deadline distinguishes
    };

    /// What tells states apart.
    struct Kind {
        bool zones = false;
        bool deadline = false;
        bool motion = false;
        std::uint16_t greatest_counter = 0;
    };
    explicit States(const Kind& kind)
        : has_zones_(kind.zones), counts_(kind.greatest_counter + std::size_t{1}) {
        const unsigned bits = Place::kPlainBits + (kind.deadline ? 1U : 0U);
        const std::size_t size = counts_ << bits;
        if (size <= kMostDense && !kind.motion) dense_size_ = size;
    }
    /// Takes memory, enough for most tables: it is committed only where it is written.
    void reserve() {
        if (dense_size_ != 0) dense_.reset(static_cast<Node*>(std::calloc(dense_size_, sizeof(Node))));
        constexpr std::size_t kNodes = std::size_t{1} << 17U;
        places_.reserve(kNodes);
        origins_.reserve(kNodes);
        depths_.reserve(kNodes);
        if (has_zones_) zones_.reserve(kNodes);
    }

    std::size_t size() const { return places_.size(); }
    const Place& place(Node node) const { return places_[node]; }
    const Zone& zone(Node node) const { return zones_[node]; }
    const Origin& origin(Node node) const { return origins_[node]; }
    std::uint32_t depth(Node node) const { return depths_[node]; }
    /// By its scan before: 0 if there is none.
    std::uint32_t depth_after(const Origin& origin) const {
        return origin.parent == kNone ? 0 : depths_[origin.parent] + 1;
    }

    /// The last one with this place, or kNone.
    Node at(const Place& place) const {
        if (dense_) return dense_[dense_index(place)] - 1;
        const auto found = sparse_.find(place.packed());
        return found == sparse_.end() ? kNone : found->second - 1;
    }
    /// One with this place whose times include those of the zone, or kNone.
    Node find(const Place& place, const Zone& zone) {
        Node node = at(place);
        if (!has_zones_) return node;
        while (node != kNone && !zone.within(zones_[node])) {
            node = same_place_[node];
            ++work_;
        }
        return node;
    }
    /// From one that `find` gave on: one that is no deeper than `depth` besides.
    Node find_no_deeper(Node node, const Zone& zone, std::uint32_t depth) const {
        while (node != kNone && (depths_[node] > depth || !zone.within(zones_[node])))
            node = same_place_[node];
        return node;
    }
    Node add(const Place& place, const Zone& zone, const Origin& origin, std::uint32_t depth) {
        const auto node = static_cast<Node>(places_.size());
        Node& first = slot(place);
        places_.push_back(place);
        origins_.push_back(origin);
        depths_.push_back(depth);
        if (has_zones_) {
            zones_.push_back(zone);
            same_place_.push_back(first - 1);
        }
        first = node + 1;
        return node;
    }
    /// Where only the time since a deadline began differs: whether known nodes include all times that can
    /// have passed; if not, they are added.
    bool is_covered(const Place& place, const Bounds& passed) {
        std::vector<Bounds>& parts = covered_[place.packed()];
        const auto first = std::find_if(parts.begin(), parts.end(),
                                        [&](const Bounds& part) { return part.most >= passed.least - 1; });
        if (first != parts.end() && passed.within(*first)) return true;
        Bounds joined = passed;
        auto end = first;
        for (; end != parts.end() && end->least <= passed.most + 1; ++end)
            joined = {std::min(joined.least, end->least), std::max(joined.most, end->most)};
        parts.insert(parts.erase(first, end), joined);
        return false;
    }

    /// With zones: a look-up costs as much as kLookUp comparisons.
    void count_look_up() {
        if (has_zones_) work_ += kLookUp;
    }
    /// The limit of work on times is reached.
    bool is_worn_out() const { return work_ >= kMostWork; }

  private:
    static constexpr std::uint64_t kMostWork = 25'000'000;  ///< comparisons of zones
    static constexpr std::uint64_t kLookUp = 10;
    static constexpr std::size_t kMostDense = std::size_t{1} << 24U;
    struct FreeMemory {
        void operator()(void* memory) const { std::free(memory); }
    };

    Node& slot(const Place& place) {
        if (dense_) return dense_[dense_index(place)];
        return sparse_.try_emplace(place.packed(), 0).first->second;
    }
    std::size_t dense_index(const Place& place) const {
        return std::size_t{place.packed_plain()} * counts_ + place.counter;
    }

    bool has_zones_;
    std::size_t counts_;          ///< that the counter can have
    std::size_t dense_size_ = 0;  ///< 0: too large, or places do not say all
    std::vector<Place> places_;
    std::vector<Origin> origins_;
    std::vector<std::uint32_t> depths_;
    std::vector<Zone> zones_;                    ///< only if they count
    std::vector<Node> same_place_;               ///< the node before it with the same place
    std::unique_ptr<Node[], FreeMemory> dense_;  ///< node + 1, by place; 0 for none
    std::unordered_map<std::uint64_t, Node> sparse_;
    /// With a deadline and a stopped timer: the times that can have passed at a place, as disjoint ranges.
    std::unordered_map<std::uint64_t, std::vector<Bounds>> covered_;
    std::uint64_t work_ = 0;  ///< with zones
};

}  // namespace nplc::verify
