#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "motor_orders.h"
#include "verify/machine.h"
#include "zone.h"

namespace nplc::verify {

/// Where a scan begins: the table's state with the timer running or not, and what the motor may do.
struct Place {
    enum class Motor : std::uint8_t { free, error, lost };

    std::uint8_t step = 0;
    std::uint8_t outputs = 0;
    bool runs = false;  ///< the timer
    Motor motor = Motor::free;
    bool error_comes = false;  ///< driver: this scan sees an ERROR that cut the orders before it short
    bool pending = false;      ///< a deadline runs
    std::uint16_t counter = 0;
    Motion motion = Motion::none;  ///< if the machine tells it

    std::uint64_t packed() const {
        return step | (outputs << 6U) | (runs ? 1U << 10U : 0U) | (static_cast<unsigned>(motor) << 11U) |
               (error_comes ? 1U << 13U : 0U) | (pending ? 1U << 14U : 0U) | (std::uint64_t{counter} << 15U) |
               (static_cast<std::uint64_t>(motion) << 31U);
    }
    static Place unpacked(std::uint64_t bits) {
        return {.step = static_cast<std::uint8_t>(bits & 0x3F),
                .outputs = static_cast<std::uint8_t>((bits >> 6U) & 0x0F),
                .runs = ((bits >> 10U) & 1U) != 0,
                .motor = static_cast<Motor>((bits >> 11U) & 3U),
                .error_comes = ((bits >> 13U) & 1U) != 0,
                .pending = ((bits >> 14U) & 1U) != 0,
                .counter = static_cast<std::uint16_t>(bits >> 15U),
                .motion = static_cast<Motion>(bits >> 31U)};
    }
};

/// A scan of a course: where it began, what it did, and the images with which it can have done so.
struct CourseScan {
    Place place;
    const Group* group = nullptr;
    ImageSet images;
    View view;          ///< after it
    Bounds delay;       ///< to the next scan
    bool idle = false;  ///< it did nothing: it may be repeated with the same image
};

/// A wanted scan: images with which it ends in a view.
struct Target {
    const Condition* condition = nullptr;
    bool negated = false;
    const Condition* without = nullptr;  ///< and this does not hold
    const Condition* from = nullptr;     ///< only scans of which this holds count as outside of the target
    ImageSet images(const View& view) const {
        ImageSet set = images_where(*condition, view);
        if (negated) set.flip();
        if (without != nullptr) set &= ~images_where(*without, view);
        return set;
    }
};

struct Precision {
    bool times_timer = false;            ///< else it may end at any time
    bool knows_lost_link = false;        ///< else a lost link is any ERROR
    bool keeps_edges = false;            ///< for ways back and courses
    const Property* deadline = nullptr;  ///< a WHENEVER or a NEVER .. WHILE to be broken
    std::size_t most_states = 4'000'000;
};

/// Explores breadth first all that can be reached, within the bound.
class Explorer {
  public:
    using Node = std::uint32_t;
    static constexpr Node kNone = ~Node{0};

    Explorer(const Machine& machine, const Precision& precision) : machine_(machine), precision_(precision) {}

    void explore(const std::vector<Target>& targets);

    bool complete() const { return complete_; }
    std::size_t size() const { return places_.size(); }
    Place place(Node node) const { return Place::unpacked(places_[node]); }
    const Machine& machine() const { return machine_; }
    std::uint64_t steps_begun() const { return steps_begun_; }

    /// The first way to hit a target, or to miss the deadline; empty if there is none.
    std::vector<CourseScan> course_to(std::size_t target) const;
    std::vector<CourseScan> course_to_missed_deadline() const;
    bool hit(std::size_t target) const { return hits_[target].node != kNone; }
    bool missed_deadline() const { return missed_.node != kNone; }
    /// It is missed by the last scan's end, else by the next one.
    bool missed_at_end() const { return missed_at_end_; }
    /// The scans before the one that begins in `node`.
    std::vector<CourseScan> course_to_node(Node node) const;

