#include "panel_part.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "faces/program_version.h"
#include "panel/names.h"
#include "seat/secret.h"
#include "table_file.h"

namespace nplc::boards {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostSymbols = std::size_t{1024} * 1024;

/// Empty if it cannot be read or is too long.
std::string text_of(const std::string& path) {
    std::error_code error;
    const auto size = fs::file_size(path, error);
    if (error || size > kMostSymbols) return {};
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

std::string StoredNames::kept_file(std::size_t axis) const {
    return fmt::format("{}/{}/names.sym", config_.state_directory, config_.axes[axis].name);
}

StoredNames::Found StoredNames::find(std::size_t axis, std::uint32_t crc) {
    const std::string& table = config_.axes[axis].table.text;
    const std::string file = crc_of_table(table) == crc ? table : std::string();
    for (const std::string& path : {kept_file(axis), config_.axes[axis].symbols.text}) {
        if (path.empty()) continue;
        std::string text = text_of(path);
        if (!text.empty() && panel::is_for_table(text, crc)) return {file, std::move(text)};
    }
    return {file, {}};
}

/// Atomic: the old file stays until the new one is complete.
std::string StoredNames::keep(std::size_t axis, std::uint32_t crc, std::string_view text) {
    if (!panel::is_for_table(text, crc)) return "the names are those of another table";
    const std::string path = kept_file(axis);
    const std::string fresh = path + ".new";
    std::string why;
    {
        errno = 0;
        std::ofstream file(fresh, std::ios::binary | std::ios::trunc);
        file << text;
        file.flush();
        if (!file) why = std::strerror(errno);
    }
    std::error_code error;
    if (!why.empty()) {
        fs::remove(fresh, error);
        return fmt::format(
            "the names cannot be kept: {}: {}; nothing was stored; make room there, or upload the table "
            "alone",
            fresh, why);
    }
    fs::rename(fresh, path, error);
    return error ? fmt::format("the names cannot be kept: {}: {}; nothing was stored", path, error.message())
                 : std::string();
}

bool PanelPart::read_secret(const LocatedText& file, std::string& secret) {
    if (!file.is_there()) return true;
    const auto [text, error] = faces::read_secret(file.text, kMostPanelSecret);
    secret = text;
    if (!error.empty()) journal_.write(LogLevel::error, JournalEvent::face_missing, "no panel: " + error);
    return error.empty();
}

void PanelPart::open(const std::vector<std::unique_ptr<Axis>>& axes) {
    const PanelConfig& wanted = config_.panel;
    if (!wanted.listen.is_there()) return;
    panel::PanelOptions options;
    options.program = "nanoplc " + faces::program_version();
    options.web.address = wanted.address;
    options.web.port = wanted.port;
    options.web.hosts = wanted.hosts;
    if (!read_secret(wanted.token_file, options.token) ||
        !read_secret(wanted.password_file, options.password))
        return;
    std::vector<panel::PanelAxis> list;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        // For JVL the model is a setting, not part of the configuration.
        const registers::DriveModel& model = *config_.axes[i].motor.model;
        list.push_back({&axes[i]->model(), model.family->is_translated() ? std::string(model.name) : ""});
    }
    auto opened = panel::Panel::open(options, list, &names_, nullptr);
    if (!opened.panel)
        return journal_.write(LogLevel::error, JournalEvent::face_missing, "no panel: " + opened.error);
    panel_ = std::move(opened.panel);
    panel_->start();
    journal_.write(LogLevel::notice, JournalEvent::face_open,
                   wanted.token_file.is_there() ? fmt::format("panel: {}", panel_->url())
                                                : fmt::format("panel: {}, token: {} (until the next start)",
                                                              panel_->url(), panel_->token()));
}

}  // namespace nplc::boards
