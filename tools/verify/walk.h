#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "explorer.h"

namespace nplc::verify {

/// Follows courses, breadth first, with what is remembered of them: a number.
class Walk {
  public:
    explicit Walk(const Explorer& explorer, std::uint16_t memory = 0)
        : explorer_(explorer), first_memory_(memory), last_(explorer.size(), kStart) {}

    /// `pass(edge, images, memory, go_on, show)` is called for each scan that can follow what is remembered.
    /// It calls `go_on(images, memory)` for what is remembered after it, and `show(images)` for a scan that
    /// is looked for, which hands out the course to it.
    template <class Pass>
    void all(const Pass& pass) {
        add(0, first_memory_, kStart, nullptr, {});
        for (std::size_t at = 0; at < places_.size(); ++at) {
            const Explorer::Node node = places_[at].node;
            const ImageSet allowed = explorer_.allowed(explorer_.place(node));
            for (const Explorer::Edge& edge : explorer_.edges_from(node)) {
                pass(
                    edge, explorer_.images_of(edge, allowed), places_[at].memory,
                    [&](const ImageSet& images, std::uint16_t memory) {
                        if (images.any()) add(edge.to, memory, at, &edge, images);
                    },
                    [&](const ImageSet& images) {
                        std::vector<CourseScan> course = course_to(at);
                        course.push_back(explorer_.scan_of(edge, images));
                        return course;
                    });
            }
        }
    }

  private:
    static constexpr std::size_t kStart = ~std::size_t{0};
    struct Reached {
        Explorer::Node node = 0;
        std::uint16_t memory = 0;
        std::size_t parent = kStart;
        std::size_t same_node = kStart;  ///< one before, with another memory
        const Explorer::Edge* edge = nullptr;
        ImageSet images;
    };

    void add(Explorer::Node node, std::uint16_t memory, std::size_t parent, const Explorer::Edge* edge,
             const ImageSet& images) {
        for (std::size_t at = last_[node]; at != kStart; at = places_[at].same_node) {
            if (places_[at].memory == memory) return;
        }
        places_.push_back({node, memory, parent, last_[node], edge, images});
        last_[node] = places_.size() - 1;
    }

    std::vector<CourseScan> course_to(std::size_t at) const {
        std::vector<CourseScan> course;
        for (; places_[at].parent != kStart; at = places_[at].parent)
            course.push_back(explorer_.scan_of(*places_[at].edge, places_[at].images));
        std::reverse(course.begin(), course.end());
        return course;
    }

    const Explorer& explorer_;
    std::uint16_t first_memory_;
    std::vector<std::size_t> last_;  ///< of the places, by node
    std::vector<Reached> places_;
};

}  // namespace nplc::verify