    /// A scan that leads from one place to another. Those of one node stand together, in the order of nodes.
    struct Edge {
        Node from = kNone;
        Node to = kNone;
        std::uint16_t group = 0;
    };
    bool has_all_edges() const { return complete_ && has_all_edges_; }
    const std::vector<Edge>& edges() const { return edges_; }
    std::span<const Edge> edges_from(Node node) const {
        return std::span(edges_).subspan(first_edge_[node], first_edge_[node + 1] - first_edge_[node]);
    }
    const Group& group_of(const Edge& edge) const {
        const Place from = place(edge.from);
        return machine_.groups(from.step, !from.runs, from.counter == 0)[edge.group];
    }
    View view_after(const Place& place, const Group& group) const;
    static View view_of(const Place& place) {
        return {place.step, place.outputs, !place.runs, place.counter == 0, place.motion != Motion::none};
    }
    /// With which a scan that begins there can be.
    ImageSet allowed(const Place& place) const;
    /// With which the scan of an edge can be.
    ImageSet images_of(const Edge& edge) const { return images_of(edge, allowed(place(edge.from))); }
    ImageSet images_of(const Edge& edge, const ImageSet& allowed_there) const {
        return narrowed(group_of(edge).images & allowed_there, place(edge.to));
    }
    CourseScan scan_of(const Edge& edge, const ImageSet& images) const;
    /// Whether a scan that begins in `node` can be of `target`.
    bool can_hit_from(Node node, const Target& target) const;

    /// What a scan that begins in a node can be, for questions of what is surely possible.
    struct Option {
        const Group* group = nullptr;
        ImageSet images;
        ImageSet hits;   ///< of them, those of the target
        ImageSet other;  ///< and those from which it must be possible
        bool idle = false;
        /// Where the next scan begins, with the timer running and at 0; kNone where that cannot be.
        struct Next {
            Node running = kNone;
            Node zero = kNone;
            bool lost = false;
        };
        std::vector<Next> next;  ///< by what ERROR is: of the motor, or of a lost link
    };
    std::vector<Option> options(Node node, const Target& target) const;

    struct Stuck {
        Node node = kNone;
        std::size_t group = 0;
        ImageSet images;
    };
    /// The first scan outside of `target` from which none of `good` can be begun.
    Stuck first_stuck(const Target& target, const std::vector<bool>& good) const;
    std::vector<CourseScan> course_to(const Stuck& stuck) const;

  private:
    struct Hit {
        Node node = kNone;
        std::uint16_t group = 0;
        ImageSet images;
    };
    struct Origin {
        Node parent = kNone;
        std::uint16_t group = 0;
        std::uint8_t part = 0;  ///< of the images: which of what the deadline distinguishes
    };
    /// The scan's images by what they do to the deadline.
    struct Part {
        ImageSet images;
        bool begins = false;
        bool pending = false;
    };

    bool is_idle(const Place& place, const Group& group) const;
    Place after(const Place& place, const Group& group) const;
    bool keeps_too_long(const Place& place, const Zone& zone, const Group& group, const View& view,
                        const ImageSet& images) const;
    std::array<Part, 2> parts(const Place& place, const View& view, const ImageSet& images) const;
    Bounds delay_of(const Place& place, const Group& group, const Place& next) const;
    bool ends_late(const Zone& zone, const Group& group) const;
    ImageSet narrowed(const ImageSet& images, const Place& next) const;
    void visit(Node node, const std::vector<Target>& targets);
    void judge(Node node, std::uint16_t index, const Group& group, const ImageSet& images, const View& view,
               const std::vector<Target>& targets);
    /// Calls `each(place, zone)` for each place where the next scan may begin.
    template <class Each>
    void successors(const Place& place, const Zone& zone, const Group& group, const Part& part, Each&& each,
                    bool& misses) const;
    Node find(const Place& place, const Zone& zone) const;
    void add(const Place& place, const Zone& zone, const Origin& origin, Node from);
    CourseScan scan_of(const Place& place, std::uint16_t index, const ImageSet& images) const;
    Node& slot(std::uint64_t packed);
    Node slot_value(std::uint64_t packed) const;
    std::size_t dense_index(std::uint64_t packed) const;
    bool is_hold() const {
        return precision_.deadline != nullptr && precision_.deadline->form == Form::never_while;
    }

    const Machine& machine_;
    Precision precision_;
    std::vector<std::uint64_t> places_;
    std::vector<Origin> origins_;
    std::vector<Zone> zones_;       ///< only if they count
    std::vector<Node> same_place_;  ///< the node before it with the same place
    std::vector<Node> dense_;
    std::unordered_map<std::uint64_t, Node> sparse_;
    std::vector<Edge> edges_;
    std::vector<std::uint32_t> first_edge_;  ///< by node, and the end
    bool has_all_edges_ = true;
    std::vector<Hit> hits_;
    Hit missed_;
    bool missed_at_end_ = false;
    std::vector<std::bitset<1024>> judged_;  ///< by group: the surroundings that were judged
    std::uint64_t steps_begun_ = 0;
    bool complete_ = true;
    bool uses_zones_ = false;
};

}  // namespace nplc::verify
