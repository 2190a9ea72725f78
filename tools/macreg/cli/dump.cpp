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

namespace nplc::macreg::cli {
namespace {

using mactalk_client::Interrupted;
using mactalk_client::LineError;

struct Options {
    std::string file = "-";
    bool all = false;
};

/// Where lines go as they come: F.part, which becomes F when it is whole; or standard output.
class Target {
  public:
    explicit Target(const std::string& path) : path_(path) {
        if (path.empty()) return;
        std::error_code ignored;
        const std::filesystem::path place = host::path_of(path);
        const bool special =
            std::filesystem::exists(place, ignored) && !std::filesystem::is_regular_file(place, ignored);
        written_ = special ? path : path + ".part";
        file_ = std::fopen(written_.c_str(), "wb");
        if (file_ == nullptr)
            throw UserError(fmt::format("{}: cannot be written: {}", written_, std::strerror(errno)));
    }
    ~Target() {
        if (file_ != nullptr) std::fclose(file_);
    }
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;

    void add(const std::string& text) {
        std::FILE* to = file_ != nullptr ? file_ : stdout;
        if (std::fwrite(text.data(), 1, text.size(), to) != text.size() || std::fflush(to) != 0)
            throw UserError(fmt::format("{}: cannot be written: {}", name(), std::strerror(errno)));
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
    throw command_line::Failure(
        exit_code,
        fmt::format("{}; {} of {} registers were read and are in {}, marked as incomplete", why, done, all,
                    target.name()),
        {{"incomplete", true}, {"read", done}, {"of", all}, {"file", target.name()}});
}

void dump(Session& session, const Options& options) {
    Motor& motor = session.motor();
    const registers::Model model = motor.model();
    const std::string file = output_file(options.file);
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
    const auto options = std::make_shared<Options>();
    arguments::App& command =
        add_command(app, "dump",
                    "Write the motor's parameters as text with units, for `load`, `diff` and version "
                    "control. What was read of a motor that vanishes stays in FILE.part");
    command.add_option("-o,--output", options->file, "FILE; standard output if not said, or -");
    command.add_flag("--all", options->all, "What the motor measures and counts too, as comments");
    command.callback([options, &common] { work(common, [&](Session& s) { dump(s, *options); }); });
}

}  // namespace nplc::macreg::cli
