#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>

#include "cli/session.h"
#include "host/paths.h"
#include "macreg/parameters.h"
#include "macreg/values.h"
#include "whole_files/whole_files.h"

namespace nplc::macreg::cli {
namespace {

using mactalk_client::Interrupted;
using mactalk_client::LineError;

struct DumpArguments {
    std::string file = "-";
    bool all = false;
    bool force = false;
};

std::string reason() {
    return std::strerror(errno);
}

/// Where lines go as they come: F.part, which becomes F when it is whole; or standard output.
class Target {
  public:
    explicit Target(const std::string& path) : path_(path) {
        if (path.empty()) return;
        if (whole_files::is_special(path)) {
            written_ = path;
            file_ = std::fopen(path.c_str(), "wb");
        } else {
            path_ = whole_files::behind_links(path);
            written_ = path_ + ".part";
            file_ = whole_files::create_anew(written_);
        }
        if (file_ == nullptr) throw UserError(fmt::format("{}: cannot be written: {}", written_, reason()));
    }
    ~Target() {
        if (file_ != nullptr) std::fclose(file_);
    }
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;

    void add(const std::string& text) {
        std::FILE* to = file_ != nullptr ? file_ : stdout;
        if (std::fwrite(text.data(), 1, text.size(), to) == text.size() && std::fflush(to) == 0) return;
        const std::string why = reason();
        if (file_ != nullptr && written_ != path_) std::remove(written_.c_str());
        throw UserError(fmt::format("{}: cannot be written: {}", name(), why));
    }
    void finish() {
        if (file_ == nullptr) return;
        const int closed = std::fclose(file_);
        file_ = nullptr;
        std::error_code error;
        if (closed != 0) error.assign(errno, std::generic_category());
        if (!error && written_ != path_)
            std::filesystem::rename(host::path_of(written_), host::path_of(path_), error);
        if (error) throw UserError(fmt::format("{}: cannot be written: {}", path_, error.message()));
    }
    std::string name() const { return written_.empty() ? "standard output" : written_; }

  private:
    std::string path_;
    std::string written_;
    std::FILE* file_ = nullptr;
};

void give_up(Session& session, Target& target, const char* why, int exit_code, std::size_t done,
             std::size_t all) {
    if (!session.json()) target.add(incomplete_text(why));
    session.progress("");
    const std::string read =
        done == 0 ? "no register was read"
                  : fmt::format("{} of {} registers were read and are in {}", done, all, target.name());
    throw command_line::Failure(exit_code,
                                fmt::format("{}; {}{}", why, read, done == 0 ? "" : ", marked as incomplete"),
                                {{"incomplete", true}, {"read", done}, {"of", all}, {"file", target.name()}});
}

void dump(Session& session, const DumpArguments& options) {
    Motor& motor = session.motor();
    const registers::Model model = motor.model();
    const std::string file = output_file(options.file, options.force);
    Target target(file);
    const bool as_text = !file.empty() || !session.json();
    std::size_t done = 0;
    std::size_t all = 0;
    Json list = Json::array();
    const auto received = [&](const std::map<std::uint8_t, std::int64_t>& values, std::size_t now_done,
                              std::size_t of) {
        for (const auto& [number, raw] : values) {
            if (as_text) target.add(value_line(model, *motor.find(number), raw));
            list.push_back(value_document(*motor.find(number), model, raw));
        }
        done = now_done;
        all = of;
        session.progress(fmt::format("{} of {} registers", done, all));
    };
    try {
        if (as_text) target.add(header_text(motor, session.model_name(), session.common().date));
        options.all ? read_everything(motor, received, goes_on) : read_parameters(motor, received, goes_on);
    } catch (const LineError& error) {
        give_up(session, target, error.what(), command_line::kNoAnswer, done, all);
    } catch (const Interrupted& error) {
        give_up(session, target, error.what(), command_line::kInterrupted, done, all);
    }
    if (as_text) target.add(end_text(done));
    target.finish();
    session.progress("");
    if (session.json()) {
        session.tell("", {{"file", file}, {"count", done}, {"registers", list}});
    } else if (!file.empty()) {
        session.tell(fmt::format("{}: {}", file, counted(done, "register")), {});
    }
}

}  // namespace

void add_dump(arguments::App& app, Common& common) {
    const auto options = std::make_shared<DumpArguments>();
    arguments::App& command =
        add_command(app, "dump",
                    "Write the motor's parameters as text with units, for `load`, `diff` and version "
                    "control. What was read of a motor that vanishes stays in FILE.part");
    command.add_option("-o,--output", options->file, "FILE; standard output if not said, or -");
    command.add_flag("--all", options->all, "What the motor measures and counts too, as comments");
    command.add_flag("--force", options->force, "Replace a file that is there");
    command.callback([options, &common] { work(common, [&](Session& s) { dump(s, *options); }); });
}

}  // namespace nplc::macreg::cli
