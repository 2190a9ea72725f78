#include "compiler/scope.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "language/names.h"
#include "sequencer/term.h"
#include "symbols/motors.h"

namespace nplc::seqc {
namespace {

constexpr std::size_t kInputs = 6;
constexpr std::size_t kOutputs = 4;

/// IN0, %IX0.0 and the like: the number in the address, or empty if it is no address.
std::optional<std::size_t> address_number(std::string_view text, char direction) {
    const std::string address = upper(text);
    const std::string_view plain = direction == 'I' ? "IN" : "OUT";
    const std::string located = fmt::format("%{}X0.", direction);
    const std::string_view prefix = address.starts_with('%') ? std::string_view(located) : plain;
    if (!address.starts_with(prefix) || address.size() == prefix.size() ||
        address.size() > prefix.size() + 2) {
        return std::nullopt;
    }
    const bool has_zero_before = address.size() > prefix.size() + 1 && address[prefix.size()] == '0';
    if (has_zero_before) return std::nullopt;
    std::size_t number = 0;
    for (char c : address.substr(prefix.size())) {
        if (c < '0' || c > '9') return std::nullopt;
        number = number * 10 + static_cast<std::size_t>(c - '0');
    }
    return number;
}

/// I1, DI1, X1, O1, DO1: names of terminals on other controllers.
bool is_terminal_elsewhere(std::string_view name) {
    constexpr auto kTerminals = std::to_array<std::string_view>(
        {"I", "DI", "X", "E", "INPUT", "IN_", "O", "DO", "Q", "Y", "A", "OUTPUT", "OUT_"});
    const std::size_t letters = std::min(name.find_first_of("0123456789"), name.size());
    const bool has_digits_only = name.find_first_not_of("0123456789", letters) == name.npos;
    const std::string word = upper(name.substr(0, letters));
    const bool is_word_alone = letters == name.size();
    return has_digits_only && std::find(kTerminals.begin(), kTerminals.end(), word) != kTerminals.end() &&
           (!is_word_alone || word == "INPUT" || word == "OUTPUT");
}

std::string addresses(char direction, std::size_t count) {
    const std::string_view plain = direction == 'I' ? "IN" : "OUT";
    return fmt::format("%{}X0.0..%{}X0.{} ({}0..{}{})", direction, direction, count - 1, plain, plain,
                       count - 1);
}

}  // namespace

Scope::Scope(const ast::Program& program, std::string_view source, Report& report, Compilation& result)
    : source_(source), report_(report), result_(result), constants_(report) {
    for (std::size_t i = 0; i < kInputs; ++i) result.symbols.inputs[i] = fmt::format("IN{}", i);
    for (std::size_t i = 0; i < kOutputs; ++i) result.symbols.outputs[i] = fmt::format("OUT{}", i);
    result.symbols.program = program.name.text;
    names_missing_ = program.names_missing;
    scale_missing_ = program.scale_missing && !program.scale;
    motor_known_ = program.motor_missing;
    for (std::string_view name : program.faulty_names) faulty_.insert(upper(name));
    for (const ast::Use& use : program.uses) {
        if (use.declares) declared_.emplace(use.span.offset, declared_.size());
    }
    for (const ast::Sequence& sequence : program.sequences) sequences_.push_back(sequence.name.text);
    for (const ast::Group& group : program.groups) groups_.push_back(group.name.text);
    declare_motor(program);
    declare_scale(program);
    declare_steps(program);
    declare_io(program.inputs, inputs_, 'I', kInputs);
    declare_io(program.outputs, outputs_, 'Q', kOutputs);
    for (const Variable& v : inputs_) result.symbols.inputs[v.bit] = v.name;
    for (const Variable& v : outputs_) result.symbols.outputs[v.bit] = v.name;
    declare_constants(program);
    declare_motor_variables(program);
    declare_set_points(program);
}

const Scope::Variable* Scope::find(const std::vector<Variable>& variables, std::string_view name) {
    for (const Variable& variable : variables) {
        if (same_name(variable.name, name)) return &variable;
    }
    return nullptr;
}

void Scope::declare_motor(const ast::Program& program) {
    if (!program.motor) return;
    motor_known_ = true;
    motor_span_ = program.motor->span;
    if (const auto choice = motor_named(program.motor->text)) {
        model_ = choice->map;
        drive_ = choice->drive;
        result_.symbols.motor = model_;
        result_.symbols.drive = drive_;
        return;
    }
    const auto known = motor_names();
    std::vector<std::string_view> names(known.begin(), known.end());
    const auto shared = [&](std::string_view name) {
        const std::string written = upper(program.motor->text);
        return std::mismatch(name.begin(), name.end(), written.begin(), written.end()).first - name.begin();
    };
    std::stable_sort(names.begin(), names.end(),
                     [&](std::string_view a, std::string_view b) { return shared(a) > shared(b); });
    std::string help = suggestion(program.motor->text,
                                  names);  // among equally similar ones, those with the same first digits
    report_.add("E030", program.motor->span, fmt::format("there is no motor '{}'", program.motor->text),
                help.empty() ? motor_names_text() : fmt::format("{} ({})", help, motor_names_text()));
}

void Scope::declare_scale(const ast::Program& program) {
    if (!program.scale) return;
    const ast::Scale& scale = *program.scale;
    for (std::string_view taken : {"rev", "rpm", "counts", "count", "samples", "s", "ms"}) {
        if (!same_name(scale.unit.text, taken)) continue;
        report_.add("E032", scale.unit.span, fmt::format("'{}' is a unit already", scale.unit.text),
                    "SCALE names a unit of your machine, such as mm or deg");
        return;
    }
    scale_span_ = scale.span;
    length_ = LengthUnit{scale.unit.text, scale.length / scale.revolutions};
    result_.symbols.scale = Scale{scale.revolutions, scale.length, std::string(scale.unit.text)};
}

void Scope::declare_steps(const ast::Program& program) {
    steps_missing_ = program.steps_missing;
    for (const ast::Step& step : program.steps) {
        const auto [earlier, is_new] = step_places_.try_emplace(upper(step.name.text), steps_.size());
        if (!is_new) {
            report_
                .add("E020", step.name.span, fmt::format("step '{}' stands twice", step.name.text),
                     "give one of them another name")
                .notes.push_back({steps_[earlier->second]->name.span, "the first one is here"});
            continue;
        }
        steps_.push_back(&step);
    }
    number_steps();
}

bool Scope::stands_before(Span a, Span b) const {
    const auto first = declared_.find(a.offset);
    const auto second = declared_.find(b.offset);
    if (first == declared_.end() || second == declared_.end()) return a.offset < b.offset;
    return first->second < second->second;
}

bool Scope::is_new_name(const ast::Name& name) {
    const auto refuse_twice = [&](Span other) {
        const bool is_later = stands_before(other, name.span);
        report_
            .add("E020", is_later ? name.span : other, fmt::format("'{}' is declared twice", name.text),
                 "choose another name")
            .notes.push_back({is_later ? other : name.span, "the first declaration is here"});
    };
    const std::string_view text = name.text;
    if (address_number(text, 'I') || address_number(text, 'Q') || registers::find(model_, text) != nullptr) {
        report_.add(
            "E011", name.span,
            fmt::format("'{}' has a meaning already: {}", text,
                        registers::find(model_, text) ? "it is a register of the motor" : "it is an address"),
            "choose another name");
        faulty_.insert(upper(text));
        return false;
    }
    if (const ast::Constant* earlier = constants_.find(text)) {
        refuse_twice(earlier->name.span);
        faulty_.insert(upper(text));
        return false;
    }
    for (const auto* variables : {&inputs_, &outputs_, &motor_variables_}) {
        const Variable* earlier = find(*variables, text);
        if (earlier == nullptr) continue;
        refuse_twice(earlier->span);
        return false;
    }
    return true;
}

void Scope::declare_io(const std::vector<ast::Variable>& declared, std::vector<Variable>& variables,
                       char direction, std::size_t count) {
    for (const ast::Variable& variable : declared) {
        const auto number = address_number(variable.address.text, direction);
        if (!number || *number >= count) {
            report_.add("E022", variable.address.span,
                        fmt::format("'{}' is not an {}", variable.address.text,
                                    direction == 'I' ? "input" : "output"),
                        fmt::format("there are {}", addresses(direction, count)));
            faulty_.insert(upper(variable.name.text));
            continue;
        }
        const auto earlier = std::find_if(variables.begin(), variables.end(),
                                          [&](const Variable& v) { return v.bit == *number; });
        if (earlier != variables.end()) {
            report_
                .add("E022", variable.address.span,
                     fmt::format("'{}' has a name already", variable.address.text),
                     fmt::format("use '{}', or another {}", earlier->name,
                                 direction == 'I' ? "input" : "output"))
                .notes.push_back({earlier->span, "declared here"});
            faulty_.insert(upper(variable.name.text));
        } else if (is_new_name(variable.name)) {
            variables.push_back({variable.name.text, variable.name.span, *number, nullptr});
        }
    }
}

void Scope::declare_constants(const ast::Program& program) {
    for (const ast::Constant& constant : program.constants) {
        if (!is_new_name(constant.name)) continue;
        if (is_known_unit(constant.name.text) || (length_ && same_name(length_->name, constant.name.text))) {
            report_.add("E011", constant.name.span, fmt::format("'{}' is a unit", constant.name.text),
                        "choose another name");
        } else if (constants_.declare(constant)) {
            note_time(*constants_.find(constant.name.text));
            continue;
        }
        faulty_.insert(upper(constant.name.text));
    }
}

/// For properties and scenarios.
void Scope::note_time(const ast::Constant& constant) {
    const ast::Value& value = constant.value;
    const bool is_seconds = same_name(value.unit.text, "s");
    if (!value.is_time && !is_seconds && !same_name(value.unit.text, "ms")) return;
    const double milliseconds = value.number * (is_seconds ? 1000 : 1);
    constexpr double kLongest = 3'600'000;
    if (milliseconds >= 0 && milliseconds <= kLongest && milliseconds == std::floor(milliseconds))
        result_.symbols.times.push_back(
            {std::string(constant.name.text), static_cast<std::uint32_t>(milliseconds)});
}

void Scope::declare_motor_variables(const ast::Program& program) {
    for (const ast::Variable& variable : program.motor_variables) {
        const registers::Register* target =
            variable.register_number ? reg(*variable.register_number) : reg(variable.address);
        if (target == nullptr) faulty_.insert(upper(variable.name.text));
        if (!is_new_name(variable.name) || target == nullptr) continue;
        const std::string_view shown = variable.register_number ? target->name : variable.address.text;
        const auto earlier = std::find_if(motor_variables_.begin(), motor_variables_.end(),
                                          [&](const Variable& v) { return v.reg == target; });
        if (earlier != motor_variables_.end()) {
            report_
                .add("E022", variable.name.span, fmt::format("{} has a name already", shown),
                     fmt::format("use '{}', or another register", earlier->name))
                .notes.push_back({earlier->span, "declared here"});
            faulty_.insert(upper(variable.name.text));
            continue;
        }
        motor_variables_.push_back({variable.name.text, variable.name.span, 0, target});
        MotorName& named = result_.symbols.motor_names.emplace_back();
        named = {std::string(variable.name.text), std::string(target->name), target->number, {}};
        if (!variable.value) continue;
        constants_.name_registers(true);
        const auto bits = value(*variable.value, *target, shown);
        constants_.name_registers(false);
        if (bits) {
            declare_value_of(variable, *target, *bits);
            const Span first = variable.name.span;
            const Span last = variable.value->span;
            initial_values_.push_back(
                {target, 0, *bits, {first.offset, last.offset + last.length - first.offset}});
            named.initial = static_cast<std::int64_t>(number_of_bits(*bits, target->format));
        } else {
            faulty_.insert(upper(variable.name.text));  // as a value: other ones may be worked out from it
        }
    }
}

/// Later values may use the register's actual value, in the unit of its own value.
void Scope::declare_value_of(const ast::Variable& variable, const registers::Register& reg,
                             std::uint32_t bits) {
    const auto written = constants_.worked_out(*variable.value, &reg, model_);
    if (!written || written->is_raw) return;
    const auto per_unit =
        raw_per_unit(reg, model_, length_, written->is_time ? std::string_view("ms") : written->unit.text);
    if (!per_unit) return;
    ast::Value real = *written;
    real.number = number_of_bits(bits, reg.format) / *per_unit;
    real.span = variable.value->span;
    constants_.declare_register(variable.name, real);
}

bool Scope::is_faulty(std::string_view name) {
    const bool known = names_missing_ || faulty_.contains(upper(name));
    if (known) ++faulty_names_met_;
    return known;
}

bool Scope::is_step(std::string_view name) const {
    return step_places_.contains(upper(name));
}

std::optional<std::uint8_t> Scope::step(const ast::Name& name, const std::vector<std::string_view>& groups) {
    const auto place = step_places_.find(upper(name.text));
    if (place != step_places_.end()) return numbers_[place->second];
    if (steps_missing_) return std::nullopt;
    std::vector<std::string_view> names = groups;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
        if (numbers_[i] <= kLastNamed) names.push_back(steps_[i]->name.text);
    }
    std::string help = suggestion(name.text, names);
    const bool is_sequence = std::find(sequences_.begin(), sequences_.end(), name.text) != sequences_.end();
    if (help.empty() || is_sequence || is_group(name.text)) help = help_for_step(name.text);
    report_.add("E021", name.span,
                fmt::format("there is no {} '{}'", groups.empty() ? "step" : "step or group", name.text),
                help);
    return std::nullopt;
}

