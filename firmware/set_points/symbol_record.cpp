#include "set_points/symbol_record.h"

#include "registers/set_points.h"
#include "set_points/record.h"

namespace nplc::set_points {
namespace {

using Json = nlohmann::json;
namespace layout = nplc::registers::set_points;

/// Reads the form written by `seqc build`; throws Json::exception.
SetPoint point_of(const Json& entry) {
    SetPoint point;
    point.name = entry.at("name").get<std::string>();
    if (const auto preset = entry.find("preset"); preset != entry.end()) {
        point.kind = *preset == "timer" ? ValueKind::timer : ValueKind::counter;
    } else {
        point.reg = entry.at("register").get<std::uint8_t>();
        point.longword = entry.at("longword").get<bool>();
        point.at_power_up = entry.at("at_power_up").get<bool>();
    }
    point.unit = entry.at("unit").get<std::string>();
    point.unit_code = entry.at("unit_code").get<std::uint8_t>();
    point.steps_per_unit = entry.at("steps_per_unit").get<double>();
    point.step = entry.value("step", 0.0);
    if (entry.contains("grid_from")) point.grid_from = entry.at("grid_from").get<double>();
    point.initial = entry.at("initial").get<std::int32_t>();
    point.lowest = entry.at("lowest").get<std::int32_t>();
    point.highest = entry.at("highest").get<std::int32_t>();
    point.places = entry.at("terms").get<std::vector<std::uint16_t>>();
    return point;
}

Record record_of(const Json& symbols) {
    Record record;
    for (const Json& entry : symbols.at("set_points")) record.values.push_back(point_of(entry));
    for (const Json& step : symbols.at("takes_set_points"))
        record.takes |= std::uint64_t{1} << (step.get<unsigned>() & 63U);
    return record;
}

}  // namespace

std::optional<std::vector<std::uint8_t>> record_in(const Json& symbols, std::span<const std::uint8_t> table) {
    if (!symbols.is_object() || !symbols.contains("set_points")) return std::vector<std::uint8_t>();
    try {
        const Record record = record_of(symbols);
        if (record.values.size() > layout::kMost) return std::nullopt;
        auto bytes = encode(record);
        const bool fits = bytes.size() <= layout::kMostRecordBytes && decode(bytes, table);
        return fits ? std::optional(std::move(bytes)) : std::nullopt;
    } catch (const Json::exception&) {
        return std::nullopt;
    }
}

}  // namespace nplc::set_points
