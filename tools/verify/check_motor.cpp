#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "findings.h"
#include "motor_orders.h"
#include "verify/story.h"
#include "walk.h"

namespace nplc::verify {
namespace {

using Node = Explorer::Node;
using sequencer::MotorOrder;

std::string order_text(const MotorOrder& order) {
    return order.is_register_write ? fmt::format("{}={}", order.reg, order.value)
                                   : fmt::format("{:02X}h", order.command);
}

std::vector<CourseScan> course_with(const Explorer& explorer, const Explorer::Edge& edge) {
    std::vector<CourseScan> course = explorer.course_to_node(edge.from);
    course.push_back(explorer.scan_of(edge, explorer.images_of(edge)));
    return course;
}

/// V009: a move after which no step looks at INPOS or at the timer.
std::vector<Finding> find_unseen_ends(const Subject& subject, const Sensitivity& sensitivity) {
    const Explorer& explorer = subject.explorer;
    const auto moves = [&](const Explorer::Edge& edge) {
        const auto& orders = explorer.group_of(edge).orders;
        return std::any_of(orders.begin(), orders.end(), [](const MotorOrder& order) {
            return begins_motion(kind_of(order)) || ends_motion(kind_of(order));
        });
    };
    std::vector<bool> sees(explorer.size());
    for (Node node = 0; node < explorer.size(); ++node) {
        const std::uint8_t step = explorer.place(node).step;
        sees[node] = sensitivity.tests_in_pos(step) || sensitivity.tests_timer(step);
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = explorer.edges().size(); i-- > 0;) {
            const Explorer::Edge& edge = explorer.edges()[i];
            if (sees[edge.from] || !sees[edge.to] || moves(edge)) continue;
            sees[edge.from] = changed = true;
        }
    }
    std::vector<Finding> findings;
    std::array<bool, 63> told{};
    for (const Explorer::Edge& edge : explorer.edges()) {
        const std::uint8_t step = explorer.place(edge.to).step;
        if (sees[edge.to] || told[step]) continue;
        const Group& group = explorer.group_of(edge);
        if (motion_after(Motion::none, false, group.orders) != Motion::to_place) continue;
        told[step] = true;
        findings.push_back(
            {"V009", step,
             fmt::format("a move is ordered on the way into step {}, and no step after it looks "
                         "at INPOS or the timer",
                         step_name(subject.names, step)),
             course_with(explorer, edge)});
    }
    return findings;
}

/// Steps that wait for INPOS with nothing that the timer ends.
std::array<bool, 63> steps_without_limit(const Machine& machine, const Sensitivity& sensitivity) {
    std::array<bool, 63> result{};
    for (std::uint8_t step = 0; step <= sequencer::kLastStep; ++step)
        result[step] = sensitivity.tests_in_pos(step) && !sensitivity.tests_timer(step) &&
                       ((machine.steps_with_terms() >> step) & 1U) != 0;
    return result;
}

/// V010 and V011, by following what the orders make of the motor.
std::vector<Finding> find_motor_stands(const Subject& subject, const Sensitivity& sensitivity) {
    const Explorer& explorer = subject.explorer;
    const auto no_limit = steps_without_limit(explorer.machine(), sensitivity);
    std::array<bool, 63> told_wait{};
    std::array<bool, 63> told_move{};
    std::vector<Finding> findings;
    Walk walk(explorer);
    walk.all([&](const Explorer::Edge& edge, const ImageSet& images, std::uint16_t memory, const auto& go_on,
                 const auto& show) {
        const Place here = explorer.place(edge.from);
        const Group& group = explorer.group_of(edge);
        MotorState motor = MotorState::unpacked(memory);
        const bool error = (images >> sequencer::kError).any();
        if (!error && motor.in_pos_never_comes() && no_limit[here.step] && !told_wait[here.step]) {
            told_wait[here.step] = true;
            const char* why = motor.mode == MotorState::Mode::init     ? "the motor is in INIT mode"
                              : motor.mode == MotorState::Mode::silent ? "the motor's mode never sets it"
                                                                       : "V_SOLL is 0 from a STOP";
            findings.push_back({"V010", here.step,
                                fmt::format("step {} waits for INPOS without time limit, and it may never "
                                            "come: {}",
                                            step_name(subject.names, here.step), why),
                                show(images)});
        }
        if (error) motor = {MotorState::Mode::init, motor.stopped, true};
        bool begins = false;
        for (const MotorOrder& order : group.orders) {
            motor.apply(order);
            begins = begins || kind_of(order) == OrderKind::place;
        }
        const std::uint8_t next = explorer.place(edge.to).step;
        if (begins && !error && motor.mode == MotorState::Mode::position && motor.stopped &&
            !told_move[next]) {
            told_move[next] = true;
            findings.push_back({"V011", next,
                                fmt::format("on the way into step {} a move is ordered while V_SOLL is 0 "
                                            "from a STOP: the motor stands",
                                            step_name(subject.names, next)),
                                show(images)});
        }
        go_on(images, motor.packed());
    });
    return findings;
}

/// The order of a scan that a later one of it undoes.
std::optional<std::pair<MotorOrder, MotorOrder>> undone(const std::vector<MotorOrder>& orders) {
    std::optional<MotorOrder> move;
    std::map<std::uint8_t, MotorOrder> written;
    for (const MotorOrder& order : orders) {
        const OrderKind kind = kind_of(order);
        if (order.is_register_write) {
            const auto [before, is_new] = written.try_emplace(order.reg, order);
            if (!is_new && before->second.value != order.value) return {{before->second, order}};
        } else if (const std::uint8_t selected = selected_register(order); selected != 0) {
            written.erase(selected);
        }
        const bool cancels = begins_motion(kind) || ends_motion(kind) || kind == OrderKind::silent;
        const bool homing = move && kind_of(*move) == OrderKind::home;
        const bool same_mode = move && kind_of(*move) == OrderKind::velocity && kind == OrderKind::velocity;
        if (move && !same_mode && (cancels || (homing && kind == OrderKind::holds_place)) &&
            kind != OrderKind::set)
            return {{*move, order}};
        if (begins_motion(kind) && kind != OrderKind::set) move = order;
    }
    return std::nullopt;
}

std::vector<Finding> find_undone(const Subject& subject) {
    std::vector<Finding> findings;
    std::array<bool, 63> told{};
    std::map<const Group*, bool> seen;
    for (const Explorer::Edge& edge : subject.explorer.edges()) {
        const Group& group = subject.explorer.group_of(edge);
        const std::uint8_t step = subject.explorer.place(edge.from).step;
        if (group.orders.size() < 2 || told[step] || !seen.emplace(&group, true).second) continue;
        const auto pair = undone(group.orders);
        if (!pair) continue;
        told[step] = true;
        findings.push_back(
            {"V012", step,
             fmt::format("in a scan of step {} {} is sent after {} and undoes it",
                         step_name(subject.names, step), order_text(pair->second), order_text(pair->first)),
             course_with(subject.explorer, edge)});
    }
    return findings;
}

/// V014
std::vector<Finding> find_never_written(const Subject& subject) {
    std::map<std::uint8_t, Explorer::Edge> selected;
    std::array<bool, 128> written{};
    for (const Explorer::Edge& edge : subject.explorer.edges()) {
        for (const MotorOrder& order : subject.explorer.group_of(edge).orders) {
            if (order.is_register_write) {
                written[order.reg & 0x7FU] = true;
            } else if (const std::uint8_t reg = selected_register(order); reg != 0) {
                selected.try_emplace(reg, edge);
            }
        }
    }
    std::vector<Finding> findings;
    for (const auto& [reg, edge] : selected) {
        if (written[reg]) continue;
        const std::uint8_t step = subject.explorer.place(edge.from).step;
        findings.push_back({"V014", step,
                            fmt::format("step {} selects register {}, and nothing ever writes it: it holds "
                                        "what somebody stored in the motor",
                                        step_name(subject.names, step), reg),
                            course_with(subject.explorer, edge)});
    }
    return findings;
}

}  // namespace

std::vector<Finding> check_motor(const Subject& subject) {
    const Sensitivity sensitivity(subject.explorer.machine());
    std::vector<Finding> findings = find_unseen_ends(subject, sensitivity);
    for (auto& more :
         {find_motor_stands(subject, sensitivity), find_undone(subject), find_never_written(subject)})
        findings.insert(findings.end(), more.begin(), more.end());
    return findings;
}

}  // namespace nplc::verify
