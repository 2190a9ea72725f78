#include "surely.h"

#include <array>
#include <cstdint>
#include <vector>

namespace nplc::verify {
namespace {

/// A set of levels of the six inputs.
using Levels = std::uint64_t;
constexpr Levels kAll = ~Levels{0};

Levels levels_of(const ImageSet& images, bool lost) {
    Levels levels = 0;
    for (unsigned image = 0; image < 256; ++image) {
        if (!images[image]) continue;
        if (lost && (image & sequencer::kInPos) != 0) continue;
        levels |= Levels{1} << (image & sequencer::kInputsMask);
    }
    return levels;
}

/// How long the inputs have kept their levels: not at all, 2 ms, as long as the debounce time.
constexpr std::size_t kAges = 3;
constexpr std::size_t kSteady = 2;
constexpr std::uint32_t kSteadyMs = 3;

struct Choice {
    Levels levels = 0;  ///< with which it can be made
    Levels hits = 0;
    bool idle = false;
    bool error = false;
    bool sends = false;
    std::uint32_t least = 0;   ///< time of the orders
    std::uint32_t preset = 0;  ///< of the timer
    Explorer::Node running = Explorer::kNone;
    Explorer::Node zero = Explorer::kNone;
    Levels wanted = 0;  ///< scans outside of the target that can be
};

class Search {
  public:
    Search(const Explorer& ways, const Target& target) : can_(ways.size()) {
        choices_.reserve(ways.size());
        for (Explorer::Node node = 0; node < ways.size(); ++node) {
            std::vector<Choice>& own = choices_.emplace_back();
            for (const auto& option : ways.options(node, target)) {
                for (const auto& next : option.next) own.push_back(choice_of(option, next));
            }
        }
    }

    bool all_can() {
        while (sweep()) {
        }
        for (const auto& own : choices_) {
            for (const Choice& choice : own) {
                if ((choice.wanted & ~after(choice, 0)) != 0) return false;
            }
        }
        return true;
    }

  private:
    static Choice choice_of(const Explorer::Option& option, const Explorer::Option::Next& next) {
        const unsigned first = static_cast<unsigned>(option.images._Find_first());
        return {.levels = levels_of(option.images, next.lost),
                .hits = levels_of(option.hits, next.lost),
                .idle = option.idle,
                .error = (first & sequencer::kError) != 0,
                .sends = option.group->sends,
                .least = option.group->delay.least,
                .preset = option.group->pending.timer_preset,
                .running = next.running,
                .zero = next.zero,
                .wanted = levels_of(option.other, next.lost)};
    }

    Levels can(Explorer::Node node, std::size_t age) const {
        return node == Explorer::kNone ? 0 : can_[node][age];
    }

    /// The levels, kept since `age`, from which the target can be reached after the scan.
    Levels after(const Choice& c, std::size_t age) const {
        if (c.idle) return can(c.zero, kSteady);
        const bool runs = c.running != Explorer::kNone;
        const auto later = [&](std::uint32_t delay, std::size_t then, bool sure) {
            if (!runs) return can(c.zero, then);
            if (sure && c.preset > delay) return can(c.running, then);
            if (sure && c.preset != 0) return can(c.zero, then);
            if (sure && delay == 0) return can(c.running, then);
            return can(c.running, then) & can(c.zero, then);
        };
        if (c.sends) {
            if (c.error) return later(c.least, age, c.preset > c.least);
            const std::size_t then = c.least >= kSteadyMs ? kSteady : c.least >= 2 ? next_age(age) : age;
            return later(c.least, then, true);
        }
        return later(0, age, true) | later(Machine::kMostIdle, next_age(age), true);
    }

    static std::size_t next_age(std::size_t age) { return age < kSteady ? age + 1 : kSteady; }

    bool sweep() {
        bool changed = false;
        for (std::size_t node = choices_.size(); node-- > 0;) {
            for (std::size_t age = 0; age < kAges; ++age) {
                Levels levels = can_[node][age];
                for (const Choice& choice : choices_[node]) {
                    levels |= choice.hits | (choice.levels & after(choice, age));
                    const bool free = age == kSteady;
                    if (free && (choice.hits != 0 || (choice.levels & after(choice, 0)) != 0)) levels = kAll;
                    if (levels == kAll) break;
                }
                if (levels == can_[node][age]) continue;
                can_[node][age] = levels;
                changed = true;
            }
        }
        return changed;
    }

    std::vector<std::vector<Choice>> choices_;
    std::vector<std::array<Levels, kAges>> can_;
};

}  // namespace

bool surely_possible(const Explorer& ways, const Target& target) {
    return Search(ways, target).all_can();
}

}  // namespace nplc::verify
