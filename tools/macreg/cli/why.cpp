#include "macreg/why.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/findings.h"
#include "cli/session.h"
#include "macreg/values.h"

namespace nplc::macreg::cli {
namespace {

using registers::Model;
using registers::Register;

void why(Session& session) {
    const Condition condition = read_condition(session.motor());
    FindingsReport report("registers");
    for (const Finding& finding : macreg::why(condition)) {
        std::string values;
        Json registers = Json::array();
        for (const std::uint8_t one : finding.registers) {
            const Register* reg = registers::find(condition.model, one);
            if (reg == nullptr) continue;
            values += fmt::format("{}{} = {}", values.empty() ? "" : ", ", reg->name,
                                  long_value_text(*reg, condition.model, condition.now.at(one)));
            registers.push_back(value_document(*reg, condition.model, condition.now.at(one)));
        }
        report.add(finding, values, registers);
    }
    session.tell(report.text(), report.document());
}

}  // namespace

void add_why(arguments::App& app, Common& common) {
    add_command(
        app, "why",
        "Why does it not move? Sentences with the registers that make it so and what mends it, the first "
        "thing to mend in front")
        .callback([&common] { work(common, why); });
}

}  // namespace nplc::macreg::cli
