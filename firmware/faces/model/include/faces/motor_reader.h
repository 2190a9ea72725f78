#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "faces/image.h"
#include "faces/why_keeper.h"
#include "gateway/controller.h"

namespace nplc::faces {

/// One register of the motor at a time, between the sequence's orders: what a face asks, or else the values
/// of AxisImage by turns. Where the user's port wants the motor, it gives way; a read is then begun anew.
class MotorReader {
  public:
    explicit MotorReader(base::Microseconds period) : period_(period) {}

    enum class State : std::uint8_t { under_way, done, failed };

    /// An access for a face.
    void begin(const motor::Access& access);
    State poll(gateway::Controller& controller, base::Instant now);
    std::uint32_t value() const { return value_; }
    /// Nobody waits for it any more.
    void drop(gateway::Controller& controller);
    /// Of the access: when poll() is wanted at the latest.
    base::Instant next(const gateway::Controller& controller, base::Instant now) const;

    /// Goes on with the image's values, if one is due. Not while a face's access is under way.
    void look_around(gateway::Controller& controller, AxisImage& image, base::Instant now,
                     base::Instant wall);
    /// Reads what causes are judged by, between the image's values.
    void begin_survey(registers::Model model);
    bool surveys() const { return !to_survey_.empty(); }
    /// The one that has ended.
    std::optional<Survey> take_survey();
    bool is_for_face() const { return wanted_ && !item_ && surveyed_ == nullptr; }
    bool is_idle() const { return !wanted_; }
    /// The motor's driver is a new one.
    void forget();
    /// When look_around() has something new to do, on the faces' clock.
    base::Instant due() const {
        if (period_.count() == 0) return base::kNever;
        return surveys() ? base::Instant{} : due_;
    }

  private:
    State take(gateway::Controller& controller, base::Instant now);
    void choose_item(const AxisImage& image);
    void choose_surveyed();
    void note_surveyed(base::Instant wall);
    void note_item(AxisImage& image, base::Instant wall);
    base::Microseconds pause(const gateway::Controller& controller) const;

    base::Microseconds period_;
    std::optional<motor::Access> wanted_;
    std::optional<base::Instant> begun_;
    bool asked_ = false;
    std::uint8_t failures_ = 0;
    std::uint32_t value_ = 0;
    base::Instant ended_{};

    std::optional<MotorItem> item_;                      ///< what wanted_ is for
    std::vector<const registers::Register*> to_survey_;  ///< what is left, the next one last
    const registers::Register* surveyed_ = nullptr;      ///< what wanted_ is for
    std::size_t before_left_ = 0;                        ///< of to_survey_, for Survey::before
    Survey survey_;
    bool survey_ended_ = false;
    unsigned turn_ = 0;
    base::Instant due_{};
};

}  // namespace nplc::faces
