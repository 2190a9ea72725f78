#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <bitset>
#include <set>
#include <span>

#include "findings.h"
#include "motor_orders.h"

namespace nplc::verify {
namespace {

using Node = Explorer::Node;

/// The part of a place that determines a scan: step, timer and counter zero or not.
using Corner = std::uint8_t;
constexpr std::size_t kCorners = (sequencer::kLastStep + std::size_t{1}) * 4;
using Corners = std::bitset<kCorners>;

constexpr Corner corner_of(std::uint8_t step, bool runs, bool counter_zero) {
    return static_cast<Corner>(step * 4U + (runs ? 1U : 0U) + (counter_zero ? 2U : 0U));
}
constexpr std::uint8_t step_of(Corner corner) {
    return corner / 4U;
}

/// V013: cycles of steps with constant inputs and without time.
class Rounds {
  public:
    explicit Rounds(const Subject& subject)
        : explorer_(subject.explorer),
          machine_(explorer_.machine()),
          names_(subject.names),
          courses_(subject.courses),
          state_(explorer_.size(), State::fresh) {
        for (Node node = 0; node < explorer_.size(); ++node) nodes_[corner_of(node)].push_back(node);
        for (const Group& group : machine_.all_groups()) {
            moves_.push_back(
                std::any_of(group.outcome.orders.begin(), group.outcome.orders.end(), begins_motion));
        }
    }

    std::vector<Finding> find() {
        const unsigned cared = machine_.cared_bits();
        for (unsigned image = 0; image < 256; ++image) {
            if ((image & ~cared) != 0 || !machine_.permitted()[image]) continue;
            image_ = static_cast<std::uint8_t>(image);
            find_lively();
            if (lively_.none()) continue;
            leave_what_matters();
            if (lively_.any()) follow_all();
        }
        return std::move(findings_);
    }

  private:
    const Group& group_at(Corner corner) const {
        return machine_.group_with(step_of(corner), (corner & 1U) == 0, (corner & 2U) != 0, image_);
    }

    /// The start of the next scan if no time passes; two where the counter goes down and may be zero.
    void find_next(Corner corner) {
        using table::CounterChange;
        const table::Outcome& outcome = group_at(corner).outcome;
        const bool runs = (corner & 1U) != 0 || outcome.timer != 0;
        const bool was_zero = (corner & 2U) != 0;
        const bool is_zero = outcome.sets_counter() ? outcome.counter == CounterChange::clear : was_zero;
        const bool counts = outcome.counter == CounterChange::count_down && !was_zero;
        next_[corner] = verify::corner_of(outcome.next, runs, is_zero);
        other_[corner] = counts ? verify::corner_of(outcome.next, runs, true) : next_[corner];
    }

    /// Corners through which others can follow for ever without an answer of the motor.
    void find_lively() {
        lively_.reset();
        for (std::size_t i = 0; i < kCorners; ++i) {
            const auto corner = static_cast<Corner>(i);
            if (nodes_[i].empty() || waits(group_at(corner))) continue;
            find_next(corner);
            lively_.set(i);
        }
        for (bool changed = lively_.any(); changed;) {
            Corners followed;
            Corners goes_on;
            for (std::size_t i = lively_._Find_first(); i < kCorners; i = lively_._Find_next(i)) {
                for (const Corner to : {next_[i], other_[i]}) {
                    if (to == i || !lively_[to]) continue;
                    goes_on.set(i);
                    followed.set(to);
                }
            }
            changed = (goes_on & followed) != lively_;
            lively_ = goes_on & followed;
        }
    }

    /// If each corner has only one successor, keeps only the corners of rounds that are to be reported.
    void leave_what_matters() {
        for (std::size_t i = lively_._Find_first(); i < kCorners; i = lively_._Find_next(i)) {
            if (next_[i] != other_[i]) return;
        }
        Corners rest = lively_;
        lively_.reset();
        while (rest.any()) {
            Corners walked;
            std::size_t at = rest._Find_first();
            for (; rest[at]; at = next_[at]) {
                walked.set(at);
                rest.reset(at);
            }
            if (!walked[at]) continue;
            Corners round;
            for (; !round[at]; at = next_[at]) round.set(at);
            if (matters(round)) lively_ |= round;
        }
    }

    bool matters(const Corners& round) const {
        Steps steps = 0;
        for (std::size_t i = round._Find_first(); i < kCorners; i = round._Find_next(i))
            steps |= bit_of(step_of(static_cast<Corner>(i)));
        return !std::has_single_bit(steps) && !told_.contains(steps);
    }

    /// A scan to which the motor responds.
    bool waits(const Group& group) const {
        return (group.resets_error && (image_ & sequencer::kError) != 0) ||
               ((image_ & sequencer::kInPos) != 0 && moves_[group.number]);
    }

