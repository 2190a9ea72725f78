#pragma once

#include <fmt/format.h>

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "command_line/program.h"
#include "host/text_file.h"
#include "macreg/causes.h"
#include "macreg/motor.h"
#include "macreg/parameters.h"
#include "macreg/recording.h"

namespace nplc::macreg::cli {

using command_line::add_command;
using command_line::goes_on;
using command_line::Json;
using command_line::look_for_interruption;
using command_line::output_has_reader;
using command_line::progress;
using command_line::UserError;

/// The common options, before or after a subcommand. `address` 0: ask the only motor on the line for its own.
struct Common : command_line::Common {
    std::string model;  ///< empty: found out by reading
    bool yes = false;   ///< no questions
    std::string date;   ///< the present date, for written files
};

/// The motor refused, or is not in a state to do it.
[[noreturn]] void refuse(const std::string& text);
[[noreturn]] void refuse(const std::string& text, const Json& details);

/// The model of --model; throws UserError if there is none of that name.
std::optional<registers::Model> model_option(const Common& common);

/// The registers of these names or numbers; throws UserError at the first unknown one.
std::vector<const registers::Register*> find_registers(registers::Model model,
                                                       const std::vector<std::string>& names);

/// A note for the user: on standard error, not with --json.
void remark(const Common& common, const std::string& text);
/// Asks on the terminal and requires a typed "yes"; without a terminal or --yes it throws UserError. `what`
/// is a sentence that says what will happen.
void ask(const Common& common, const std::string& what);

/// A motor that answered, and how results are printed.
class Session {
  public:
    explicit Session(const Common& common);
    /// Sends a stop, this value of MODE_REG, before any request, and again if there is no answer; the Failure
    /// then says that it is not confirmed (kNotConfirmed).
    Session(const Common& common, std::int64_t stop);

    Motor& motor() { return *motor_; }
    mactalk_client::Master& master() { return master_; }
    const Common& common() const { return common_; }
    bool json() const { return common_.json; }
    /// "MAC140" if that is known, for what is kept: by its answers alone a motor is one of "MAC50-141".
    std::string model_name() const;
    void pause(base::Microseconds time) { master_.pause(time); }
    base::Instant now() { return wire_->now(); }

    void tell(const std::string& text, const Json& document) const {
        command_line::tell(common_, text, document);
    }
    void remark(const std::string& text) const { cli::remark(common_, text); }
    void ask(const std::string& what) const { cli::ask(common_, what); }
    void progress(const std::string& text) const { command_line::progress(common_, text); }

  private:
    Session(const Common& common, std::unique_ptr<host::ByteClient> wire);
    void find_motor();
    /// After this error. Returns whether the motor's model is known, by --model or from a gateway.
    bool stop_once_more(const mactalk_client::LineError& error, std::uint8_t address, std::int64_t stop);

    const Common& common_;
    std::unique_ptr<host::ByteClient> wire_;
    mactalk_client::Master master_;
    std::unique_ptr<Motor> motor_;
};

/// The file of -o: empty for standard output, which is "-"; throws UserError if the name is empty or, without
/// `force`, the file exists.
std::string output_file(const std::string& option, bool force);

/// "1 register", "2 registers"
std::string counted(std::size_t count, const std::string& what);

/// A file of `dump`, whole, - is standard input; throws Failure with every line that is wrong.
ParameterSet read_parameter_file(const std::string& path, bool partial);

/// A file of any size, or `-`, standard input; Ctrl-C ends the program meanwhile. Throws UserError.
struct Input {
    std::string name;  ///< for messages
    std::string text;
};
Input read_input(const std::string& path);
std::string name_of_input(const std::string& path);
/// The same piece by piece.
void read_pieces(const std::string& path, const host::TextPieces::Take& take);
Recording read_recording(const std::string& path);

/// "a MAC800", "one of MAC50 to MAC141"
std::string model_words(const ParameterSet& set);

/// What `why` prints: numbered sentences, each with the values that prove it and the remedy. `key` is that of
/// the values in the JSON document.
struct ShownValue {
    std::string text;
    Json document;
};
void tell_findings(const Common& common, const std::vector<Finding>& findings, const char* key,
                   const std::function<ShownValue(std::string_view name)>& value_of);

/// {"name":, "number":, "raw":, "value":} of a register's value.
Json value_document(const registers::Register& reg, registers::Model model, std::int64_t raw);

/// `find`: the baud rates at which a device answers.
class Search {
  public:
    struct Speeds {
        bool only_this = false;
        bool every = false;
    };

    Search(Common& common, Speeds options) : common_(common), options_(options) {}

    /// `at` tries one baud rate: that of the line, or one after the other until a device answers.
    void run(std::uint32_t this_speed, std::span<const std::uint32_t> speeds,
             const std::function<void(std::uint32_t baud)>& at);
    void add(const std::string& line, Json document);
    /// Bytes were received that were no valid answer.
    void hear(bool noise) { noise_ = noise_ || noise; }
    /// `key`: of the list in the JSON document. The texts printed when no device answers, with and without
    /// noise.
    void tell(const char* key, const char* of_noise, const char* of_silence) const;

  private:
    Common& common_;
    Speeds options_;
    std::string text_;
    Json all_ = Json::array();
    bool noise_ = false;
};
void add_speed_options(arguments::App& command, Search::Speeds& speeds);

/// From a file of its own each; `add_service`: flash, safe, reset, prepare; `add_midi`: cli/midi.h.
command_line::Subcommand<Common> add_diff, add_dump, add_find, add_fit, add_get, add_list, add_load, add_midi,
    add_monitor, add_plot, add_record, add_samples, add_service, add_set, add_ui, add_watch, add_why;

}  // namespace nplc::macreg::cli
