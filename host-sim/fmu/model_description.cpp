#include "model_description.h"

#include <fmt/format.h>

#include <iterator>
#include <numbers>
#include <string_view>

#include "sim/fmu/variables.h"
#include "sim/text.h"

namespace nplc::sim::fmu {
namespace {

struct DisplayUnit {
    std::string_view name;
    double factor;  // displayed = factor x value
};

struct UnitDefinition {
    std::string_view name;
    std::string_view base;  // attributes of BaseUnit
    std::vector<DisplayUnit> display;
};

std::vector<UnitDefinition> unit_definitions() {
    constexpr double kTurn = 2 * std::numbers::pi;
    return {{"s", R"(s="1")", {{"ms", 1000}}},
            {"rad", R"(rad="1")", {{"deg", 360 / kTurn}, {"rev", 1 / kTurn}}},
            {"rad/s", R"(rad="1" s="-1")", {{"rpm", 60 / kTurn}}},
            {"N.m", R"(kg="1" m="2" s="-2")", {{"mN.m", 1000}}},
            {"N.m/rad", R"(kg="1" m="2" s="-2" rad="-1")", {}},
            {"kg.m2", R"(kg="1" m="2")", {{"kg.cm2", 1e4}}}};
}

class Writer {
  public:
    explicit Writer(const FmuOptions& options)
        : options_(options), variables_(variables_of(options.setup, options.names)) {}

    std::string write() && {
        line("<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
        head();
        co_simulation();
        units();
        line("  <LogCategories>");
        line("    <Category name=\"logStatusError\" description=\"What was refused, and why\"/>");
        line("  </LogCategories>");
        line("  <DefaultExperiment startTime=\"0\" stopTime=\"10\" stepSize=\"{}\"/>", step());
        line("  <ModelVariables>");
        for (const Variable& variable : variables_) is_3() ? write_in_3(variable) : write_in_2(variable);
        line("  </ModelVariables>");
        line("  <ModelStructure>");
        is_3() ? structure_in_3() : structure_in_2();
        line("  </ModelStructure>");
        line("</fmiModelDescription>");
        return std::move(text_);
    }

  private:
    bool is_3() const { return options_.fmi == 3; }
    double step() const { return internal_step(options_.setup); }

    template <class... Arguments>
    void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
        text_ += '\n';
    }

    void head() {
        const bool with_gateway = options_.setup.table.has_value();
        const std::string description = fmt::format(
            "{} (JVL), virtual{}. {} Communication points may lie anywhere; time is kept in whole "
            "nanoseconds",
            registers::name_of(options_.setup.motor),
            with_gateway ? ", with a NanoPLC gateway and its sequence on the line to it" : "",
            with_gateway ? "Inputs are looked at every 250 us, and when a character arrives from the motor."
                         : "Inputs and outputs change with the motor's samples.");
        line(
            "<fmiModelDescription fmiVersion=\"{}\" modelName=\"{}\" {}=\"{}\" description=\"{}\" "
            "generationTool=\"nanoplc-sim {}\" variableNamingConvention=\"flat\">",
            is_3() ? "3.0" : "2.0", in_xml(options_.model_name), is_3() ? "instantiationToken" : "guid",
            token_of(options_.setup), in_xml(description), NPLC_VERSION);
    }

    /// A state is a copy of memory with addresses, valid in its own process only: it is not serialised.
    void co_simulation() {
        line("  <CoSimulation modelIdentifier=\"{}\" canHandleVariableCommunicationStepSize=\"true\" {}/>",
             kModelIdentifier,
             is_3() ? fmt::format("fixedInternalStepSize=\"{}\" canGetAndSetFMUState=\"true\" "
                                  "canSerializeFMUState=\"false\"",
                                  step())
                    : "canNotUseMemoryManagementFunctions=\"true\" canGetAndSetFMUstate=\"true\" "
                      "canSerializeFMUstate=\"false\"");
    }

    void units() {
        line("  <UnitDefinitions>");
        for (const UnitDefinition& unit : unit_definitions()) {
            line("    <Unit name=\"{}\">", unit.name);
            line("      <BaseUnit {}/>", unit.base);
            for (const DisplayUnit& display : unit.display)
                line("      <DisplayUnit name=\"{}\" factor=\"{}\"/>", display.name, display.factor);
            line("    </Unit>");
        }
        line("  </UnitDefinitions>");
    }

    static std::string_view causality_of(const Variable& variable) {
        switch (variable.causality) {
            case Causality::independent:
                return "independent";
            case Causality::parameter:
                return "parameter";
            case Causality::input:
                return "input";
            case Causality::output:
                break;
        }
        return "output";
    }

    static std::string_view variability_of(const Variable& variable) {
        if (variable.causality == Causality::parameter) return "fixed";
        return variable.kind == Kind::real ? "continuous" : "discrete";
    }

    static std::string common(const Variable& variable) {
        return fmt::format(
            "name=\"{}\" valueReference=\"{}\" description=\"{}\" causality=\"{}\" variability=\"{}\"",
            variable.name, static_cast<unsigned>(variable.id), in_xml(variable.description),
            causality_of(variable), variability_of(variable));
    }

    static bool has_start(const Variable& variable) {
        return variable.causality == Causality::parameter || variable.causality == Causality::input;
    }

    static std::string number(const Variable& variable, double value) {
        if (variable.kind == Kind::truth) return value != 0 ? "true" : "false";
        return fmt::format("{}", value);
    }

    /// Attributes of the type: unit, limits, start.
    static std::string details(const Variable& variable) {
        std::string text;
        if (!variable.unit.empty()) text += fmt::format(" unit=\"{}\"", variable.unit);
        if (variable.min) text += fmt::format(" min=\"{}\"", number(variable, *variable.min));
        if (variable.max) text += fmt::format(" max=\"{}\"", number(variable, *variable.max));
        if (has_start(variable)) text += fmt::format(" start=\"{}\"", number(variable, variable.start));
        return text;
    }

    void write_in_3(const Variable& variable) {
        constexpr std::string_view kTypes[] = {"Float64", "Int32", "UInt32", "Boolean"};
        line("    <{} {}{}/>", kTypes[static_cast<std::size_t>(variable.kind)], common(variable),
             details(variable));
    }

    void write_in_2(const Variable& variable) {
        constexpr std::string_view kTypes[] = {"Real", "Integer", "Integer", "Boolean"};
        line("    <ScalarVariable {}>", common(variable));
        line("      <{}{}/>", kTypes[static_cast<std::size_t>(variable.kind)], details(variable));
        line("    </ScalarVariable>");
    }

    /// At a communication point no output depends on an input: inputs act in the following step.
    void structure_in_3() {
        for (const std::string_view element : {"Output", "InitialUnknown"}) {
            for (const Variable& variable : variables_) {
                if (variable.causality == Causality::output)
                    line("    <{} valueReference=\"{}\" dependencies=\"\"/>", element,
                         static_cast<unsigned>(variable.id));
            }
        }
    }

    void structure_in_2() {
        for (const std::string_view element : {"Outputs", "InitialUnknowns"}) {
            line("    <{}>", element);
            for (std::size_t i = 0; i < variables_.size(); ++i) {
                if (variables_[i].causality == Causality::output)
                    line("      <Unknown index=\"{}\" dependencies=\"\"/>", i + 1);
            }
            line("    </{}>", element);
        }
    }

    const FmuOptions& options_;
    std::vector<Variable> variables_;
    std::string text_;
};

}  // namespace

std::string model_description(const FmuOptions& options) {
    return Writer(options).write();
}

}  // namespace nplc::sim::fmu
