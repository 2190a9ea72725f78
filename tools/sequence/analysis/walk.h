#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <unordered_set>
#include <vector>

#include "conflict.h"
#include "explorer.h"

namespace nplc::verify {

/// Follows courses, breadth first, with a state of their own: a number below 64. They begin at power-up or
/// with scans that set the state independently of earlier ones.
class Walk {
  public:
    using Memory = std::uint16_t;

    /// With `excluded`, excluded courses are not followed. With `distances`, a lower bound of the scans from
    /// each node to the goal, the shortest courses there come first, and nodes at kFar are not followed.
    explicit Walk(const Explorer& explorer, Excluded* excluded = nullptr,
                  const std::vector<std::uint32_t>* distances = nullptr)
        : explorer_(explorer),
          excluded_(excluded),
          distances_(distances),
          known_(excluded == nullptr ? explorer.size() : 0) {
        if (distances == nullptr) reached_.reserve(4 * explorer.size());
    }

    void begin_at_power_up(Memory memory) { add({.node = 0, .memory = memory}); }
    /// Scans must be added in the order of edges.
    void begin_with(const Explorer::Edge& edge, Memory memory) {
        sources_.push_back(
            {.node = edge.to, .memory = memory, .edge = index_of(edge), .depth = depth_after(edge)});
    }
    void begin_with(const Explorer::Edge& edge, const ImageSet& images, Memory memory) {
        if (images.none()) return;
        begin_with(edge, memory);
        sources_.back().images = kept(images);
    }

    /// A scan that can follow in this state.
    class Scan {
      public:
        const Explorer::Edge& edge;
        Memory memory;
        ImageSet images() const { return walk_.explorer_.images_of(edge); }
        /// The state after it, for all its images or for some.
        void go_on(Memory then) const { walk_.go_on(*this, then, kNone); }
        void go_on(const ImageSet& some, Memory then) const {
            if (some.none() || (walk_.excluded_ == nullptr && walk_.knows(edge.to, then))) return;
            walk_.go_on(*this, then, walk_.kept(some));
        }
        /// Whether a deadline can be missed after it, as far as is known.
        bool may_miss(bool begins) const {
            return walk_.excluded_ == nullptr ||
                   !walk_.excluded_->ends_out(walk_.reached_[at_].state, edge, begins);
        }
        /// Whether these scans may follow it.
        bool may_go_on_with(const std::vector<CourseScan>& then) const {
            Excluded::State state = walk_.excluded_->next(walk_.reached_[at_].state, edge);
            for (const CourseScan& scan : then)
                state = state == Excluded::kOut ? state : walk_.excluded_->next(state, scan);
            return state != Excluded::kOut;
        }
        /// No other is passed after this one, if there are excluded courses.
        void stop() const { walk_.stopped_ = true; }
        /// The course to it.
        std::vector<CourseScan> course(const ImageSet& some) const {
            std::vector<CourseScan> course = walk_.course_to(at_);
            course.push_back(walk_.explorer_.scan_of(edge, some));
            return course;
        }

      private:
        friend Walk;
        Scan(Walk& walk, std::uint32_t at, const Explorer::Edge& of)
            : edge(of), memory(walk.reached_[at].memory), walk_(walk), at_(at) {}
        Walk& walk_;
        std::uint32_t at_;
    };

    /// `pass(scan)` is called for each scan that can follow in the state.
    template <class Pass>
    void all(const Pass& pass) {
        if (excluded_ != nullptr) return all_but_excluded(pass);
        std::size_t next_source = 0;
        for (std::uint32_t at = 0;; ++at) {
            const bool is_at_end = at == reached_.size();
            if (is_at_end && next_source == sources_.size()) return;
            const std::uint32_t depth = is_at_end ? sources_[next_source].depth : reached_[at].depth + 1;
            for (; next_source < sources_.size() && sources_[next_source].depth <= depth; ++next_source)
                add(sources_[next_source]);
            if (at == reached_.size()) {
                --at;
                continue;
            }
            for (const Explorer::Edge& edge : explorer_.edges_from(reached_[at].node))
                pass(Scan(*this, at, edge));
        }
    }

    /// After `all`: the first course to a node that `takes` the state it ends in; with what is excluded in
    /// view.
    template <class Takes>
    std::optional<std::vector<CourseScan>> course_to_node(Explorer::Node node, const Takes& takes) const {
        for (std::uint32_t at = 0; at < reached_.size(); ++at) {
            if (reached_[at].node == node && takes(reached_[at].state)) return course_to(at);
        }
        return std::nullopt;
    }

  private:
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};
    struct Reached {
        Explorer::Node node = 0;
        Memory memory = 0;
        std::uint32_t edge = kNone;    ///< to it
        std::uint32_t images = kNone;  ///< of that scan, if not all
        std::uint32_t depth = 0;
        std::uint32_t parent = kNone;
        Excluded::State state = 0;
        bool is_before = false;  ///< the state has not begun yet
        bool begins = false;     ///< the scan to it began the state
    };

