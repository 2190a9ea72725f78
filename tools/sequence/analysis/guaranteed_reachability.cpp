#include "guaranteed_reachability.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
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

/// With every level of the inputs in `free`.
Levels with_free(Levels levels, std::uint8_t free) {
    constexpr std::array<Levels, 6> kOn = {0xAAAAAAAAAAAAAAAA, 0xCCCCCCCCCCCCCCCC, 0xF0F0F0F0F0F0F0F0,
                                           0xFF00FF00FF00FF00, 0xFFFF0000FFFF0000, 0xFFFFFFFF00000000};
    for (unsigned input = 0; input < kOn.size(); ++input) {
        if (((unsigned{free} >> input) & 1U) == 0) continue;
        const unsigned apart = 1U << input;
        levels |= ((levels & kOn[input]) >> apart) | ((levels & ~kOn[input]) << apart);
    }
    return levels;
}

/// How long the inputs have kept their levels: not at all, 2 ms, as long as the debounce time, as long as any
/// input must.
constexpr std::size_t kAges = 4;
constexpr std::size_t kSteady = 2;
constexpr std::size_t kLong = 3;
constexpr std::uint32_t kSteadyMs = 3;

/// A kind of scan, wherever it begins.
struct ScanKind {
    Levels levels = 0;  ///< with which it can be made
    Levels hits = 0;
    Levels wanted = 0;  ///< scans outside of the target that can be
    bool error = false;
    bool sends = false;
    std::uint32_t least = 0;   ///< time of the orders
    std::uint32_t preset = 0;  ///< of the timer, the least
    std::uint32_t preset_most = 0;
};

/// The start of the next scan, with the timer running or not.
struct Landing {
    Explorer::Node running = Explorer::kNone;
    Explorer::Node zero = Explorer::kNone;
};

struct Choice {
    std::uint32_t kind = 0;
    std::uint32_t group = 0;
    bool idle = false;
    bool unsure = false;  ///< it may be too late: a move may have ended by then
    Landing landing{};
    std::uint32_t others = 0;  ///< the first of the further counts of a range, and 1; 0 for none
};

/// The same with another count of the counter's range.
struct OtherCount {
    Landing landing{};
    std::uint32_t next = 0;
};

class Search {
  public:
    Search(const Explorer& ways, const Target& target, std::uint8_t held)
        : ways_(ways),
          target_(target),
          held_(held),
          kind_numbers_(2 * kSurroundings * ways.machine().all_groups().size()),
          can_(ways.size()) {
        choices_.reserve(ways.edges().size());
        for (Explorer::Node node = 0; node < ways.size(); ++node) {
            first_choice_.push_back(choices_.size());
            add_choices(node);
        }
        first_choice_.push_back(choices_.size());
    }

    /// Courses can begin with levels other than those at power-up.
    bool can_from_power_up() {
        while (sweep()) {
        }
        return can_[0][oldest()] != 0;
    }

    bool all_can(const ScanKeys* only) {
        while (sweep()) {
        }
        for (Explorer::Node node = 0; node < ways_.size(); ++node) {
            for (std::size_t i = first_choice_[node]; i < first_choice_[node + 1]; ++i) {
                const Choice& choice = choices_[i];
                if (only != nullptr && !only->contains(scan_key(ways_.place(node), choice.group))) continue;
                if ((kinds_[choice.kind].wanted & ~after(choice, 0)) != 0) return false;
            }
        }
        return true;
    }

  private:
    /// Edges of a group stand together; those of a lost link are a choice of their own.
    void add_choices(Explorer::Node node) {
        const Place& here = ways_.place(node);
        const Explorer::Edge* before = nullptr;
        std::array<std::size_t, 2> open{};
        std::array<std::uint16_t, 2> counter{};
        for (const Explorer::Edge& edge : ways_.edges_from(node)) {
            const Place& to = ways_.place(edge.to);
            if (to.motor == Place::Motor::cut) continue;
            if (before == nullptr || before->group != edge.group) open = {kNone, kNone};
            before = &edge;
            const bool lost = to.motor == Place::Motor::lost;
            std::size_t& choice = open[lost ? 1 : 0];
            const bool is_other = choice != kNone && counter[lost ? 1 : 0] != to.counter;
            counter[lost ? 1 : 0] = to.counter;
            if (choice == kNone) {
                choice = choices_.size();
                const Group& group = ways_.group_of(edge);
                const bool sees_no_end = is_timed(here.motion) && !group.in_pos && !group.disturbs;
                choices_.push_back({.kind = kind_of(here, group, lost),
                                    .group = edge.group,
                                    .idle = ways_.is_idle(here, group),
                                    .unsure = sees_no_end && ways_.machine().move_ms() != 0});
            }
            if (is_other) {
                others_.push_back({.landing = {}, .next = choices_[choice].others});
                choices_[choice].others = static_cast<std::uint32_t>(others_.size());
            }
            Landing& landing =
                choices_[choice].others != 0 ? others_.back().landing : choices_[choice].landing;
            (to.runs ? landing.running : landing.zero) = edge.to;
        }
    }

