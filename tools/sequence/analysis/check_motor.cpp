#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>

#include "analysis/story.h"
#include "findings.h"
#include "motor_orders.h"
#include "registers/mac.h"
#include "walk.h"

namespace nplc::verify {
namespace {

using Node = Explorer::Node;
using sequencer::MotorOrder;
using table::OrderKind;

/// For each group, whether one of its commands has the property.
template <class IsSuch>
std::vector<bool> of_groups(const Machine& machine, const IsSuch& is_such) {
    std::vector<bool> result;
    for (const Group& group : machine.all_groups())
        result.push_back(std::any_of(group.outcome.orders.begin(), group.outcome.orders.end(), is_such));
    return result;
}

/// The groups of all reachable scans, in the order of discovery.
std::vector<const Group*> used_groups(const Explorer& explorer) {
    std::vector<const Group*> groups;
    for (const Group& group : explorer.machine().all_groups()) {
        if (explorer.first_use(group) != Explorer::kNone) groups.push_back(&group);
    }
    std::sort(groups.begin(), groups.end(), [&](const Group* a, const Group* b) {
        return std::pair(explorer.first_use(*a), a->number) < std::pair(explorer.first_use(*b), b->number);
    });
    return groups;
}

std::vector<bool> groups_that_begin_moves(const Machine& machine) {
    std::vector<bool> result;
    for (const Group& group : machine.all_groups()) result.push_back(begins_move(group.outcome.orders));
    return result;
}

/// V009: a move after which no step looks at INPOS or waits for a time.
std::vector<Finding> find_unseen_ends(const Subject& subject, const Sensitivity& sensitivity) {
    const Explorer& explorer = subject.explorer;
    const auto moves = of_groups(explorer.machine(), [](const MotorOrder& order) {
        return begins_motion(order) || ends_motion(order);
    });
    const auto all_that_see = std::make_shared<std::vector<bool>>(explorer.size());
    std::vector<bool>& sees = *all_that_see;
    std::vector<Node> open;
    for (auto node = static_cast<Node>(explorer.size()); node-- > 0;) {
        const std::uint8_t step = explorer.place(node).step;
        const bool waits_for_time =
            sensitivity.tests_timer(step) && ((subject.names.timer_is_limit >> step) & 1U) == 0;
        sees[node] = sensitivity.tests_in_pos(step) || waits_for_time;
        if (!sees[node]) open.push_back(node);
    }
    for (bool changed = true; changed;) {
        changed = std::erase_if(open, [&](Node node) {
                      const auto edges = explorer.edges_from(node);
                      sees[node] = std::any_of(edges.begin(), edges.end(), [&](const Explorer::Edge& edge) {
                          return sees[edge.to] && !moves[edge.group];
                      });
                      return sees[node];
                  }) != 0;
    }
    std::vector<Finding> findings;
    if (open.empty()) return findings;
    const std::vector<bool> goes = groups_that_begin_moves(explorer.machine());
    std::array<bool, 63> told{};
    for (const Explorer::Edge& edge : explorer.edges()) {
        if (sees[edge.to] || !goes[edge.group]) continue;
        const std::uint8_t step = explorer.place(edge.to).step;
        if (told[step]) continue;
        auto course = subject.courses.with(edge);
        if (!course) continue;
        told[step] = true;
        findings.push_back(
            {"V009", step,
             fmt::format("a move is ordered on the way into step {}, and no step after it looks "
                         "at INPOS or waits for a time",
                         step_name(subject.names, step)),
             std::move(*course), [=, &explorer](const OtherCourses& courses) {
                 return courses.with([&](const Explorer::Edge& other) {
                     return explorer.place(other.to).step == step && !(*all_that_see)[other.to] &&
                            goes[other.group];
                 });
             }});
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

/// Whether a step goes on to somewhere with INPOS alone: a way to the same step without it waits for none.
bool waits_for_in_pos(const Machine& machine, std::uint8_t step) {
    std::uint64_t with = 0;
    std::uint64_t without = 0;
    for (const Group& group : machine.groups(step, false, false)) {
        const std::uint8_t next = group.outcome.next;
        if (next == step) continue;
        const ImageSet calm = group.images & ~images_with_bit(7);
        if ((calm & images_with_bit(6)).any()) with |= std::uint64_t{1} << next;
        if ((calm & ~images_with_bit(6)).any()) without |= std::uint64_t{1} << next;
    }
    return (with & ~without) != 0;
}

/// V015: a move into a step that waits for its end and for no time.
std::vector<Finding> find_no_limit(const Subject& subject, const Sensitivity& sensitivity) {
    const Explorer& explorer = subject.explorer;
    const std::vector<bool> goes = groups_that_begin_moves(explorer.machine());
    std::array<bool, 63> waits = steps_without_limit(explorer.machine(), sensitivity);
    for (std::uint8_t step = 0; step <= sequencer::kLastStep; ++step)
        waits[step] = waits[step] && waits_for_in_pos(explorer.machine(), step);
    std::array<bool, 63> told{};
    std::vector<Finding> findings;
    for (const Explorer::Edge& edge : explorer.edges()) {
        const std::uint8_t step = explorer.place(edge.to).step;
        if (!waits[step] || told[step] || !goes[edge.group]) continue;
        auto course = subject.courses.with(edge);
        if (!course) continue;
        told[step] = true;
        findings.push_back({"V015", step,
                            fmt::format("step {} waits for the end of a move without a time limit",
                                        step_name(subject.names, step)),
                            std::move(*course), [=, &explorer](const OtherCourses& courses) {
                                return courses.with([&](const Explorer::Edge& other) {
                                    return explorer.place(other.to).step == step && goes[other.group];
                                });
                            }});
    }
    return findings;
}

const char* why_zero(MotorState::Speed speed) {
    return speed == MotorState::Speed::zero ? "V_SOLL is 0, or may be, by the value it is set to"
                                            : "V_SOLL is 0 from a STOP";
}

const char* why_never(const MotorState& motor) {
    if (motor.mode == MotorState::Mode::init) return "the motor is in INIT mode";
    if (motor.mode == MotorState::Mode::silent) return "the motor's mode never sets it";
    return why_zero(motor.speed);
}

/// V1..V8 that are only ever written as 0, or may be 0 by their range.
ZeroRegisters zero_registers(const Subject& subject) {
    ZeroRegisters zeros;
    ZeroRegisters others;
    for (const Group* group : used_groups(subject.explorer)) {
        for (const MotorOrder& order : group->outcome.orders) {
            if (order.is_register_write) (order.value == 0 ? zeros : others).set(order.reg & 0x7FU);
        }
    }
    zeros &= ~others;
    for (const std::uint8_t reg : subject.may_be_zero) zeros.set(reg & 0x7FU);
    return zeros;
}

/// The effect of a scan on the motor.
struct MotorChange {
    bool is_known = false;
    std::uint16_t then = 0;  ///< packed
    const char* stands{};    ///< why a move is commanded with V_SOLL 0
};

MotorChange change_by(const Group& group, std::uint16_t before, const ZeroRegisters& zeros) {
    MotorState motor = MotorState::unpacked(before);
    if (group.error) motor = {MotorState::Mode::init, motor.speed, true};
    bool begins = false;
    for (const MotorOrder& order : group.outcome.orders) {
        motor.apply(order, zeros);
        const OrderKind kind = table::kind_of(order);
        begins = begins || kind == OrderKind::place || kind == OrderKind::moves_by;
    }
    const bool stands = begins && !group.error && motor.stands();
    return {true, motor.packed(), stands ? why_zero(motor.speed) : nullptr};
}

/// V010 and V011, by following the commands' effect on the motor.
class MotorStands : public std::enable_shared_from_this<MotorStands> {
  public:
    MotorStands(const Subject& subject, const Sensitivity& sensitivity)
        : explorer_(subject.explorer),
          names_(subject.names),
          no_limit_(steps_without_limit(explorer_.machine(), sensitivity)),
          zeros_(zero_registers(subject)),
          changes_(explorer_.machine().all_groups().size()) {}

    std::vector<Finding> find() {
        std::array<bool, 63> told_wait{};
        std::array<bool, 63> told_move{};
        std::vector<Finding> findings;
        Walk walk(explorer_);
        walk.begin_at_power_up(0);
        walk.all([&](const Walk::Scan& scan) {
            const std::uint8_t step = explorer_.place(scan.edge.from).step;
            if (const char* why = told_wait[step] ? nullptr : why_waits(scan)) {
                told_wait[step] = true;
                findings.push_back(
                    {"V010", step,
                     fmt::format("step {} waits for INPOS without time limit, and it may never "
                                 "come: {}",
                                 step_name(names_, step), why),
                     scan.course(scan.images()), others([this, step, why](const Walk::Scan& other) {
                         return explorer_.place(other.edge.from).step == step && why_waits(other) == why;
                     })});
            }
            const MotorChange& change = change_of(scan);
            const std::uint8_t next = explorer_.place(scan.edge.to).step;
            if (change.stands != nullptr && !told_move[next]) {
                told_move[next] = true;
                findings.push_back(
                    {"V011", next,
                     fmt::format("on the way into step {} a move is ordered while {}: the motor stands",
                                 step_name(names_, next), change.stands),
                     scan.course(scan.images()),
                     others([this, next, stands = change.stands](const Walk::Scan& other) {
                         return explorer_.place(other.edge.to).step == next &&
                                change_of(other).stands == stands;
                     })});
            }
            scan.go_on(change.then);
        });
        return findings;
    }

  private:
    template <class Shows>
    Other others(const Shows& shows) {
        return [keep = shared_from_this(), shows](const OtherCourses& courses) {
            std::optional<Scans> course;
            Walk walk = courses.walk();
            walk.begin_at_power_up(0);
            walk.all([&](const Walk::Scan& scan) {
                if (!shows(scan)) return scan.go_on(keep->change_of(scan).then);
                course = scan.course(scan.images());
                scan.stop();
            });
            return course;
        };
    }
    const char* why_waits(const Walk::Scan& scan) const {
        if (explorer_.group_of(scan.edge).error || !no_limit_[explorer_.place(scan.edge.from).step])
            return nullptr;
        const MotorState motor = MotorState::unpacked(scan.memory);
        return motor.in_pos_never_comes() ? why_never(motor) : nullptr;
    }
    const MotorChange& change_of(const Walk::Scan& scan) {
        const Group& group = explorer_.group_of(scan.edge);
        MotorChange& change = changes_[group.number][scan.memory];
        if (!change.is_known) change = change_by(group, scan.memory, zeros_);
        return change;
    }

    const Explorer& explorer_;
    const Names& names_;
    std::array<bool, 63> no_limit_;
    ZeroRegisters zeros_;
    std::vector<std::array<MotorChange, MotorState::kPacked>> changes_;
};

/// Courses with a scan of the group.
auto others_with(const Group& group) {
    return [number = group.number](const OtherCourses& courses) {
        return courses.with([&](const Explorer::Edge& edge) { return edge.group == number; });
    };
}

/// A command that a later one of the same scan cancels.
std::optional<std::pair<MotorOrder, MotorOrder>> undone(const std::vector<MotorOrder>& orders) {
    std::optional<MotorOrder> move;
    std::map<std::uint8_t, MotorOrder> written;
    for (const MotorOrder& order : orders) {
        const OrderKind kind = table::kind_of(order);
        if (order.is_register_write) {
            const auto [before, is_new] = written.try_emplace(order.reg, order);
            if (!is_new && before->second.value != order.value) return {{before->second, order}};
        } else if (const std::uint8_t selected = table::selected_register(order); selected != 0) {
            written.erase(selected);
        }
        const bool begins = begins_motion(order) && kind != OrderKind::set;
        const bool cancels = begins || ends_motion(order) || table::is_silent(kind);
        const auto moving = move ? table::kind_of(*move) : OrderKind::nothing;
        const bool same_mode = moving == OrderKind::run && kind == OrderKind::run;
        const bool holds = moving == OrderKind::home && kind == OrderKind::hold;
        if (move && !same_mode && (cancels || holds)) return {{*move, order}};
        if (begins) move = order;
    }
    return std::nullopt;
}

std::vector<Finding> find_undone(const Subject& subject) {
    std::vector<Finding> findings;
    std::array<bool, 63> told{};
    for (const Group* group : used_groups(subject.explorer)) {
        const std::uint8_t step = subject.explorer.place(subject.explorer.first_use(*group)).step;
        if (group->outcome.orders.size() < 2 || told[step]) continue;
        const auto pair = undone(group->outcome.orders);
        if (!pair) continue;
        auto course = subject.courses.with(subject.explorer.first_edge_with(*group));
        if (!course) continue;
        told[step] = true;
        findings.push_back(
            {"V012", step,
             fmt::format("in a scan of step {} {} is sent after {} and undoes it",
                         step_name(subject.names, step), order_text(pair->second, subject.names),
                         order_text(pair->first, subject.names)),
             std::move(*course), others_with(*group)});
    }
    return findings;
}

/// "Fast (V1)": the program's name of a register that an order selects, and the motor's. All motors have
/// those that can be selected.
std::string selected_name(const MotorOrder& order, std::uint8_t reg, const Names& names) {
    const registers::Register* known = registers::find(registers::Model::mac140, reg);
    const std::string plain = known == nullptr ? std::to_string(reg) : std::string(known->name);
    const std::string text = names.order ? names.order(order) : "";
    const std::size_t open = text.find('(');
    if (open == text.npos || !text.ends_with(')')) return plain;
    const std::string own = text.substr(open + 1, text.size() - open - 2);
    return own == plain ? plain : fmt::format("{} ({})", own, plain);
}

bool orders_home(const Group& group) {
    const auto& orders = group.outcome.orders;
    return std::any_of(orders.begin(), orders.end(),
                       [](const MotorOrder& order) { return table::kind_of(order) == OrderKind::home; });
}

/// V011: a homing with a velocity that is 0.
std::vector<Finding> find_home_stands(const Subject& subject) {
    std::vector<Finding> findings;
    if (!zero_registers(subject).test(registers::V_HOME)) return findings;
    std::array<bool, 63> told{};
    for (const Group* group : used_groups(subject.explorer)) {
        if (group->error || !orders_home(*group)) continue;
        const Explorer::Edge& edge = subject.explorer.first_edge_with(*group);
        const std::uint8_t step = subject.explorer.place(edge.to).step;
        auto course = told[step] ? std::nullopt : subject.courses.with(edge);
        if (!course) continue;
        told[step] = true;
        findings.push_back(
            {"V011", step,
             fmt::format("on the way into step {} a homing is ordered while V_HOME is 0, or may "
                         "be, by the value it is set to: the motor stands",
                         step_name(subject.names, step)),
             std::move(*course), others_with(*group)});
    }
    return findings;
}

/// V014 for the registers of a homing, which it uses without a selection.
std::optional<Finding> find_home_not_written(const Subject& subject, const std::array<bool, 128>& written) {
    std::vector<std::string_view> missing;
    if (!written[registers::V_HOME]) missing.push_back("V_HOME");
    if (!written[registers::T_HOME]) missing.push_back("T_HOME");
    if (missing.empty()) return std::nullopt;
    for (const Group* group : used_groups(subject.explorer)) {
        if (!orders_home(*group)) continue;
        const Explorer::Edge& edge = subject.explorer.first_edge_with(*group);
        auto course = subject.courses.with(edge);
        if (!course) continue;
        const std::uint8_t step = subject.explorer.place(edge.to).step;
        const bool both = missing.size() > 1;
        return Finding{"V014", step,
                       fmt::format("on the way into step {} a homing is ordered, and nothing ever writes {}: "
                                   "{} the value{} stored "
                                   "in the motor",
                                   step_name(subject.names, step), fmt::join(missing, " and "),
                                   both ? "they hold" : "it holds", both ? "s" : ""),
                       std::move(*course), others_with(*group)};
    }
    return std::nullopt;
}

/// V014
std::vector<Finding> find_never_written(const Subject& subject) {
    struct Selection {
        const Group* group;
        const MotorOrder* order;
    };
    std::map<std::uint8_t, Selection> selected;
    std::array<bool, 128> written{};
    for (const Group* group : used_groups(subject.explorer)) {
        for (const MotorOrder& order : group->outcome.orders) {
            if (order.is_register_write) {
                written[order.reg & 0x7FU] = true;
            } else if (const std::uint8_t reg = table::selected_register(order); reg != 0) {
                selected.try_emplace(reg, Selection{group, &order});
            }
        }
    }
    std::vector<Finding> findings;
    for (const auto& [reg, selection] : selected) {
        if (written[reg]) continue;
        const Explorer::Edge& edge = subject.explorer.first_edge_with(*selection.group);
        const std::uint8_t step = subject.explorer.place(edge.from).step;
        auto course = subject.courses.with(edge);
        if (!course) continue;
        findings.push_back(
            {"V014", step,
             fmt::format("step {} selects register {}, and nothing ever writes it: it holds "
                         "the value stored in the motor",
                         step_name(subject.names, step), selected_name(*selection.order, reg, subject.names)),
             std::move(*course), others_with(*selection.group)});
    }
    if (auto finding = find_home_not_written(subject, written)) findings.push_back(std::move(*finding));
    return findings;
}

}  // namespace

std::vector<Finding> check_motor(const Subject& subject) {
    const Sensitivity sensitivity(subject.explorer.machine());
    std::vector<Finding> findings = find_unseen_ends(subject, sensitivity);
    for (auto& more :
         {std::make_shared<MotorStands>(subject, sensitivity)->find(), find_home_stands(subject),
          find_undone(subject), find_never_written(subject), find_no_limit(subject, sensitivity)})
        findings.insert(findings.end(), more.begin(), more.end());
    // Steps whose INPOS may never come have been reported already
    std::array<bool, 63> may_wait_for_ever{};
    for (const Finding& finding : findings) {
        if (finding.code == "V010") may_wait_for_ever[finding.step] = true;
    }
    std::erase_if(findings, [&](const Finding& finding) {
        return finding.code == "V015" && may_wait_for_ever[finding.step];
    });
    return findings;
}

}  // namespace nplc::verify
