#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "analysis/machine.h"
#include "motor_orders.h"
#include "zone.h"

namespace nplc::verify {

/// The start of a scan: the table's state with the timer running or not, and the possible motor states.
struct Place {
    enum class Motor : std::uint8_t {
        free,
        error,
        lost,
        cut,  ///< driver: this scan sees an ERROR that cut the orders before it short
    };

    std::uint8_t step = 0;
    std::uint8_t outputs = 0;
    bool runs = false;  ///< the timer
    Motor motor = Motor::free;
    bool pending = false;          ///< a deadline runs
    Motion motion = Motion::none;  ///< if the machine models motion
    std::uint16_t counter = 0;

    /// Without the counter; below 1 << kPlainBits if there is no deadline and no motion is tracked.
    std::uint32_t packed_plain() const {
        return step | (unsigned{outputs} << 6U) | (runs ? 1U << 10U : 0U) |
               (static_cast<unsigned>(motor) << 11U) | (pending ? 1U << 13U : 0U) |
               (static_cast<unsigned>(motion) << 14U);
    }
    static constexpr unsigned kPlainBits = 13;
    std::uint64_t packed() const { return packed_plain() | (std::uint64_t{counter} << 18U); }
};

/// A scan of a course: its start, its actions, and the images that can cause it.
struct CourseScan {
    Place place;
    const Group* group = nullptr;
    ImageSet images;
    View view;                  ///< after it
    std::uint16_t counter = 0;  ///< after it
    Bounds delay;               ///< to the next scan
    bool idle = false;          ///< no effect: it may be repeated with the same image
    bool next_runs = false;     ///< the timer, when the next scan begins
    bool begins = false;        ///< a deadline, with this scan
};

inline const ImageSet& images_of_error() {
    return images_with_bit(7);
}
inline ImageSet images_of_lost_link() {
    return images_with_bit(7) & ~images_with_bit(6);
}

class Explorer;

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

struct Precision {
    bool times_timer = false;      ///< else it may end at any time
    bool knows_lost_link = false;  ///< else a lost link is any ERROR
    bool keeps_edges = false;      ///< for ways back and courses
    /// While a scan reads ERROR a lost link may be restored; the gateway then stops the motor before it
    /// scans. False excludes courses, so that no proof is possible.
    bool waits_for_line = true;
    const Property* deadline = nullptr;  ///< a WHENEVER or a NEVER .. WHILE to be broken
    std::size_t most_states = 2'000'000;
    /// Limits the exploration to nodes from which the first target can be reached, nearest first: an
    /// exploration without times, and for each of its nodes the number of scans to the end of such a scan.
    const Explorer* guide = nullptr;
    const std::vector<std::uint32_t>* distances = nullptr;
};

struct FreeMemory {
    void operator()(void* memory) const { std::free(memory); }
};

/// Breadth-first exploration of all reachable states, within the bound.
class Explorer {
  public:
    using Node = std::uint32_t;
    static constexpr Node kNone = ~Node{0};

    Explorer(const Machine& machine, const Precision& precision);

    void explore(const std::vector<Target>& targets);

    bool complete() const { return complete_; }
    std::size_t size() const { return places_.size(); }
    const Place& place(Node node) const { return places_[node]; }
    /// The minimum number of scans to reach it.
    std::uint32_t depth(Node node) const { return depths_[node]; }
    const Machine& machine() const { return machine_; }
    std::uint64_t steps_begun() const { return steps_begun_; }

    /// The shortest course to a target, or to a missed deadline; empty if there is none.
    std::vector<CourseScan> course_to(std::size_t target) const;
    std::vector<CourseScan> course_to_missed_deadline() const;
    bool hit(std::size_t target) const { return hits_[target].node != kNone; }
    bool missed_deadline() const { return missed_.node != kNone; }
    /// Missed by the end of the last scan, else by the next one.
    bool missed_at_end() const { return missed_at_end_; }
    /// The scans before the one that begins in `node`.
    std::vector<CourseScan> course_to_node(Node node) const;

