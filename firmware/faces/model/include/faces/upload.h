#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "faces/command.h"
#include "faces/image.h"

namespace nplc::faces {

/// An upload of a table into an axis's store, one command at a time (REGISTERS.md, Upload); then, if
/// requested, the sequence is stopped, the table activated and run.
class Upload {
  public:
    struct Afterwards {
        bool activate = false;  ///< stops the sequence first
        bool run = false;       ///< with `activate` only
    };
    Upload(std::vector<std::uint8_t> table, Afterwards afterwards, std::uint64_t request);

    /// The next command, if one is due. `image`: the axis's latest.
    std::optional<Command> next(const AxisImage& image, base::Instant now);
    void ended(const Completion& completion, base::Instant now);

    bool is_over() const { return stage_ == Stage::over; }
    Result result() const { return result_; }
    std::uint16_t detail() const { return detail_; }
    /// The stage at a failure: "storing the table".
    std::string_view stage_in_words() const;
    std::size_t sent() const { return sent_; }
    std::size_t size() const { return table_.size(); }
    std::uint32_t crc() const;
    std::uint64_t request() const { return request_; }

  private:
    enum class Stage : std::uint8_t {
        begin,
        pieces,
        length,
        check,
        commit,
        storing,
        stop,
        activate,
        run,
        over
    };

    void fail(Result result, std::uint16_t detail);
    void go_on();
    bool may_try_again(Result result, base::Instant now) const;
    std::optional<Command> command(base::Instant now) const;
    std::optional<Command> look_at_store(const AxisImage& image);
    std::span<const std::uint8_t> piece() const;

    std::vector<std::uint8_t> table_;
    Afterwards afterwards_;
    std::uint64_t request_;
    Stage stage_ = Stage::begin;
    Stage failed_in_ = Stage::begin;
    bool is_waiting_ = false;  ///< for the outcome of a command
    std::size_t sent_ = 0;
    Result result_ = Result::done;
    std::uint16_t detail_ = 0;
    base::Instant not_before_{};
    std::optional<base::Instant> first_refusal_;
    std::uint64_t image_at_commit_ = 0;
};

}  // namespace nplc::faces
