#include <fmt/format.h>

#include <array>

#include "findings.h"
#include "verify/story.h"

namespace nplc::verify {
namespace {

using Node = Explorer::Node;

bool shows_error(const Place& place) {
    return place.motor != Place::Motor::free;
}

class Errors {
  public:
    explicit Errors(const Subject& subject)
        : explorer_(subject.explorer), machine_(explorer_.machine()), names_(subject.names) {
        find_fault_steps();
        find_ways_to_reset();
    }

    std::vector<Finding> find() {
        std::array<bool, 63> told{};
        for (Node node = 0; node < explorer_.size(); ++node) {
            const Place place = explorer_.place(node);
            if (!is_fault_step_[place.step] || !shows_error(place) || resets_[node] || told[place.step])
                continue;
            told[place.step] = true;
            tell_stuck(node, place);
        }
        find_outputs_left_on();
        return std::move(findings_);
    }

  private:
    /// Steps that ERROR leads to: the same images without it do not.
    void find_fault_steps() {
        for (std::uint8_t step = 0; step <= sequencer::kLastStep; ++step) {
            for (unsigned zeros = 0; zeros < 4; ++zeros) {
                const auto row = machine_.groups(step, (zeros & 1U) != 0, (zeros & 2U) != 0);
                for (const Group& group : row) note_fault_step(step, row, group);
            }
        }
    }

    void note_fault_step(std::uint8_t step, std::span<const Group> row, const Group& group) {
        const std::uint8_t next = group.pending.next_step;
        if (next > sequencer::kLastStep || next == step || next == 0) return;
        for (unsigned image = sequencer::kError; image < 256; ++image) {
            if (!group.images[image]) continue;
            const Group& without = group_with(row, image & ~unsigned{sequencer::kError});
            if (without.pending.next_step != next) is_fault_step_[next] = true;
        }
    }

    /// Places from which, while ERROR lasts, some course sends RESET_ERROR.
    void find_ways_to_reset() {
        resets_.assign(explorer_.size(), false);
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t i = explorer_.edges().size(); i-- > 0;) {
                const Explorer::Edge& edge = explorer_.edges()[i];
                if (resets_[edge.from] || !shows_error(explorer_.place(edge.from))) continue;
                const bool goes_on = shows_error(explorer_.place(edge.to)) && resets_[edge.to];
                if (!goes_on && !explorer_.group_of(edge).resets_error) continue;
                resets_[edge.from] = changed = true;
            }
        }
    }

    void tell_stuck(Node node, const Place& place) {
        bool leaves = false;
        std::vector<Node> open = {node};
        std::vector<bool> seen(explorer_.size());
        seen[node] = true;
        while (!open.empty()) {
            const Node at = open.back();
            open.pop_back();
            leaves = leaves || explorer_.place(at).step != place.step;
            for (const Explorer::Edge& edge : explorer_.edges_from(at)) {
                if (seen[edge.to] || !shows_error(explorer_.place(edge.to))) continue;
                seen[edge.to] = true;
                open.push_back(edge.to);
            }
        }
        const std::string step = step_name(names_, place.step);
        const char* when = place.motor == Place::Motor::lost ? "after a lost link (ERROR without INPOS)"
                                                             : "while ERROR lasts";
        findings_.push_back(
            {leaves ? "V005" : "V004", place.step,
             leaves
                 ? fmt::format("{} no way from step {} sends RESET_ERROR: it always comes back", when, step)
                 : fmt::format("{} nothing leaves step {}, and it sends no RESET_ERROR", when, step),
             explorer_.course_to_node(node)});
    }

    /// Scans with ERROR in which no term writes outputs.
    void find_outputs_left_on() {
        std::array<bool, 63> told{};
        for (const Explorer::Edge& edge : explorer_.edges()) {
            const Place place = explorer_.place(edge.from);
            if (place.outputs == 0 || is_fault_step_[place.step] || told[place.step]) continue;
            if (explorer_.group_of(edge).pending.has_output) continue;
            const ImageSet images = explorer_.images_of(edge);
            if ((images >> sequencer::kError).none()) continue;
            told[place.step] = true;
            std::vector<CourseScan> way = explorer_.course_to_node(edge.from);
            way.push_back(explorer_.scan_of(edge, images));
            findings_.push_back({"V006", place.step,
                                 fmt::format("in step {} ERROR leaves {} on", step_name(names_, place.step),
                                             outputs_text(place.outputs, names_)),
                                 std::move(way)});
        }
    }

    const Explorer& explorer_;
    const Machine& machine_;
    const Names& names_;
    std::array<bool, 64> is_fault_step_{};
    std::vector<bool> resets_;
    std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> check_errors(const Subject& subject) {
    return Errors(subject).find();
}

}  // namespace nplc::verify
