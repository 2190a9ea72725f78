#include "cli/session.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "command_line/files.h"
#include "host/interruption.h"
#include "host/paths.h"
#include "macreg/parameters.h"
#include "macreg/values.h"
#include "whole_files/whole_files.h"

namespace nplc::macreg::cli {

using registers::Model;
using registers::Register;

namespace {

/// All errors of the file, so that they can be corrected in one pass.
command_line::Failure bad_file(const std::string& name, const std::vector<FileProblem>& problems) {
    constexpr std::size_t kMost = 20;
    const auto line_of = [&](const FileProblem& one) {
        return fmt::format("{}:{} {}", name, one.line == 0 ? "" : fmt::format("{}:", one.line), one.text);
    };
    Json list = Json::array();
    for (const FileProblem& one : problems) list.push_back({{"line", one.line}, {"problem", one.text}});
    std::string text = line_of(problems.front());
    if (problems.size() > 1) {
        text = fmt::format("{}: {}, nothing was written", name, counted(problems.size(), "problem"));
        for (std::size_t i = 0; i < problems.size() && i < kMost; ++i) text += "\n  " + line_of(problems[i]);
        if (problems.size() > kMost) text += fmt::format("\n  and {} more", problems.size() - kMost);
    }
    return {command_line::kUsageOrFile, text, {{"problems", list}}};
}

struct DumpArguments {
    std::string file = "-";
    bool all = false;
    bool force = false;
};

std::string reason() {
    return std::strerror(errno);
}

/// Output written line by line: to F.part, which is renamed to F when complete; or to standard output.
class DumpFile {
  public:
    explicit DumpFile(const std::string& path) : path_(path) {
        if (path.empty()) return;
        if (const std::string why = whole_files::why_endless(path); !why.empty()) throw UserError(why);
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
    ~DumpFile() {
        if (file_ != nullptr) std::fclose(file_);
    }
    DumpFile(const DumpFile&) = delete;
    DumpFile& operator=(const DumpFile&) = delete;

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

void fail_incomplete(Session& session, DumpFile& out, const mactalk_client::Ended& why, std::size_t done,
                     std::size_t all) {
    if (!session.json()) out.add(incomplete_text(why.what()));
    session.progress("");
    const std::string read =
        done == 0 ? "no register was read"
                  : fmt::format("{} of {} registers were read and are in {}", done, all, out.name());
    throw command_line::Failure(
        why.exit_code(), fmt::format("{}; {}{}", why.what(), read, done == 0 ? "" : ", marked as incomplete"),
        {{"incomplete", true}, {"read", done}, {"of", all}, {"file", out.name()}});
}

void dump(Session& session, const DumpArguments& options) {
    Motor& motor = session.motor();
    const registers::Model model = motor.model();
    const std::string file = output_file(options.file, options.force);
    DumpFile out(file);
    const bool as_text = !file.empty() || !session.json();
    std::size_t done = 0;
    std::size_t all = 0;
    Json list = Json::array();
    const auto received = [&](const std::map<std::uint8_t, std::int64_t>& values, std::size_t now_done,
                              std::size_t of) {
        for (const auto& [number, raw] : values) {
            if (as_text) out.add(value_line(model, *motor.find(number), raw));
            list.push_back(value_document(*motor.find(number), model, raw));
        }
        done = now_done;
        all = of;
        session.progress(fmt::format("{} of {} registers", done, all));
    };
    try {
        if (as_text) out.add(header_text(motor, session.model_name(), session.common().date));
        options.all ? read_everything(motor, received, goes_on) : read_parameters(motor, received, goes_on);
    } catch (const UserError&) {
        throw;
    } catch (const mactalk_client::Ended& error) {
        fail_incomplete(session, out, error, done, all);
    }
    if (as_text) out.add(end_text(done));
    out.finish();
    session.progress("");
    if (session.json()) {
        session.tell("", {{"file", file}, {"count", done}, {"registers", list}});
    } else if (!file.empty()) {
        session.tell(fmt::format("{}: {}", file, counted(done, "register")), {});
    }
}

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

/// Not read before the connection broke off: not counted as a difference.
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

Input read_input(const std::string& path) {
    const bool standard = path == "-";
    if (standard) host::end_at_interruptions();
    whole_files::FileText input =
        standard ? whole_files::read_standard_input() : whole_files::read_text(path, whole_files::kMostInput);
    host::note_interruptions();
    if (!input.error.empty()) throw UserError(input.error);
    return {name_of_input(path), std::move(input.text)};
}

std::string name_of_input(const std::string& path) {
    return path == "-" ? "standard input" : path;
}

void read_pieces(const std::string& path, const host::TextPieces::Take& take) {
    if (path == "-") host::end_at_interruptions();
    const std::string problem = whole_files::read_in_pieces(path, take);
    host::note_interruptions();
    if (!problem.empty()) throw UserError(problem);
}

Recording read_recording(const std::string& path) {
    RecordingReader reader(name_of_input(path));
    read_pieces(path, [&](std::string_view line, bool is_whole) {
        if (is_whole) return reader.take(line);
        reader.refuse_line();
        return false;
    });
    RecordingReading reading = reader.finish();
    if (!reading.error.empty()) throw UserError(reading.error);
    return std::move(reading.recording);
}

std::string model_words(const ParameterSet& set) {
    const bool known = set.model_is_known || set.model == registers::Model::mac800;
    return known ? fmt::format("a {}", registers::name_of(set.model)) : "one of MAC50 to MAC141";
}

ParameterSet read_parameter_file(const std::string& path, bool partial) {
    const auto [name, text] = path == "-" ? read_input(path) : Input{path, command_line::read_text(path)};
    const ParsedFile file = parse_parameters(text);
    if (!file.problems.empty()) throw bad_file(name, file.problems);
    if (!file.set.incomplete.empty() && !partial)
        throw UserError(fmt::format("{}: is incomplete: {}; dump again, or take it as it is with --partial",
                                    name, file.set.incomplete));
    return file.set;
}

void add_dump(arguments::App& app, Common& common) {
    auto [command, options] =
        add_command(app, common, "dump",
                    "Write the motor's parameters as text with units, for `load`, `diff` and version "
                    "control. What was read of a motor that vanishes stays in FILE.part",
                    dump);
    command.add_option("-o,--output", options.file, "FILE; standard output if not said, or -");
    command.add_flag("--all", options.all, "What the motor measures and counts too, as comments");
    command.add_flag("--force", options.force, "Replace a file that is there");
}

void add_diff(arguments::App& app, Common& common) {
    auto [command, options] = add_command(
        app, common, "diff",
        "Compare a file of `dump` with another one or with the motor; exit code 1 if they differ", diff);
    command.add_option("file", options.left, "The file")->required();
    command.add_option("other", options.right, "Another file, or `motor`")->capture_default_str();
    command.add_flag("--partial", options.partial, "Take files that are marked as incomplete");
}

}  // namespace nplc::macreg::cli