    /// A transition by a scan. Those of one node are consecutive, in the order of nodes.
    struct Edge {
        Node from = kNone;
        Node to = kNone;
        std::uint32_t group = 0;  ///< its number
    };
    bool has_all_edges() const { return complete_ && has_all_edges_; }
    const std::vector<Edge>& edges() const { return edges_; }
    std::span<const Edge> edges_from(Node node) const {
        return std::span(edges_).subspan(first_edge_[node], first_edge_[node + 1] - first_edge_[node]);
    }
    const Group& group_of(const Edge& edge) const { return machine_.group(edge.group); }
    /// The first node from which a scan of a group was found; kNone if there is none.
    Node first_use(const Group& group) const { return first_uses_[group.number]; }
    /// That scan.
    const Edge& first_edge_with(const Group& group) const;
    View view_after(const Place& place, const Group& group) const { return view_of(landing(place, group)); }
    static View view_of(const Place& place) {
        return {place.step, place.outputs, !place.runs, place.counter == 0, is_moving(place.motion)};
    }
    /// The images with which a scan that begins there is possible.
    ImageSet allowed(const Place& place) const { return allowed_[static_cast<std::size_t>(place.motor)]; }
    /// The images with which the scan of an edge is possible.
    ImageSet images_of(const Edge& edge) const { return images_of(edge, allowed(place(edge.from))); }
    ImageSet images_of(const Edge& edge, const ImageSet& allowed_there) const {
        return narrowed(group_of(edge).images & allowed_there, place(edge.to));
    }
    CourseScan scan_of(const Edge& edge, const ImageSet& images) const;
    /// For each node, the minimum number of scans to the end of one of `target`; kFar if unreachable. Needs
    /// all edges.
    std::vector<std::uint32_t> distances_to(const Target& target);
    static constexpr std::uint32_t kFar = ~std::uint32_t{0};

    /// All that decides whether a scan of a group is of a target, below kSurroundings.
    static std::size_t surroundings_of(const Place& here, const Group& group, const View& view) {
        return (group.outcome.outputs ? 0U : here.outputs) | (view.timer_zero ? 16U : 0U) |
               (view.counter_zero ? 32U : 0U) | (static_cast<unsigned>(here.motor) << 6U) |
               (view.moving ? 256U : 0U);
    }
    static constexpr std::size_t kSurroundings = 512;
    /// It has no effect.
    bool is_idle(const Place& place, const Group& group) const;

    struct Stuck {
        Node node = kNone;
        const Group* group = nullptr;
        ImageSet images;
        std::uint16_t counter = 0;  ///< after it
    };
    /// Scans by place and group, without their times.
    using Scans = std::unordered_set<std::uint64_t>;
    static std::uint64_t scan_key(const Place& place, std::uint32_t group) {
        return place.packed() << 30U | group;
    }
    Scans scans() const;
    /// The first scan outside of `target` that cannot lead to it, by the `distances`; only among `only`, if
    /// given.
    Stuck first_stuck(const Target& target, const std::vector<std::uint32_t>& distances,
                      const Scans* only = nullptr) const;
    std::vector<CourseScan> course_to(const Stuck& stuck) const;
    /// The same scan here as of another exploration.
    Stuck same_scan(const Place& place, const Stuck& stuck) const;

  private:
    struct Hit {
        Node node = kNone;
        const Group* group = nullptr;
        ImageSet images;
    };
    struct Origin {
        Node parent = kNone;
        std::uint32_t group = 0;
        std::uint8_t part = 0;  ///< of the images: which of what the deadline distinguishes
    };
    /// The scan's images by what they do to the deadline.
    struct Part {
        ImageSet images;
        bool begins = false;
        bool pending = false;
    };

    /// Images of a view that belong to a target.
    struct Wanted {
        std::size_t target = 0;
        ImageSet images;
    };