    void follow_all() {
        std::vector<Node> starts;
        for (std::size_t corner = 0; corner < kCorners; ++corner) {
            if (lively_[corner]) starts.insert(starts.end(), nodes_[corner].begin(), nodes_[corner].end());
        }
        std::sort(starts.begin(), starts.end());
        for (const Node node : starts) {
            if (state_[node] == State::fresh) follow(node);
        }
        for (const Node node : touched_) state_[node] = State::fresh;
        touched_.clear();
    }

    Corner corner_of(Node node) const {
        const Place& place = explorer_.place(node);
        return verify::corner_of(place.step, place.runs, place.counter == 0);
    }
    bool is_lively(Node node) const { return lively_[corner_of(node)]; }

    /// A place on the path, and its edges that have not been followed yet.
    struct Stop {
        Node node = 0;
        std::span<const Explorer::Edge> edges;
        std::uint32_t group = 0;
        bool runs = false;
    };

    Stop stop_at(Node node) {
        state_[node] = State::open;
        touched_.push_back(node);
        const Place& here = explorer_.place(node);
        if (!is_lively(node) || !explorer_.allowed(here)[image_]) return {.node = node, .edges = {}};
        const Group& group = machine_.group_with(here.step, !here.runs, here.counter == 0, image_);
        return {.node = node,
                .edges = explorer_.edges_from(node),
                .group = group.number,
                .runs = here.runs || group.outcome.timer != 0};
    }

    /// The next scan with the image after which no time has passed: the only one, or one for each count of a
    /// range.
    const Explorer::Edge* next_at_once(Stop& stop) const {
        while (!stop.edges.empty()) {
            const Explorer::Edge& edge = stop.edges.front();
            stop.edges = stop.edges.subspan(1);
            const Place& to = explorer_.place(edge.to);
            if (edge.group == stop.group && to.runs == stop.runs && to.motor != Place::Motor::cut &&
                to.motor != Place::Motor::lost)
                return &edge;
        }
        return nullptr;
    }

    void follow(Node start) {
        std::vector<Stop> stops{stop_at(start)};
        std::vector<const Explorer::Edge*> way;
        while (!stops.empty()) {
            const Explorer::Edge* const edge = next_at_once(stops.back());
            if (edge == nullptr) {
                state_[stops.back().node] = State::done;
                stops.pop_back();
                if (!way.empty()) way.pop_back();
            } else if (state_[edge->to] == State::fresh) {
                way.push_back(edge);
                stops.push_back(stop_at(edge->to));
            } else if (state_[edge->to] == State::open) {
                way.push_back(edge);
                judge(way, edge->to);
                way.pop_back();
            }
        }
    }

    /// The end of `edges` from `first` on is a cycle.
    void judge(std::span<const Explorer::Edge* const> edges, Node first) {
        Steps steps = 0;
        std::vector<CourseScan> way;
        const auto begin = std::find_if(edges.begin(), edges.end(),
                                        [&](const Explorer::Edge* edge) { return edge->from == first; });
        for (auto edge = begin; edge != edges.end(); ++edge) {
            steps |= bit_of(explorer_.place((*edge)->from).step);
            ImageSet only;
            only.set(image_);
            way.push_back(explorer_.scan_of(**edge, only));
        }
        if (std::has_single_bit(steps) || told_.contains(steps)) return;
        auto course = courses_.to(first, way);
        if (!course) return;
        told_.insert(steps);
        findings_.push_back({"V013", explorer_.place(first).step,
                             fmt::format("steps {} follow each other without end while no input changes",
                                         names_of(steps, names_)),
                             std::move(*course), others(first, std::move(way))});
    }

    /// Other courses to the same round, then other rounds through its first step.
    Other others(Node first, Scans way) const {
        return [&explorer = explorer_, &names = names_, first,
                round = std::move(way)](const OtherCourses& courses) -> std::optional<Scans> {
            if (auto course = courses.to([&](Node node) { return node == first; }, round)) return course;
            if (courses.excluded().is_worn_out()) return std::nullopt;
            courses.excluded().count_work(explorer.edges().size());
            Courses not_excluded(explorer, &courses.excluded());
            for (Finding& finding : find_rounds({explorer, names, not_excluded, {}})) {
                if (finding.step == explorer.place(first).step) return std::move(finding.way);
            }
            return std::nullopt;
        };
    }

    enum class State : std::uint8_t { fresh, open, done };

    const Explorer& explorer_;
    const Machine& machine_;
    const Names& names_;
    Courses& courses_;
    std::uint8_t image_ = 0;
    std::array<Corner, kCorners> next_{};
    std::array<Corner, kCorners> other_{};
    Corners lively_;
    std::array<std::vector<Node>, kCorners> nodes_;  ///< by corner
    std::vector<bool> moves_;                        ///< by group: an order begins a motion
    std::vector<State> state_;                       ///< by node
    std::vector<Node> touched_;
    std::set<Steps> told_;
    std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> find_rounds(const Subject& subject) {
    return Rounds(subject).find();
}

}  // namespace nplc::verify
