#include "nanofleet/fleet.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "orders/order.h"
#include "toml_files/toml_file.h"

namespace nplc::nanofleet {
namespace {

using toml_files::Value;

/// Reads values of a fleet's file; the first error is kept.
class Reader {
  public:
    Reader(FleetReading& result, std::string folder) : result_(result), folder_(std::move(folder)) {}

    bool is_right() const { return result_.error.empty(); }
    void complain(int line, const std::string& text) {
        if (is_right()) result_.error = fmt::format("{}: {}", line, text);
    }
    void only(const Value& table, const std::set<std::string_view>& keys) {
        for (const auto& [key, value] : table.entries) {
            if (!keys.contains(key)) complain(value.line, fmt::format("there is no key `{}` here", key));
        }
    }
    std::string text(const Value& table, std::string_view key, bool is_required = false) {
        const Value* value = table.find(key);
        if (value == nullptr) {
            if (is_required) complain(table.line, fmt::format("`{}` is missing here", key));
            return {};
        }
        if (value->kind != Value::Kind::text || value->text.empty())
            complain(value->line, fmt::format("`{}` must be a text", key));
        return value->text;
    }
    std::string file(const Value& table, std::string_view key, bool is_required = false) {
        const std::string name = text(table, key, is_required);
        return name.empty() || name.front() == '/' || folder_.empty() ? name
                                                                      : fmt::format("{}/{}", folder_, name);
    }

  private:
    FleetReading& result_;
    std::string folder_;
};

void read_broker(Reader& reader, const Value& root, broker::Options& broker) {
    const Value* table = root.find("broker");
    if (table == nullptr || table->kind != Value::Kind::table)
        return reader.complain(1, "there must be a table [broker] with its `address`");
    reader.only(*table, {"address", "user", "password_file", "ca_file", "certificate_file", "key_file"});
    const std::string address = reader.text(*table, "address", true);
    if (!broker::read_address(address, broker))
        reader.complain(table->line, "`address` is no broker; write HOST:PORT such as \"192.168.10.2:1883\"");
    broker.user = reader.text(*table, "user");
    broker.password_file = reader.file(*table, "password_file");
    broker.ca_file = reader.file(*table, "ca_file");
    broker.certificate_file = reader.file(*table, "certificate_file");
    broker.key_file = reader.file(*table, "key_file");
    for (const broker::Mistake& mistake : broker::mistakes_of(broker))
        reader.complain(table->line, fmt::format("`{}` {}", mistake.key, mistake.text));
}

Group read_group(Reader& reader, const Value& table, std::set<std::string>& targets) {
    reader.only(table, {"name", "table", "symbols", "proof", "gateways"});
    Group group{.name = reader.text(table, "name", true), .table = reader.file(table, "table", true)};
    group.symbols = reader.file(table, "symbols");
    group.proof = reader.file(table, "proof");
    const Value* list = table.find("gateways");
    if (list == nullptr || list->kind != Value::Kind::list || list->items.empty()) {
        reader.complain(table.line, "`gateways` must be a list such as [\"hall2/cell4/x\"]");
        return group;
    }
    for (const Value& item : list->items) {
        if (item.kind != Value::Kind::text || !orders::is_target(item.text))
            reader.complain(item.line, "a gateway is GROUP/NODE/AXIS, such as \"hall2/cell4/x\"");
        else if (!targets.insert(item.text).second)
            reader.complain(item.line, fmt::format("{} stands here twice", item.text));
        group.gateways.push_back(item.text);
    }
    return group;
}

}  // namespace

const Group* Fleet::find(std::string_view name) const {
    const auto place =
        std::find_if(groups.begin(), groups.end(), [name](const Group& group) { return group.name == name; });
    return place == groups.end() ? nullptr : &*place;
}

FleetReading read_fleet(std::string_view text, const std::string& folder) {
    FleetReading result;
    const toml_files::File file = toml_files::read_toml(text);
    if (!file.error.empty()) return {.error = fmt::format("{}: {}", file.line, file.error)};
    Reader reader(result, folder);
    reader.only(file.root, {"broker", "group"});
    read_broker(reader, file.root, result.fleet.broker);
    const Value* groups = file.root.find("group");
    if (groups == nullptr || groups->kind != Value::Kind::list)
        reader.complain(1, "there must be a [[group]] with `name`, `table` and `gateways`");
    std::set<std::string> targets;
    for (std::size_t i = 0; reader.is_right() && i < groups->items.size(); ++i) {
        const Value& item = groups->items[i];
        if (item.kind != Value::Kind::table) {
            reader.complain(item.line, "a group is written as [[group]]");
            break;
        }
        Group group = read_group(reader, item, targets);
        if (result.fleet.find(group.name) != nullptr)
            reader.complain(item.line, fmt::format("there are two groups {}", group.name));
        result.fleet.groups.push_back(std::move(group));
    }
    return result;
}

}  // namespace nplc::nanofleet
