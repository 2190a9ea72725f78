#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/files.h"
#include "cli/session.h"
#include "macreg/values.h"

namespace nplc::macreg::cli {
namespace {

using registers::Model;
using registers::Register;

struct DiffArguments {
    std::string left;
    std::string right = "motor";
    bool partial = false;
};

std::string side(const Register& reg, Model model, std::optional<std::int64_t> raw) {
    return raw ? value_text(reg, model, *raw) : "(missing)";
}

Json raw_or_null(std::optional<std::int64_t> raw) {
    return raw ? Json(*raw) : Json(nullptr);
}

/// Not read before the file broke off, which is no difference.
bool is_missing(std::optional<std::int64_t> raw, const ParameterSet& set) {
    return !raw && !set.incomplete.empty();
}

void look_at_models(const DiffArguments& options, const ParameterSet& left, const ParameterSet& right) {
    if ((left.model == Model::mac800) == (right.model == Model::mac800)) return;
    throw UserError(fmt::format("{} is of {}, {} of {}: their registers cannot be compared", options.left,
                                model_words(left), options.right, model_words(right)));
}

void only_settings(ParameterSet& set) {
    for (auto& [number, raw] : set.values) {
        const Register& reg = *registers::find(set.model, number);
        raw &= static_cast<std::int32_t>(setting_bits(set.model, reg));
    }
}

void diff(Common& common, const DiffArguments& options) {
    ParameterSet left = read_parameter_file(options.left, options.partial);
    ParameterSet right = options.right == "motor" ? read_parameters(Session(common).motor(), {}, goes_on)
                                                  : read_parameter_file(options.right, options.partial);
    look_at_models(options, left, right);
    only_settings(left);
    only_settings(right);
    std::string text;
    Json list = Json::array();
    Json missing = Json::array();
    for (const Difference& one : differences(left, right)) {
        if (is_missing(one.left, left) || is_missing(one.right, right)) {
            missing.push_back(one.reg->name);
            continue;
        }
        text += fmt::format("{:<14} {} -> {}\n", one.reg->name, side(*one.reg, left.model, one.left),
                            side(*one.reg, left.model, one.right));
        list.push_back({{"name", one.reg->name},
                        {"number", one.reg->number},
                        {"left", raw_or_null(one.left)},
                        {"right", raw_or_null(one.right)}});
    }
    if (!list.empty()) common.exit_code = command_line::kRefused;
    if (text.empty()) text = fmt::format("{} and {}: no difference\n", options.left, options.right);
    if (!missing.empty())
        text += fmt::format("not compared: {} that an incomplete file does not have\n",
                            counted(missing.size(), "register"));
    text.pop_back();
    command_line::tell(common, text,
                       {{"same", list.empty()}, {"differences", list}, {"not_compared", missing}});
}

}  // namespace

void add_diff(arguments::App& app, Common& common) {
    const auto options = std::make_shared<DiffArguments>();
    arguments::App& command =
        add_command(app, "diff",
                    "Compare a file of `dump` with another one or with the motor; exit code 1 if "
                    "they differ");
    command.add_option("file", options->left, "The file")->required();
    command.add_option("other", options->right, "Another file, or `motor`")->capture_default_str();
    command.add_flag("--partial", options->partial, "Take files that are marked as incomplete");
    command.callback([options, &common] { guard(common, [&] { diff(common, *options); }); });
}

}  // namespace nplc::macreg::cli