bool Scope::is_group(std::string_view name) const {
    return std::any_of(groups_.begin(), groups_.end(),
                       [&](std::string_view group) { return same_name(group, name); });
}

std::string Scope::help_for_step(std::string_view name) const {
    for (std::string_view sequence : sequences_) {
        const bool is_it = same_name(sequence, name);
        if (is_it || upper(name).starts_with(upper(sequence) + "_"))
            return fmt::format("{}: write CALL {}(..); NEXT := Step;",
                               is_it ? "it is a SEQUENCE" : "the steps of a SEQUENCE are entered through it",
                               sequence);
    }
    if (is_group(name)) return "it is a GROUP of several steps: name the one that is meant";
    return fmt::format("write STEP {}: ... END_STEP, or name one of the steps there are", name);
}

std::string Scope::how_to_declare(std::string_view name, const std::vector<Variable>& variables,
                                  char direction, std::size_t count) {
    const char* block = direction == 'I' ? "VAR_INPUT" : "VAR_OUTPUT";
    for (std::size_t bit = 0; bit < count; ++bit) {
        const bool taken =
            std::any_of(variables.begin(), variables.end(), [&](const Variable& v) { return v.bit == bit; });
        if (!taken)
            return fmt::format("declare it under {}: {} AT %{}X0.{} : BOOL;", block, name, direction, bit);
    }
    return fmt::format("name one of those under {}: all {} addresses have a name", block, count);
}

