#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/session.h"
#include "nanofleet/key_files.h"

namespace nplc::nanofleet::cli {
namespace {

struct KeyOptions {
    std::string name;
    std::string folder = ".";
};

Json document_of(const orders::TrustedKey& key) {
    return {{"name", key.name}, {"public_key", orders::hex(key.key)}};
}

void make(const Common& common, const KeyOptions& options) {
    const orders::TrustedKey key = make_key(options.folder, options.name);
    command_line::tell(
        common,
        fmt::format(
            "{0}/{1}.key is the secret key: it stays where orders are signed, and is backed up like a "
            "key of the "
            "plant\n{0}/{1}.pub goes to the gateways, into the folder of `[mqtt.orders] keys`",
            options.folder, key.name),
        document_of(key));
}

void list(const Common& common, const KeyOptions& options) {
    std::string text;
    Json keys = Json::array();
    for (const KeyFiles& files : list_keys(options.folder)) {
        text += fmt::format("{}{:<16} {} {}", text.empty() ? "" : "\n", files.key.name,
                            orders::hex(files.key.key), files.has_secret ? "secret key too" : "public");
        keys.push_back(document_of(files.key));
        keys.back()["secret"] = files.has_secret;
    }
    command_line::tell(common, text.empty() ? fmt::format("{}: no keys", options.folder) : text,
                       {{"keys", keys}});
}

void tell_public(const Common& common, const KeyOptions& options) {
    const orders::TrustedKey key = public_of(read_secret_file(options.name));
    std::string text = orders::write_public(key);
    text.pop_back();
    command_line::tell(common, text, document_of(key));
}

using Work = void (*)(const Common&, const KeyOptions&);

command_line::Added<KeyOptions> add(arguments::App& app, Common& common, const std::string& name,
                                    const std::string& text, Work work) {
    return command_line::add_command<KeyOptions>(app, name, text, [work, &common](const KeyOptions& options) {
        command_line::guard(common, [&] { work(common, options); });
    });
}

}  // namespace

void add_keys(arguments::App& app, Common& common) {
    arguments::App& keys = command_line::add_command(app, "keys", "Keys that orders are signed with");
    keys.require_subcommand(1);
    const auto in_folder = [](const command_line::Added<KeyOptions>& added) {
        added.command.add_option("--folder", added.options.folder, "Where the files are")
            ->capture_default_str();
    };
    const auto made = add(keys, common, "make", "Make NAME.key and NAME.pub", make);
    made.command.add_option("NAME", made.options.name, "Letters, digits, - and _")->required();
    in_folder(made);
    in_folder(add(keys, common, "list", "Keys of a folder", list));
    const auto told =
        add(keys, common, "public", "Print the public key of a secret one, as its .pub file", tell_public);
    told.command.add_option("FILE", told.options.name, "NAME.key")->required();
}

}  // namespace nplc::nanofleet::cli
