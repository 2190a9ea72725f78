#include "report/power_up_values.h"

#include <fmt/format.h>

#include <set>

#include "report/table_text.h"

namespace nplc::seqc {
namespace {

using sequencer::MotorOrder;

}  // namespace

PowerUpValues::PowerUpValues(const Machine& before, const Machine& now)
    : before_(writes_of(before)), now_(writes_of(now)) {}

/// The common first writes of every transition from step 0, without registers that are written twice.
PowerUpValues::Writes PowerUpValues::writes_of(const Machine& machine) {
    Writes writes;
    std::set<std::uint8_t> twice;
    for (const MotorOrder& order : power_up_orders(machine)) {
        if (order.is_register_write && !writes.emplace(order.reg, order).second) twice.insert(order.reg);
    }
    for (const std::uint8_t reg : twice) writes.erase(reg);
    return writes;
}

std::vector<TableDiff::Value> PowerUpValues::changes(const Symbols* names_before,
                                                     const Symbols* names_now) const {
    std::set<std::uint8_t> registers;
    for (const auto& [reg, order] : before_) registers.insert(reg);
    for (const auto& [reg, order] : now_) registers.insert(reg);
    const Symbols* names = names_now != nullptr ? names_now : names_before;
    std::vector<TableDiff::Value> changes;
    for (const std::uint8_t reg : registers) {
        const auto before = before_.find(reg);
        const auto now = now_.find(reg);
        const bool both = before != before_.end() && now != now_.end();
        if (both && before->second == now->second) continue;
        TableDiff::Value change{.reg = register_name(reg, names),
                                .name = register_as_named(reg, names),
                                .before = {},
                                .now = {},
                                .before_in_units = {},
                                .now_in_units = {}};
        const auto tell = [&](const MotorOrder& order, const Symbols* symbols,
                              std::optional<std::string>& value, std::string& units) {
            const std::int64_t number = value_of(order, symbols);
            value = std::to_string(number);
            units = with_machine_unit(number, reg, symbols).value_or("");
        };
        if (before != before_.end())
            tell(before->second, names_before, change.before, change.before_in_units);
        if (now != now_.end()) tell(now->second, names_now, change.now, change.now_in_units);
        if (both && before->second.longword != now->second.longword) {
            *change.before += before->second.longword ? ", 32 bits" : ", 16 bits";
            *change.now += now->second.longword ? ", 32 bits" : ", 16 bits";
        }
        changes.push_back(std::move(change));
    }
    return changes;
}

void PowerUpValues::level(std::vector<MotorOrder>& before, std::vector<MotorOrder>& now) const {
    const auto is_told = [](const MotorOrder& order, const Writes& own) {
        const auto found = own.find(order.reg);
        return order.is_register_write && found != own.end() && found->second == order;
    };
    for (MotorOrder& order : before) {
        const auto other = now_.find(order.reg);
        if (is_told(order, before_) && other != now_.end()) order = other->second;
    }
    std::erase_if(before, [&](const MotorOrder& o) { return is_told(o, before_) && !now_.contains(o.reg); });
    std::erase_if(now, [&](const MotorOrder& o) { return is_told(o, now_) && !before_.contains(o.reg); });
}

}  // namespace nplc::seqc