std::optional<std::size_t> Scope::signal(const ast::Name& name, const std::vector<Variable>& variables,
                                         char direction, std::size_t count) {
    if (const Variable* variable = find(variables, name.text)) return variable->bit;
    const auto number = address_number(name.text, direction);
    if (number && *number < count) return number;
    const bool input = direction == 'I';
    if (number) {
        report_.add("E022", name.span,
                    fmt::format("there is no {} '{}'", input ? "input" : "output", name.text),
                    fmt::format("there are {}", addresses(direction, count)));
        return std::nullopt;
    }
    if (is_faulty(name.text)) return std::nullopt;
    const bool other = input ? is_output(name.text) || address_number(name.text, 'Q').has_value()
                             : is_input(name.text) || address_number(name.text, 'I').has_value();
    std::vector<std::string_view> names;
    names.reserve(variables.size() + 2);
    for (const Variable& variable : variables) names.push_back(variable.name);
    if (input) names.insert(names.end(), {"INPOS", "ERROR", "TRUE", "FALSE"});
    std::string help = suggestion(name.text, names);
    if (help.empty()) help = how_to_declare(name.text, variables, direction, count);
    if (!input && (same_name(name.text, "NONE") || same_name(name.text, "NOTHING")))
        help = "leave OUT out: what no OUT of the step names is off";
    if (input && is_terminal_elsewhere(name.text)) help = "inputs are IN0 to IN5, and the names of VAR_INPUT";
    if (!input && is_terminal_elsewhere(name.text))
        help = "outputs are OUT0 to OUT3, and the names of VAR_OUTPUT";
    if (other) {
        Diagnostic& d = report_.add(
            "E023", name.span, fmt::format("'{}' is an {}", name.text, input ? "output" : "input"),
            input ? "a condition can test inputs, INPOS, ERROR, TIMER.Q and COUNTER.Q" : "OUT takes outputs");
        const Variable* declared = find(input ? outputs_ : inputs_, name.text);
        if (declared != nullptr) d.notes.push_back({declared->span, "declared here"});
    } else {
        report_.add("E021", name.span,
                    fmt::format("there is no {} '{}'", input ? "input" : "output", name.text), help);
    }
    return std::nullopt;
}

