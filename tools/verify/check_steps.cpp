#include <fmt/format.h>

#include <array>
#include <bit>
#include <set>

#include "findings.h"
#include "motor_orders.h"
#include "verify/story.h"

namespace nplc::verify {
namespace {

using Steps = std::uint64_t;  ///< a bit for each

constexpr Steps bit_of(std::uint8_t step) {
    return Steps{1} << step;
}

/// Where each step leads, and where the first course begins: step 0, and where that leads without ERROR.
struct StepGraph {
    std::array<Steps, 64> next{};
    Steps first = 1;

    explicit StepGraph(const Explorer& explorer) {
        for (const Explorer::Edge& edge : explorer.edges()) {
            const std::uint8_t from = explorer.place(edge.from).step;
            const std::uint8_t to = explorer.place(edge.to).step;
            next[from] |= bit_of(to);
            if (from == 0 && !explorer.images_of(edge)[0xFF] && !explorer.images_of(edge)[sequencer::kError])
                first |= bit_of(to);
        }
    }
    Steps reached_from(std::uint8_t step) const {
        Steps all = bit_of(step);
        for (Steps open = all; open != 0;) {
            const auto at = static_cast<std::uint8_t>(std::countr_zero(open));
            open &= open - 1;
            open |= next[at] & ~all;
            all |= next[at];
        }
        return all;
    }
};

std::string names_of(Steps steps, const Names& names) {
    std::string text;
    for (; steps != 0; steps &= steps - 1)
        text +=
            (text.empty() ? "" : ", ") + step_name(names, static_cast<std::uint8_t>(std::countr_zero(steps)));
    return text;
}

std::vector<CourseScan> course_into(const Explorer& explorer, std::uint8_t step) {
    for (Explorer::Node node = 0; node < explorer.size(); ++node) {
        if (explorer.place(node).step == step) return explorer.course_to_node(node);
    }
    return {};
}

void find_never_reached(const Subject& subject, std::vector<Finding>& findings) {
    const Machine& machine = subject.explorer.machine();
    for (std::uint8_t step = 1; step <= sequencer::kLastStep; ++step) {
        const bool is_there =
            !subject.names.steps[step].empty() || ((machine.steps_with_terms() >> step) & 1U) != 0;
        if (!is_there || ((subject.explorer.steps_begun() >> step) & 1U) != 0) continue;
        findings.push_back(
            {"V001", step, fmt::format("no course reaches step {}", step_name(subject.names, step)), {}});
    }
}

void find_never_left(const Subject& subject, std::vector<Finding>& findings) {
    const StepGraph graph(subject.explorer);
    const Steps begun = subject.explorer.steps_begun();
    if (std::has_single_bit(begun)) return;
    Steps told = 0;
    for (std::uint8_t step = 0; step <= sequencer::kLastStep; ++step) {
        if ((begun & bit_of(step)) == 0) continue;
        const Steps group = graph.reached_from(step);
        if (group == bit_of(step)) {
            findings.push_back({"V002", step,
                                fmt::format("nothing leaves step {}", step_name(subject.names, step)),
                                course_into(subject.explorer, step)});
            continue;
        }
        if ((group & graph.first) != 0 || (told & bit_of(step)) != 0) continue;
        const Steps one = group & (~group + 1);
        const bool all_meet = graph.reached_from(static_cast<std::uint8_t>(std::countr_zero(one))) == group;
        if (!all_meet || (graph.reached_from(step) & bit_of(step)) == 0) continue;
        told |= group;
        findings.push_back({"V003", step,
                            fmt::format("steps {} lead to each other only, never back to {}",
                                        names_of(group, subject.names), names_of(graph.first, subject.names)),
                            course_into(subject.explorer, step)});
    }
}

/// Steps that go round with inputs as they are and no time needed.
class Rounds {
  public:
    explicit Rounds(const Subject& subject) : explorer_(subject.explorer), names_(subject.names) {
        find_edges_at_once();
        way_.assign(explorer_.size(), kNowhere);
    }

    std::vector<Finding> find() {
        const unsigned cared = explorer_.machine().cared_bits();
        for (unsigned image = 0; image < 256; ++image) {
            if ((image & ~cared) == 0 && explorer_.machine().permitted()[image])
                follow_all(static_cast<std::uint8_t>(image));
        }
        return std::move(findings_);
    }

  private:
    using Node = Explorer::Node;
    static constexpr std::uint32_t kNowhere = ~std::uint32_t{0};

    /// The scans after which no time has passed: of each node's groups the edge.
    void find_edges_at_once() {
        const Machine& machine = explorer_.machine();
        first_at_once_.reserve(explorer_.size());
        for (Node node = 0; node < explorer_.size(); ++node) {
            const Place here = explorer_.place(node);
            const std::size_t first = at_once_.size();
            first_at_once_.push_back(first);
            const auto groups = machine.groups(here.step, !here.runs, here.counter == 0);
            at_once_.resize(first + groups.size(), kNowhere);
            for (const Explorer::Edge& edge : explorer_.edges_from(node)) {
                const Place to = explorer_.place(edge.to);
                const bool runs = here.runs || groups[edge.group].pending.timer_preset != 0;
                if (to.runs != runs || to.error_comes || to.motor == Place::Motor::lost) continue;
                at_once_[first + edge.group] = static_cast<std::uint32_t>(&edge - explorer_.edges().data());
            }
        }
    }

