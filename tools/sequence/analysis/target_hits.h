#pragma once

#include <bitset>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "place.h"

namespace nplc::verify {

/// A target scan: the images with which it ends in a view.
struct Target {
    const Condition* condition = nullptr;
    bool negated = false;
    const Condition* without = nullptr;  ///< and this is false
    const Condition* from = nullptr;     ///< only scans of which this holds count as outside of the target
    ImageSet images(const View& view) const {
        ImageSet set = images_where(*condition, view);
        if (negated) set.flip();
        if (without != nullptr) set &= ~images_where(*without, view);
        return set;
    }
};

/// A scan that was found, by the node in which it begins.
struct Hit {
    std::uint32_t node = ~std::uint32_t{0};  ///< that value: none was found
    const Group* group = nullptr;
    ImageSet images;
    bool found() const { return node != ~std::uint32_t{0}; }
};

/// The first scan of each target.
class TargetHits {
  public:
    void begin(const std::vector<Target>& targets, std::size_t groups) {
        targets_ = targets;
        hits_.assign(targets.size(), {});
        judged_.assign(groups, {});
    }
    const Hit& operator[](std::size_t target) const { return hits_[target]; }

    /// A scan of a group with the images that are allowed `here`, the place of the node; `view` is after it.
    void judge(std::uint32_t node, const Place& here, const Group& group, const View& view,
               const ImageSet& allowed) {
        if (targets_.empty()) return;
        auto seen = judged_[group.number][surroundings_of(here, group, view)];
        if (seen) return;
        seen = true;
        for (const Wanted& wanted : wanted_in(view)) {
            if (hits_[wanted.target].found()) continue;
            const ImageSet images = wanted.images & group.images & allowed;
            if (images.any()) hits_[wanted.target] = {node, &group, images};
        }
    }

  private:
    /// Images of a view that belong to a target.
    struct Wanted {
        std::size_t target = 0;
        ImageSet images;
    };
    const std::vector<Wanted>& wanted_in(const View& view) {
        const std::uint32_t key = view.step | (std::uint32_t{view.outputs} << 6U) |
                                  (view.timer_zero ? 1U << 10U : 0U) | (view.counter_zero ? 1U << 11U : 0U) |
                                  (view.moving ? 1U << 12U : 0U);
        const auto [found, is_new] = wanted_.try_emplace(key);
        if (!is_new) return found->second;
        for (std::size_t target = 0; target < targets_.size(); ++target) {
            const ImageSet images = targets_[target].images(view);
            if (images.any()) found->second.push_back({target, images});
        }
        return found->second;
    }

    std::vector<Target> targets_;
    std::vector<Hit> hits_;
    std::vector<std::bitset<kSurroundings>> judged_;  ///< by group: the surroundings that were judged
    std::unordered_map<std::uint32_t, std::vector<Wanted>> wanted_;  ///< by view
};

}  // namespace nplc::verify