std::optional<std::size_t> Scope::input(const ast::Name& name) {
    return signal(name, inputs_, 'I', kInputs);
}
std::optional<std::size_t> Scope::output(const ast::Name& name) {
    return signal(name, outputs_, 'Q', kOutputs);
}

bool names_error(const ast::Expression& expression) {
    using Kind = ast::Expression::Kind;
    return expression.kind == Kind::error || expression.kind == Kind::any_error ||
           std::any_of(expression.operands.begin(), expression.operands.end(), names_error);
}

Truth Scope::truth_of(const ast::Expression& expression) {
    using Kind = ast::Expression::Kind;
    Truth truth;
    switch (expression.kind) {
        case Kind::constant:
            return expression.value ? always() : Truth();
        case Kind::any_error:
            return always();
        case Kind::in_pos:
            return truth_of_bit(kInPosBit);
        case Kind::error:
            return truth_of_bit(kErrorBit);
        case Kind::timer_q:
            return truth_of_bit(kTimerZero);
        case Kind::counter_q:
            return truth_of_bit(kCounterZero);
        case Kind::name: {
            const auto bit = input(expression.name);
            return bit ? truth_of_bit(*bit) : Truth();
        }
        case Kind::rising:
        case Kind::falling:
            return truth_of_edge(expression);
        case Kind::step:  // in properties only
            return {};
        case Kind::negation:
            return ~truth_of(expression.operands.front());
        case Kind::all_of:
            truth.set();
            for (const auto& operand : expression.operands) truth &= truth_of(operand);
            return truth;
        case Kind::any_of:
            for (const auto& operand : expression.operands) truth |= truth_of(operand);
            return truth;
        case Kind::odd_of:
            for (const auto& operand : expression.operands) truth ^= truth_of(operand);
            return truth;
    }
    return truth;
}