    /// The scans before those that begin something are followed, too.
    template <class Pass>
    void all_but_excluded(const Pass& pass) {
        std::stable_sort(sources_.begin(), sources_.end(),
                         [](const Reached& a, const Reached& b) { return a.edge < b.edge; });
        if (!sources_.empty()) add({.is_before = true});
        for (std::uint32_t at = next_open(); at != kNone && !stopped_; at = next_open()) {
            const Reached here = reached_[at];
            for (const Explorer::Edge& edge : explorer_.edges_from(here.node)) {
                excluded_->count_work();
                if (excluded_->is_worn_out() || stopped_) return;
                const Excluded::State state = excluded_->next(here.state, edge);
                if (state == Excluded::kOut) continue;
                if (here.is_before) {
                    begin_after(at, edge, state);
                } else {
                    pass(Scan(*this, at, edge));
                }
            }
        }
    }
    void begin_after(std::uint32_t at, const Explorer::Edge& edge, Excluded::State state) {
        Reached then{.node = edge.to,
                     .edge = index_of(edge),
                     .depth = reached_[at].depth + 1,
                     .parent = at,
                     .state = state,
                     .is_before = true};
        add(then);
        auto source =
            std::lower_bound(sources_.begin(), sources_.end(), then.edge,
                             [](const Reached& of, std::uint32_t number) { return of.edge < number; });
        then.is_before = false;
        for (; source != sources_.end() && source->edge == then.edge; ++source) {
            then.memory = source->memory;
            then.images = source->images;
            add(then);
        }
    }

    std::uint32_t index_of(const Explorer::Edge& edge) const {
        return static_cast<std::uint32_t>(&edge - explorer_.edges().data());
    }
    std::uint32_t depth_after(const Explorer::Edge& edge) const { return explorer_.depth(edge.from) + 1; }
    std::uint32_t kept(const ImageSet& images) {
        images_.push_back(images);
        return static_cast<std::uint32_t>(images_.size() - 1);
    }

    void go_on(const Scan& scan, Memory memory, std::uint32_t images) {
        Reached then{.node = scan.edge.to,
                     .memory = memory,
                     .edge = index_of(scan.edge),
                     .images = images,
                     .depth = reached_[scan.at_].depth + 1,
                     .parent = scan.at_};
        if (excluded_ != nullptr) {
            then.begins = scan.memory == 0 && memory != 0;
            then.state = excluded_->next(reached_[scan.at_].state, scan.edge, then.begins);
            if (then.state == Excluded::kOut) return;
        }
        add(then);
    }

    void add(const Reached& place) {
        if (excluded_ != nullptr) {
            if (distances_ != nullptr) {
                add_open(place);
            } else if (places_.insert(key_of(place)).second) {
                reached_.push_back(place);
            }
            return;
        }
        if (knows(place.node, place.memory)) return;
        known_[place.node] |= std::uint64_t{1} << place.memory;
        reached_.push_back(place);
    }
    static std::uint64_t key_of(const Reached& place) {
        return place.node | std::uint64_t{place.memory} << 32U |
               (place.is_before ? std::uint64_t{1} << 38U : 0U) | std::uint64_t{place.state} << 39U;
    }
    void add_open(const Reached& place) {
        const std::uint32_t distance = (*distances_)[place.node];
        if (distance == kFar || places_.contains(key_of(place))) return;
        const std::size_t length = std::size_t{place.depth} + distance;
        if (length >= open_.size()) open_.resize(length + 1);
        open_[length].push_back(static_cast<std::uint32_t>(reached_.size()));
        reached_.push_back(place);
    }
    /// The next that is to be followed; kNone at the end.
    std::uint32_t next_open() {
        if (distances_ == nullptr) return next_ < reached_.size() ? next_++ : kNone;
        for (; next_ < open_.size(); ++next_) {
            while (!open_[next_].empty()) {
                const std::uint32_t at = open_[next_].back();
                open_[next_].pop_back();
                if (places_.insert(key_of(reached_[at])).second) return at;
            }
        }
        return kNone;
    }
    bool knows(Explorer::Node node, Memory memory) const { return ((known_[node] >> memory) & 1U) != 0; }

    std::vector<CourseScan> course_to(std::uint32_t at) const {
        std::vector<CourseScan> course;
        while (reached_[at].edge != kNone) {
            const Explorer::Edge& edge = explorer_.edges()[reached_[at].edge];
            const bool is_all = reached_[at].images == kNone;
            course.push_back(
                explorer_.scan_of(edge, is_all ? explorer_.images_of(edge) : images_[reached_[at].images]));
            course.back().begins = reached_[at].begins;
            if (reached_[at].parent == kNone) {
                std::vector<CourseScan> before = explorer_.course_to_node(edge.from);
                course.insert(course.end(), before.rbegin(), before.rend());
                break;
            }
            at = reached_[at].parent;
        }
        std::reverse(course.begin(), course.end());
        return course;
    }

    const Explorer& explorer_;
    Excluded* const excluded_;
    const std::vector<std::uint32_t>* const distances_;
    std::vector<std::vector<std::uint32_t>> open_;  ///< with distances: by the length of courses
    std::uint32_t next_ = 0;                        ///< with excluded courses: of `open_`, else of `reached_`
    bool stopped_ = false;
    std::unordered_set<std::uint64_t> places_;  ///< with what is excluded in view: those that were reached
    std::vector<std::uint64_t> known_;          ///< of each node what was remembered there, a bit each
    std::vector<Reached> reached_;
    std::vector<Reached> sources_;
    std::vector<ImageSet> images_;
};

}  // namespace nplc::verify
