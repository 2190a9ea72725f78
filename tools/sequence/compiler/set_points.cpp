#include "compiler/set_points.h"

#include <fmt/format.h>

namespace nplc::seqc {

void check_set_points(const Plan& plan, const std::vector<DeclaredSetPoint>& points, const Symbols& symbols,
                      Report& report) {
    for (const DeclaredSetPoint& declared : points) {
        if (set_points::find(symbols.set_points, declared.point.name) != nullptr) continue;
        report.add("W025", declared.written->name.span,
                   fmt::format("nothing uses the set-point '{}'", declared.point.name),
                   "write TIMER := Name;, COUNTER := Name; or a register's name := Name; or delete it");
    }
    for (const StepPlan& step : plan.steps) {
        if (!step.takes_set_points || !symbols.set_points.values.empty()) continue;
        report.add("W025", step.span,
                   fmt::format("'{}' takes set-points, and the program has none", step.name),
                   "declare one with SET_POINT, or delete TAKES SET_POINTS");
    }
    const std::size_t bytes = set_points::encode(symbols.set_points).size();
    if (bytes <= registers::set_points::kMostRecordBytes) return;
    report.add("E027", points.front().written->name.span,
               fmt::format("the set-points need {} bytes beside the table, and a gateway keeps {}", bytes,
                           registers::set_points::kMostRecordBytes),
               "use shorter names, or each of them in fewer branches");
}

}  // namespace nplc::seqc