    std::uint32_t edge_at_once(Node node, std::uint8_t image) const {
        const Place here = explorer_.place(node);
        if (!is_lively(here.step, here.runs)) return kNowhere;
        const bool shows_error = here.motor != Place::Motor::free || here.error_comes;
        if (shows_error && !explorer_.allowed(here)[image]) return kNowhere;
        const Machine& machine = explorer_.machine();
        return at_once_[first_at_once_[node] +
                        machine.group_with(here.step, !here.runs, here.counter == 0, image)];
    }

    /// Steps by timer running, as bits, from which other steps can follow for ever with this image, whatever
    /// the counter is.
    void find_lively(std::uint8_t image) {
        lively_ = {~Steps{0} >> 1U, ~Steps{0} >> 1U};
        for (bool changed = true; changed;) {
            changed = false;
            for (std::uint8_t step = 0; step <= sequencer::kLastStep; ++step) {
                for (const bool runs : {false, true}) {
                    if (!is_lively(step, runs) || goes_on(step, runs, image)) continue;
                    lively_[runs ? 1 : 0] &= ~bit_of(step);
                    changed = true;
                }
            }
        }
    }

    bool is_lively(std::uint8_t step, bool runs) const { return (lively_[runs ? 1 : 0] & bit_of(step)) != 0; }

    bool goes_on(std::uint8_t step, bool runs, std::uint8_t image) const {
        const Machine& machine = explorer_.machine();
        for (const bool counter_zero : {false, true}) {
            const auto group = machine.group_with(step, !runs, counter_zero, image);
            const auto& pending = machine.groups(step, !runs, counter_zero)[group].pending;
            const std::uint8_t next = pending.next_step == sequencer::kNoSwitch ? step : pending.next_step;
            const bool runs_then = runs || pending.timer_preset != 0;
            if ((next != step || runs_then != runs) && is_lively(next, runs_then)) return true;
        }
        return false;
    }

    void follow_all(std::uint8_t image) {
        find_lively(image);
        if ((lively_[0] | lively_[1]) == 0) return;
        round_of_.assign(explorer_.size(), 0);
        for (Node node = 0; node < explorer_.size(); ++node) {
            if (round_of_[node] == 0) follow(node, image);
        }
    }

    void follow(Node start, std::uint8_t image) {
        const Node mark = start + 1;
        Node node = start;
        while (round_of_[node] == 0) {
            round_of_[node] = mark;
            way_[node] = edge_at_once(node, image);
            if (way_[node] == kNowhere) return;
            node = explorer_.edges()[way_[node]].to;
        }
        if (round_of_[node] == mark) judge(node, image);
    }

    void judge(Node first, std::uint8_t image) {
        Steps steps = 0;
        std::vector<CourseScan> way;
        Node node = first;
        do {
            const Explorer::Edge& edge = explorer_.edges()[way_[node]];
            const Group& group = explorer_.group_of(edge);
            const bool waits = (image & sequencer::kInPos) != 0 && moves(group);
            if (waits || (group.resets_error && (image & sequencer::kError) != 0)) return;
            steps |= bit_of(explorer_.place(node).step);
            ImageSet only;
            only.set(image);
            way.push_back(explorer_.scan_of(edge, only));
            node = edge.to;
        } while (node != first);
        if (std::has_single_bit(steps) || !told_.insert(steps).second) return;
        std::vector<CourseScan> course = explorer_.course_to_node(first);
        course.insert(course.end(), way.begin(), way.end());
        findings_.push_back({"V013", explorer_.place(first).step,
                             fmt::format("steps {} follow each other without end while no input changes",
                                         names_of(steps, names_)),
                             std::move(course)});
    }

    static bool moves(const Group& group) {
        for (const auto& order : group.orders) {
            if (begins_motion(kind_of(order))) return true;
        }
        return false;
    }

    const Explorer& explorer_;
    const Names& names_;
    std::vector<std::uint32_t> at_once_;      ///< edges
    std::vector<std::size_t> first_at_once_;  ///< by node
    std::array<Steps, 2> lively_{};
    std::vector<Node> round_of_;
    std::vector<std::uint32_t> way_;
    std::set<Steps> told_;
    std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> check_steps(const Subject& subject) {
    std::vector<Finding> findings;
    find_never_reached(subject, findings);
    find_never_left(subject, findings);
    const std::vector<Finding> rounds = Rounds(subject).find();
    findings.insert(findings.end(), rounds.begin(), rounds.end());
    return findings;
}

}  // namespace nplc::verify
