#include "editing/register_text.h"

#include <fmt/format.h>

#include "registers/details.h"
#include "report/register_facts.h"
#include "report/table_text.h"

namespace nplc::seqc::analysis {

std::string register_line(const Program& program, const registers::Register& reg) {
    return seqc::register_line(reg, program.symbols().motor, program.length_unit());
}

std::string register_text(const Program& program, const registers::Register& reg) {
    const registers::Details* details = registers::details_of(program.symbols().motor, reg.number);
    return fmt::format("**{}**, register {}{}{}\n\n", reg.name, reg.number, details != nullptr ? ": " : "",
                       details != nullptr ? details->title : "") +
           register_facts(reg, program.symbols().motor, program.length_unit());
}

std::string constant_text(const Program& program, const Constant& constant) {
    const auto shown = with_unit(constant.raw, constant.reg->number, &program.symbols());
    return shown ? fmt::format("{} ({})", constant.raw, *shown) : std::to_string(constant.raw);
}

}  // namespace nplc::seqc::analysis