    Place after(const Place& place, const Group& group) const;
    Motion motion_of(const Place& place, const Group& group) const;
    bool keeps_too_long(const Place& place, const Zone& zone, const Group& group, const View& view,
                        const ImageSet& images) const;
    std::array<Part, 2> parts(const Place& place, const View& view, const ImageSet& images) const;
    /// Whether the scan after this motor state may be delayed until a lost link is detected.
    bool may_wait_for_line(Place::Motor motor) const;
    /// Between repeated scans.
    std::int32_t most_idle(Place::Motor motor) const;
    Bounds delay_of(const Place& place, const Group& group, const Place& next) const;
    bool ends_late(const Zone& zone, const Group& group) const;
    ImageSet narrowed(const ImageSet& images, const Place& next) const;
    void find_next_motors();
    void reserve();
    /// The limit of work on times is reached: the exploration is incomplete.
    bool is_worn_out();
    Place landing(const Place& here, const Group& group) const;
    std::vector<Node> nodes_before(const Target& target) const;
    void find_edges_back();
    bool is_covered(const Place& place, const Bounds& passed);
    void explore_guided(const std::vector<Target>& targets);
    std::uint32_t distance(const Place& place) const;
    void visit_plain(Node node, const std::vector<Target>& targets);
    void visit(Node node, const std::vector<Target>& targets);
    void note_missed(const Place& here, const Zone& zone, Node node, const Group& group, const View& view,
                     const std::array<Part, 2>& split, const ImageSet& images);
    void judge(Node node, const Group& group, const View& view, const std::vector<Target>& targets);
    const std::vector<Wanted>& wanted_in(const View& view, const std::vector<Target>& targets);
    /// Calls `each(place, zone)` for each place where the next scan may begin.
    /// Calls `each` for every count that a range of counts stands for, where scans count down.
    template <class Each>
    void each_count(Place to, const Each& each) const {
        const PresetRange* const range =
            machine_.counts_down_in(to.step) ? machine_.counts_of(to.counter) : nullptr;
        if (range == nullptr) return each(to);
        for (std::uint32_t count = range->least; count <= range->most; ++count) {
            to.counter = static_cast<std::uint16_t>(count);
            each(to);
        }
    }
    template <class Each>
    void successors(const Place& place, const Zone& zone, const Group& group, const Part& part, Each&& each,
                    bool& misses) const;
    Node find(const Place& place, const Zone& zone) const;
    void add(const Place& place, const Zone& zone, const Origin& origin);
    CourseScan scan_of(const Place& place, const Group& group, const ImageSet& images) const;
    Node& slot(const Place& place);
    Node slot_value(const Place& place) const;
    std::size_t dense_index(const Place& place) const {
        return std::size_t{place.packed_plain()} * (machine_.greatest_counter() + std::size_t{1}) +
               place.counter;
    }
    std::int32_t longest_move() const { return static_cast<std::int32_t>(machine_.move_ms()); }
    bool is_hold() const {
        return precision_.deadline != nullptr && precision_.deadline->form == Form::never_while;
    }

    const Machine& machine_;
    Precision precision_;
    std::array<ImageSet, 4> allowed_;  ///< by what the motor is
    std::vector<Place> places_;
    std::vector<Origin> origins_;
    std::vector<std::uint32_t> depths_;
    std::vector<Zone> zones_;                    ///< only if they count
    std::vector<Node> same_place_;               ///< the node before it with the same place
    std::unique_ptr<Node[], FreeMemory> dense_;  ///< node + 1, by place; 0 for none
    std::unordered_map<std::uint64_t, Node> sparse_;
    std::vector<Edge> edges_;
    std::vector<std::uint32_t> first_edge_;  ///< by node, and the end
    std::vector<std::uint32_t> first_back_;  ///< by node, and the end; once they are asked for
    std::vector<Node> back_;                 ///< from where an edge leads to it
    /// With a deadline and a stopped timer: the times that can have passed at a place, as disjoint ranges.
    std::unordered_map<std::uint64_t, std::vector<Bounds>> covered_;
    mutable std::uint64_t work_ = 0;       ///< with zones
    std::vector<std::vector<Node>> open_;  ///< guided: by the length of the shortest course through them
    bool has_all_edges_ = true;
    /// By group and state of the motor: the possible next states of the motor, as bits.
    std::vector<std::array<std::uint8_t, 4>> next_motors_;
    std::vector<Node> first_uses_;  ///< by group
    std::vector<Hit> hits_;
    Hit missed_;
    bool missed_at_end_ = false;
    std::vector<std::bitset<kSurroundings>> judged_;  ///< by group: the surroundings that were judged
    std::unordered_map<std::uint32_t, std::vector<Wanted>> wanted_;  ///< by view
    std::uint64_t steps_begun_ = 0;
    bool complete_ = true;
    bool uses_zones_ = false;
    bool times_moves_ = false;
};

}  // namespace nplc::verify
