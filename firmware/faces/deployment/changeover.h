#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "active_table.h"
#include "base/time.h"
#include "deployment/settings.h"
#include "faces/command.h"
#include "faces/upload.h"
#include "orders/order.h"

namespace nplc::deployment {

/// What a step of a Changeover has led to.
enum class Outcome : std::uint8_t {
    open,     ///< in progress, or none begun
    put_off,  ///< not possible at present, why(); the seat is left
    refused,  ///< the firmware does not accept the table, why(); the seat is left
    active,   ///< the axis reports the table as active; finish() is due
    over,     ///< finish() is done
};

/// Stores one table at the axis and activates it: takes the operator's seat, stops the sequence where the
/// settings permit it, uploads and activates. Runs the sequence again afterwards.
class Changeover {
  public:
    struct Job {
        std::vector<std::uint8_t> bytes{};
        orders::Hash hash{};
        bool is_rollback = false;
    };
    /// A one-line message for the operator; an error or news.
    using Note = std::function<void(bool is_error, const std::string&)>;

    Changeover(Activation activation, std::unique_ptr<faces::CommandDesk::Client> client, Note note)
        : activation_(activation), client_(std::move(client)), note_(std::move(note)) {}

    /// False: the axis has no room for another client; nothing else may be called.
    bool has_client() const { return client_ != nullptr; }
    Outcome begin(Job job, base::Instant now);
    /// Handles the results of commands; to be called at each tick, also with nothing in progress.
    Outcome look_at_commands(const faces::AxisImage& image, base::Instant now);
    /// To be called regularly while it is in progress and the active table is known.
    Outcome tick(const ActiveTable& active, base::Instant now);
    /// Runs the sequence that was stopped for the job again, unless another client has stopped it since, and
    /// leaves the seat. True: in progress until `over`.
    bool finish(base::Instant now);
    bool is_rollback() const { return job_.is_rollback; }
    const std::string& why() const { return why_; }

  private:
    enum class Phase : std::uint8_t {
        none,
        seating,   ///< the operator's seat has been requested
        stopping,  ///< the sequence has been stopped
        storing,
        activating,
        running,  ///< the sequence is started again
    };

    bool submit(const faces::Command& command);
    void leave_seat(base::Instant now);
    void forget_run(const std::string& why);
    Outcome give_way(const std::string& why, base::Instant now);
    Outcome stop(const faces::Completion& ended, const faces::AxisImage& image, base::Instant now);
    Outcome await_stop(const faces::AxisImage& image, base::Instant now);
    void begin_upload();
    Outcome store(const faces::AxisImage& image, base::Instant now);
    Outcome upload_ended(base::Instant now);
    Outcome activate(const ActiveTable& active, base::Instant now);
    Outcome activation_ended(const faces::Completion& ended, base::Instant now);
    void run(base::Instant now);
    Outcome run_ended(const faces::Completion& ended, const faces::AxisImage& image, base::Instant now);

    Activation activation_;
    std::unique_ptr<faces::CommandDesk::Client> client_;
    Note note_;
    Job job_;
    Phase phase_ = Phase::none;
    base::Instant since_{};  ///< start of the phase
    base::Instant not_before_{};
    std::string why_;
    std::optional<faces::Upload> upload_;
    std::uint32_t command_ = 0;  ///< command in progress; 0: none
    /// AxisImage::stops when the sequence was stopped, if it ran before; it is restarted if no other client
    /// stops it.
    std::optional<std::uint32_t> ran_{};
};

}  // namespace nplc::deployment