Truth Scope::truth_of_edge(const ast::Expression& expression) {
    const auto bit = input(expression.name);
    if (!bit) return {};
    if (edges_ == nullptr) {
        report_.add("E066", expression.span, "an edge can be seen only by a branch of a step",
                    "write IF R_TRIG(..) in the step; what many steps have in common, OUT and TERM take the "
                    "input itself");
        return {};
    }
    const bool rising = expression.kind == ast::Expression::Kind::rising;
    for (std::size_t i = 0; i < edges_->size(); ++i) {
        const Edge& edge = (*edges_)[i];
        if (edge.bit == *bit && edge.rising == rising)
            return Memory::is_armed(armed_, i) ? edge.seen() : Truth();
    }
    return {};
}

Truth Scope::branch_truth(const ast::Expression& condition) {
    const Truth truth = truth_of(condition);
    return names_error(condition) ? truth : truth & ~truth_of_bit(kErrorBit);
}

namespace {

constexpr std::uint8_t kNone = sequencer::kLastStep;

}  // namespace

const ast::Step* Scope::step_numbered(std::uint8_t number) const {
    const auto found = std::find(numbers_.begin(), numbers_.end(), number);
    if (number == kNone || found == numbers_.end()) return nullptr;
    return steps_[static_cast<std::size_t>(found - numbers_.begin())];
}

std::optional<std::uint8_t> Scope::written_number(const ast::Step& step) {
    if (!step.number) return std::nullopt;
    const ast::Value& value = *step.number;
    const bool plain = value.unit.text.empty() && !value.is_time && std::floor(value.number) == value.number;
    if (plain && value.number >= 0 && value.number <= kLastNamed)
        return static_cast<std::uint8_t>(value.number);
    Diagnostic& d = report_.add("E095", value.span, fmt::format("steps have the numbers 0..{}", kLastNamed),
                                "leave AT out if the number does not matter");
    if (plain && value.number == sequencer::kLastStep)
        d.notes.push_back({value.span, "62 in a NEXT means no switch, so this step could never be entered"});
    if (plain && value.number == sequencer::kEndOfTable) d.notes.push_back({value.span, "63 ends the table"});
    return std::nullopt;
}

/// AT first; the others get the lowest free numbers from 1 on. 0 is POWER_UP.
void Scope::number_steps() {
    numbers_.assign(steps_.size(), kNone);
    std::array<const ast::Step*, kLastNamed + 1U> owners{};
    for (std::size_t i = 0; i < steps_.size(); ++i) {
        const auto number = written_number(*steps_[i]);
        if (!number) continue;
        if (owners[*number] != nullptr) {
            report_
                .add("E095", steps_[i]->number->span,
                     fmt::format("'{}' has the number {} already", owners[*number]->name.text, *number),
                     "choose another number, or leave AT out")
                .notes.push_back({owners[*number]->number->span, "it is given here"});
            continue;
        }
        owners[*number] = steps_[i];
        numbers_[i] = *number;
    }
    std::uint8_t next = 1;
    bool too_many = false;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
        if (numbers_[i] != kNone) continue;
        while (next <= kLastNamed && owners[next] != nullptr) ++next;
        if (next <= kLastNamed) {
            numbers_[i] = next++;
        } else if (!too_many) {
            too_many = true;
            report_.add("E083", steps_[i]->name.span,
                        fmt::format("{} steps: a table holds at most {} named ones", steps_.size(),
                                    kLastNamed + (owners[0] != nullptr ? 1 : 0)),
                        "join steps, or use the counter for repetitions");
        }
    }
    for (std::size_t i = 0; i < steps_.size(); ++i) {
        if (numbers_[i] != kNone) result_.symbols.steps[numbers_[i]] = steps_[i]->name.text;
    }
}

}  // namespace nplc::seqc
