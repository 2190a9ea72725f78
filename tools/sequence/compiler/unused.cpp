#include "compiler/unused.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <unordered_set>
#include <utility>

#include "language/names.h"
#include "symbols/commands.h"

namespace nplc::seqc {
namespace {

using table::Group;
using Place = std::pair<Group, std::uint8_t>;

class Unused {
  public:
    Unused(const ast::Program& program, const Plan& plan, const Sources& sources, const Symbols& symbols,
           Report& report)
        : program_(program), plan_(plan), sources_(sources), symbols_(symbols), report_(report) {
        std::unordered_set<std::uint32_t> declared_at;
        for (const auto* list : {&program.inputs, &program.outputs}) {
            for (const ast::Variable& variable : *list) declared_at.insert(variable.address.span.offset);
        }
        for (const ast::Use& use : program.uses) {
            if (use.declares || declared_at.contains(use.span.offset)) continue;
            const bool of_steps = use.role == ast::Role::step || use.role == ast::Role::step_or_group ||
                                  use.role == ast::Role::group;
            (of_steps ? used_steps_ : used_).insert(plain(text(use.span)));
        }
        for (const ast::Sequence& sequence : program.sequences)
            sequences_at_.insert(sequence.name.span.offset);
        for_each_send(plan, [this](const Send& send) { take(send); });
    }

    void run() {
        if (has_bytes()) return;
        for (const ast::Variable& variable : program_.inputs) check_signal(variable, "no condition uses it");
        for (const ast::Variable& variable : program_.outputs) check_signal(variable, "nothing switches it");
        for (const ast::Group& group : program_.groups) check_group(group);
        for (const ast::Variable& variable : program_.motor_variables)
            check_register(variable.name, variable.value.has_value());
        for (const ast::SetPoint& point : program_.set_points) check_register(point.name, true);
    }

  private:
    std::string_view text(Span span) const {
        return std::string_view(sources_.text()).substr(span.offset, span.length);
    }

    /// %IX0.2 is IN2.
    static std::string plain(std::string_view name) {
        std::string word = upper(name);
        if (word.starts_with("%IX0.")) return "IN" + word.substr(5);
        if (word.starts_with("%QX0.")) return "OUT" + word.substr(5);
        return word;
    }

    /// TERM lines may use what seems unused.
    bool has_bytes() const {
        return !plan_.terms.empty() || std::any_of(plan_.steps.begin(), plan_.steps.end(),
                                                   [](const StepPlan& step) { return !step.terms.empty(); });
    }

    void take(const Send& send) {
        if (send.reg != nullptr) {
            const bool selects = send.reg->number >= registers::P_REG_P && send.reg->number < registers::P1;
            selects_by_number_ = selects_by_number_ || selects;
            const bool enters =
                send.reg->number == registers::MODE_REG || send.reg->number == registers::STARTMODE;
            if (enters) take_mode(send.value);
            return;
        }
        if (const auto select = select_command(send.command)) {
            selected_.insert({select->selection.group, select->selection.index});
            return;
        }
        if (const auto move = table::relative_move(send.command)) selected_.insert({Group::p, move->index});
        const auto set = table::set_used(send.command);
        if (!set) return;
        for (const Group group : {Group::p, Group::v, Group::a, Group::t, Group::l, Group::z})
            selected_.insert({group, *set});
    }

    /// Modes that take registers without a selection (001 §4.4.20 - §4.4.22).
    void take_mode(std::uint32_t mode) {
        constexpr std::uint32_t kCoil = 19;
        constexpr std::uint32_t kTwoPositions = 20;
        constexpr std::uint32_t kAnaloguePosition = 21;
        constexpr std::uint8_t kByHand = 8;  // V8 turns the spool that does not
        const std::uint8_t places = mode == kCoil               ? 6
                                    : mode == kTwoPositions     ? 2
                                    : mode == kAnaloguePosition ? 3
                                                                : 0;
        for (std::uint8_t i = 1; i <= places; ++i) selected_.insert({Group::p, i});
        if (mode == kCoil) selected_.insert({Group::v, kByHand});
    }

    bool is_used(const ast::Name& name) const { return used_.contains(upper(name.text)); }
    /// Names in an included file are also for other programs.
    bool is_shared(const ast::Name& name) const {
        return &sources_.file_at(name.span.offset) != &sources_.program();
    }

    void check_signal(const ast::Variable& variable, std::string_view why) {
        const bool by_address = used_.contains(plain(variable.address.text));
        if (is_used(variable.name) || by_address || is_shared(variable.name)) return;
        report_.add("W034", variable.name.span,
                    fmt::format("'{}' is declared, but {}", variable.name.text, why), "use it, or delete it");
    }

    void check_group(const ast::Group& group) {
        if (sequences_at_.contains(group.name.span.offset) || used_steps_.contains(upper(group.name.text)) ||
            is_shared(group.name))
            return;
        report_.add(
            "W034", group.name.span,
            fmt::format("the group '{}' is declared, but nothing uses it", group.name.text),
            fmt::format("use it, as in ON condition IN {0} NEXT := Step; or delete it", group.name.text));
    }

    std::optional<std::uint8_t> register_named(const ast::Name& name) const {
        for (const MotorName& known : symbols_.motor_names) {
            if (same_name(known.name, name.text)) return known.number;
        }
        for (const set_points::SetPoint& point : symbols_.set_points.values) {
            const bool is_register = point.kind == set_points::ValueKind::motor_register;
            if (is_register && same_name(point.name, name.text)) return point.reg;
        }
        return std::nullopt;
    }

    /// Without a value it may only name the register for tools; not if it is a register that only commands
    /// select.
    void check_register(const ast::Name& name, bool has_value) {
        const auto number = register_named(name);
        const auto place = number ? selection_of(*number) : std::nullopt;
        if (!place || is_shared(name)) return;
        const bool is_selected = selects_by_number_ || selected_.contains({place->group, place->index});
        // A later value may use it: Last AT P2 := 360 deg - 6 * Pitch.
        if (is_selected || is_used(name)) return;
        if (has_value) {
            report_.add(
                "W033", name.span,
                fmt::format("'{}' gets a value and is never selected: the motor does not use it", name.text),
                help_to_select(*place, name.text));
        } else {
            report_.add("W034", name.span, fmt::format("'{}' is declared, but nothing uses it", name.text),
                        "use it, or delete it");
        }
    }

    static std::string help_to_select(const Selection& place, std::string_view name) {
        constexpr std::uint8_t kFirstDistance = 7;
        if (place.group == Group::p && place.index >= kFirstDistance)
            return fmt::format(
                "POSITION({}); moves there, MOVE_P{}_BY_P_SOLL; by that distance; or delete it", name,
                place.index);
        if (place.group == Group::p) return fmt::format("POSITION({}); moves there; or delete it", name);
        return fmt::format("add it to the INIT(..) of POWER_UP, or delete it");
    }

    const ast::Program& program_;
    const Plan& plan_;
    const Sources& sources_;
    const Symbols& symbols_;
    Report& report_;
    std::unordered_set<std::string> used_;        ///< names and addresses, upper case
    std::unordered_set<std::string> used_steps_;  ///< and groups
    std::unordered_set<std::uint32_t> sequences_at_;
    std::set<Place> selected_;
    bool selects_by_number_ = false;
};

}  // namespace

void check_unused(const ast::Program& program, const Plan& plan, const Sources& sources,
                  const Symbols& symbols, Report& report) {
    Unused(program, plan, sources, symbols, report).run();
}

}  // namespace nplc::seqc
