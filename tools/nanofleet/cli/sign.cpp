#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/session.h"
#include "nanofleet/key_files.h"
#include "orders/order.h"
#include "orders/pieces.h"
#include "orders/topics.h"
#include "set_points/record.h"
#include "uploads/uploads.h"
#include "whole_files/whole_files.h"

namespace nplc::nanofleet::cli {
namespace {

struct SignOptions {
    std::string table;
    std::string symbols;
    std::string proof;
    std::string name;
    std::string key;
    std::string target;
    std::string output;
    std::uint64_t counter = 0;
};

/// For users who publish with another program: the pieces are written beside the order, one file a message.
void sign(const Common& common, const SignOptions& options) {
    if (!orders::has_crypto()) throw UserError(std::string(orders::kNoCrypto));
    const orders::SecretKey secret = read_secret_file(options.key);
    const std::vector<std::uint8_t> artifact = artifact_of(options.table, options.symbols, options.proof);
    orders::Order order{.target = options.target,
                        .counter = options.counter,
                        .name = name_of_table(options.table, options.name)};
    if (!orders::is_target(order.target))
        throw UserError(fmt::format("'{}' is no target: write GROUP/NODE/AXIS", order.target));
    order.sha256 = orders::sha256(artifact);
    order.bytes = static_cast<std::uint32_t>(artifact.size());
    std::vector<whole_files::OutputFile> files{{options.output, orders::write_order(order, secret.seed)}};
    Json messages = Json::array({{{"topic", orders::order_topic(order.target)}, {"file", options.output}}});
    std::string text = fmt::format("{}: to be published, retained, at {}", options.output,
                                   orders::order_topic(order.target));
    for (std::size_t i = 0; i < orders::pieces_of(artifact.size()); ++i) {
        const auto piece = orders::piece_of(artifact, i);
        const std::string file = fmt::format("{}.{}", options.output, i);
        const std::string topic = orders::piece_topic(order.sha256, i);
        files.push_back({file, std::string(piece.begin(), piece.end())});
        messages.push_back({{"topic", topic}, {"file", file}});
        text += fmt::format("\n{}: likewise, at {}", file, topic);
    }
    if (const std::string problem = whole_files::write_files(files); !problem.empty())
        throw UserError(problem);
    command_line::tell(common, text,
                       {{"target", order.target},
                        {"counter", order.counter},
                        {"sha256", orders::hex(order.sha256)},
                        {"messages", messages}});
}

}  // namespace

std::vector<std::uint8_t> artifact_of(const std::string& file, const std::string& symbols,
                                      const std::string& proof) {
    const std::vector<std::uint8_t> table = uploads::read_table(file);
    std::vector<std::uint8_t> content =
        set_points::with_record(table, uploads::read_record(file, symbols, table));
    if (proof.empty()) return content;
    return uploads::with_digest(content, uploads::certificate_for(proof, table));
}

std::string name_of_table(const std::string& file, const std::string& name) {
    const std::string result = name.empty() ? std::filesystem::path(file).stem().string() : name;
    if (!orders::is_name(result, orders::kLongestName))
        throw UserError(fmt::format("'{}' is no name: 1 to {} printable characters; give one with --name",
                                    result, orders::kLongestName));
    return result;
}

void add_sign(arguments::App& app, Common& common) {
    const auto [command, options] = command_line::add_command<SignOptions>(
        app, "sign", "Sign an order for one axis, as files to be published",
        [&common](const SignOptions& given) { command_line::guard(common, [&] { sign(common, given); }); });
    command.add_option("TABLE", options.table, "F.bin or F.hex of seqc build")->required();
    command.add_option("--target", options.target, "GROUP/NODE/AXIS")->required();
    command.add_option("--counter", options.counter, "Greater than that of any order before it")->required();
    command.add_option("--key", options.key, "NAME.key")->required();
    command.add_option("--name", options.name, "Of the table, for people; the file's if left out");
    command.add_option("--sym", options.symbols, "F.sym, if it is not beside the table");
    command.add_option("--proof", options.proof, "F.proof of seqc verify");
    command.add_option("-o,--output", options.output, "The order's file; FILE.0, FILE.1 ... are the pieces")
        ->required();
}

}  // namespace nplc::nanofleet::cli