    std::uint32_t kind_of(const Place& here, const Group& group, bool lost) {
        const View view = ways_.view_after(here, group);
        const std::size_t surroundings = surroundings_of(here, group, view);
        std::uint32_t& number =
            kind_numbers_[2 * (group.number * kSurroundings + surroundings) + (lost ? 1U : 0U)];
        if (number != 0) return number - 1;
        const ImageSet images = group.images & ways_.allowed(here);
        const ImageSet hits = images & target_.images(view);
        ImageSet other = images & ~hits;
        if (target_.from != nullptr) other &= images_where(*target_.from, view);
        const PresetRange times = ways_.machine().times_of(group.outcome.timer);
        kinds_.push_back({.levels = levels_of(images, lost),
                          .hits = levels_of(hits, lost),
                          .wanted = levels_of(other, lost),
                          .error = group.error,
                          .sends = group.outcome.sends(),
                          .least = group.delay.least,
                          .preset = times.least,
                          .preset_most = times.most});
        number = static_cast<std::uint32_t>(kinds_.size());
        return number - 1;
    }

    Levels can(Explorer::Node node, std::size_t age) const {
        return node == Explorer::kNone ? 0 : can_[node][age];
    }

    /// The levels, kept since `age`, from which the target can be reached after the scan, whatever count a
    /// range has.
    Levels after(const Choice& choice, std::size_t age) const {
        const ScanKind& c = kinds_[choice.kind];
        Levels levels = after(c, choice.idle, choice.landing, age);
        for (std::uint32_t other = choice.others; other != 0 && levels != 0; other = others_[other - 1].next)
            levels &= after(c, choice.idle, others_[other - 1].landing, age);
        return levels;
    }

    Levels after(const ScanKind& c, bool idle, const Landing& landing, std::size_t age) const {
        if (idle) return can(landing.zero, oldest());
        const bool runs = landing.running != Explorer::kNone;
        const auto later = [&](std::uint32_t delay, std::size_t then, bool sure) {
            if (!runs) return can(landing.zero, then);
            if (sure && c.preset > delay) return can(landing.running, then);
            if (sure && c.preset != 0 && c.preset_most <= delay) return can(landing.zero, then);
            if (sure && c.preset != 0) return can(landing.running, then) & can(landing.zero, then);
            if (sure && delay == 0) return can(landing.running, then);
            return can(landing.running, then) & can(landing.zero, then);
        };
        if (c.sends) {
            if (c.error) return later(c.least, age, c.preset > c.least);
            const std::size_t then = c.least >= kSteadyMs ? std::max(age, kSteady)
                                     : c.least >= 2       ? next_age(age)
                                                          : age;
            return later(c.least, then, true);
        }
        return later(0, age, true) | later(Machine::kMostIdle, next_age(age), true);
    }

    static std::size_t next_age(std::size_t age) { return age < kSteady ? age + 1 : age; }

    std::size_t oldest() const { return held_ == 0 ? kSteady : kLong; }

    /// The inputs that may change then.
    std::uint8_t free_at(std::size_t age) const {
        if (age < kSteady) return 0;
        return static_cast<std::uint8_t>(sequencer::kInputsMask & (age == kLong ? 0xFFU : ~unsigned{held_}));
    }

    bool sweep() {
        bool changed = false;
        for (std::size_t node = can_.size(); node-- > 0;) {
            const auto own = std::span(choices_).subspan(first_choice_[node],
                                                         first_choice_[node + 1] - first_choice_[node]);
            for (std::size_t age = 0; age <= oldest(); ++age) {
                Levels levels = can_[node][age];
                if (levels == kAll) continue;
                for (const Choice& choice : own) {
                    if (choice.unsure) continue;
                    const ScanKind& kind = kinds_[choice.kind];
                    levels |= kind.hits | (kind.levels & after(choice, age));
                    const std::uint8_t free = free_at(age);
                    if (free != 0) levels |= with_free(kind.hits | (kind.levels & after(choice, 0)), free);
                    if (levels == kAll) break;
                }
                if (levels == can_[node][age]) continue;
                can_[node][age] = levels;
                changed = true;
            }
        }
        return changed;
    }

    static constexpr std::size_t kNone = ~std::size_t{0};

    const Explorer& ways_;
    const Target& target_;
    std::uint8_t held_;
    std::vector<std::uint32_t> kind_numbers_;  ///< and 1, by group, surroundings and lost; 0 for none yet
    std::vector<ScanKind> kinds_;
    std::vector<Choice> choices_;
    std::vector<OtherCount> others_;
    std::vector<std::size_t> first_choice_;  ///< by node, and the end
    std::vector<std::array<Levels, kAges>> can_;
};

}  // namespace

bool surely_possible(const Explorer& ways, const Target& target, std::uint8_t held, const ScanKeys* only) {
    return Search(ways, target, held).all_can(only);
}

bool surely_reached(const Explorer& ways, const Target& target, std::uint8_t held) {
    return Search(ways, target, held).can_from_power_up();
}

}  // namespace nplc::verify
