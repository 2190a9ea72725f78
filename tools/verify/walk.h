#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "explorer.h"

namespace nplc::verify {

/// Follows courses, breadth first, with what is remembered of them: a number below 64. They begin at power-up
/// or with scans that make something to be remembered whatever was before them.
class Walk {
  public:
    using Memory = std::uint16_t;

    explicit Walk(const Explorer& explorer) : explorer_(explorer), known_(explorer.size()) {
        reached_.reserve(4 * explorer.size());
    }

    void begin_at_power_up(Memory memory) { add({.node = 0, .memory = memory}); }
    /// Scans are to be named in the order of edges.
    void begin_with(const Explorer::Edge& edge, Memory memory) {
        sources_.push_back(
            {.node = edge.to, .memory = memory, .edge = index_of(edge), .depth = depth_after(edge)});
    }
    void begin_with(const Explorer::Edge& edge, const ImageSet& images, Memory memory) {
        if (images.none()) return;
        begin_with(edge, memory);
        sources_.back().images = kept(images);
    }

    /// A scan that can follow what is remembered.
    class Scan {
      public:
        const Explorer::Edge& edge;
        Memory memory;
        ImageSet images() const { return walk_.explorer_.images_of(edge); }
        /// What is remembered after it, of all its images or of some.
        void go_on(Memory then) const { walk_.go_on(*this, then, kNone); }
        void go_on(const ImageSet& some, Memory then) const {
            if (some.any() && !walk_.knows(edge.to, then)) walk_.go_on(*this, then, walk_.kept(some));
        }
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

    /// `pass(scan)` is called for each scan that can follow what is remembered.
    template <class Pass>
    void all(const Pass& pass) {
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

  private:
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};
    struct Reached {
        Explorer::Node node = 0;
        Memory memory = 0;
        std::uint32_t edge = kNone;    ///< to it
        std::uint32_t images = kNone;  ///< of that scan, if not all
        std::uint32_t depth = 0;
        std::uint32_t parent = kNone;
    };

    std::uint32_t index_of(const Explorer::Edge& edge) const {
        return static_cast<std::uint32_t>(&edge - explorer_.edges().data());
    }
    std::uint32_t depth_after(const Explorer::Edge& edge) const { return explorer_.depth(edge.from) + 1; }
    std::uint32_t kept(const ImageSet& images) {
        images_.push_back(images);
        return static_cast<std::uint32_t>(images_.size() - 1);
    }

    void go_on(const Scan& scan, Memory memory, std::uint32_t images) {
        if (knows(scan.edge.to, memory)) return;
        add({.node = scan.edge.to,
             .memory = memory,
             .edge = index_of(scan.edge),
             .images = images,
             .depth = reached_[scan.at_].depth + 1,
             .parent = scan.at_});
    }

    void add(const Reached& place) {
        if (knows(place.node, place.memory)) return;
        known_[place.node] |= std::uint64_t{1} << place.memory;
        reached_.push_back(place);
    }
    bool knows(Explorer::Node node, Memory memory) const { return ((known_[node] >> memory) & 1U) != 0; }

    std::vector<CourseScan> course_to(std::uint32_t at) const {
        std::vector<CourseScan> course;
        while (reached_[at].edge != kNone) {
            const Explorer::Edge& edge = explorer_.edges()[reached_[at].edge];
            const bool is_all = reached_[at].images == kNone;
            course.push_back(
                explorer_.scan_of(edge, is_all ? explorer_.images_of(edge) : images_[reached_[at].images]));
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
    std::vector<std::uint64_t> known_;  ///< of each node what was remembered there, a bit each
    std::vector<Reached> reached_;
    std::vector<Reached> sources_;
    std::vector<ImageSet> images_;
};

}  // namespace nplc::verify
