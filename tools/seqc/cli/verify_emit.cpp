#include "cli/verify_emit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "verify/emit.h"

namespace nplc::seqc::cli {

int emit_question(const std::string& language, const Input& input,
                  const std::vector<verify::Property>& properties, const std::string& output) {
    std::set<std::string> names;
    const auto is_other = [](const verify::Property& p) { return !verify::is_basic(p); };
    if (const auto other = std::find_if(properties.begin(), properties.end(), is_other);
        other != properties.end()) {
        return file_problem(
            fmt::format("property '{}': --emit takes NEVER, ALWAYS, IS REACHABLE, ALWAYS POSSIBLE and "
                        "WHENEVER .. WITHIN without moving",
                        other->name));
    }
    for (const verify::Property& property : properties) {
        if (!names.insert(property.name).second)
            return file_problem(
                fmt::format("there are two properties '{}': --emit needs one name for each", property.name));
    }
    const bool promela = language == "promela";
    const verify::Emission emission =
        promela ? verify::promela_of(input.table, properties) : verify::smt2_of(input.table, properties);
    if (properties.empty()) return file_problem("there is no property to emit: name a file with --property");
    if (emission.left_out.size() == properties.size()) {
        return file_problem(fmt::format("no property can be stated in {}{}", language,
                                        promela ? ": ALWAYS POSSIBLE can in smt2" : ""));
    }
    if (!emission.left_out.empty()) {
        fmt::print(stderr, "seqc: left out, since {} cannot state them: {}\n", language,
                   fmt::join(emission.left_out, ", "));
    }
    return print_or_write(emission.text, output);
}

}  // namespace nplc::seqc::cli
