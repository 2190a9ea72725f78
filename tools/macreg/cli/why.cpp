#include "macreg/why.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/session.h"
#include "macreg/values.h"

namespace nplc::macreg::cli {
namespace {

using registers::Model;
using registers::Register;

std::string_view name_of(Severity severity) {
    switch (severity) {
        case Severity::stops:
            return "stops";
        case Severity::hinders:
            return "hinders";
        case Severity::tells:
            break;
    }
    return "tells";
}

void why(Session& session) {
    const Condition condition = read_condition(session.motor());
    std::string text;
    Json list = Json::array();
    unsigned number = 0;
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
        text += fmt::format("{}{}. {}\n", text.empty() ? "" : "\n", ++number, finding.sentence);
        if (!values.empty()) text += fmt::format("   {}\n", values);
        text += fmt::format("   -> {}\n", finding.remedy);
        list.push_back({{"code", finding.code},
                        {"severity", name_of(finding.severity)},
                        {"sentence", finding.sentence},
                        {"registers", registers},
                        {"remedy", finding.remedy}});
    }
    text.pop_back();
    session.tell(text, {{"findings", list}});
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
