#include "compiler/chosen_motor.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "compiler/drive.h"
#include "language/names.h"
#include "symbols/commands.h"
#include "symbols/motors.h"

namespace nplc::seqc {

void ChosenMotor::declare(const ast::Program& program) {
    is_known_ = program.motor_missing;
    scale_missing_ = program.scale_missing && !program.scale;
    declare_motor(program);
    declare_scale(program);
}

void ChosenMotor::declare_motor(const ast::Program& program) {
    if (!program.motor) return;
    is_known_ = true;
    span_ = program.motor->span;
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

void ChosenMotor::declare_scale(const ast::Program& program) {
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

std::string ChosenMotor::name() const {
    return std::string(seqc::motor_name(result_.symbols));
}

void ChosenMotor::require(Span span) {
    if (is_known_) return;
    is_known_ = true;
    report_.add("E031", span, "a register needs the name of the motor", "name it at the top: MOTOR MAC140;");
}

bool ChosenMotor::is_for_drive(const Send& send) {
    if (drive_ == nullptr || refusal_of(*drive_, send).empty()) return true;
    report_refusal(send, send.reg != nullptr
                             ? fmt::format("a {} cannot take {} for {}", name(),
                                           source_.substr(send.span.offset, send.span.length), send.reg->name)
                             : fmt::format("a {} cannot execute {}", name(), describe_command(send.command)));
    return false;
}

void ChosenMotor::report_refusal(const Send& send, std::string message) {
    report_.add("E044", send.span, std::move(message), std::string(refusal_of(*drive_, send)))
        .notes.push_back({span_, "the drive is chosen here"});
}

bool ChosenMotor::is_on_drive(const registers::Register& reg, Span span) {
    if (drive_ == nullptr) return true;
    const Send zero{&reg, 0, 0, span};
    const Send one{&reg, 0, 1, span};
    const registers::Refusal why = refusal_of(*drive_, zero);
    if (why.empty() || why != refusal_of(*drive_, one)) return true;
    report_refusal(zero, fmt::format("a {} has no {}", name(), reg.name));
    return false;
}

bool ChosenMotor::takes_zero(const registers::Register& reg) const {
    return drive_ == nullptr || refusal_of(*drive_, {&reg, 0, 0, {}}).empty();
}

}  // namespace nplc::seqc
