#include "cli/verify_emit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "analysis/emit.h"
#include "host/printable.h"

namespace nplc::seqc::cli {

int emit_question(const std::string& language, const Input& input,
                  const std::vector<verify::Property>& properties,
                  const std::vector<verify::Assumption>& assumptions, const std::string& output) {
    std::set<std::string> names;
    const auto is_stable = [](const verify::Assumption& a) { return a.stable_ms != 0; };
    if (const auto stable = std::find_if(assumptions.begin(), assumptions.end(), is_stable);
        stable != assumptions.end()) {
        return file_problem(
            fmt::format("{}: --emit writes scans, and an input changes between them: leave "
                        "STABLE out",
                        stable->text));
    }
    for (const verify::Property& property : properties) {
        if (!names.insert(property.name).second)
            return file_problem(
                fmt::format("there are two properties '{}': --emit needs one name for each", property.name));
    }
    const bool promela = language == "promela";
    const verify::Emission emission = promela ? verify::promela_of(input.table, properties, assumptions)
                                              : verify::smt2_of(input.table, properties, assumptions);
    if (properties.empty()) return file_problem("there is no property to emit: name a file with --property");
    if (emission.left_out.size() == properties.size()) {
        return file_problem(
            fmt::format("no property can be stated in {}{}", language,
                        promela ? ": ALWAYS POSSIBLE can in smt2" : ": WHILE .. FOR can in promela"));
    }
    if (!emission.left_out.empty()) {
        host::complain(fmt::format("seqc: left out, since {} cannot state them: {}", language,
                                   fmt::join(emission.left_out, ", ")));
    }
    return print_or_write(emission.text, output);
}

}  // namespace nplc::seqc::cli
