#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "causes/why.h"
#include "faces/image.h"

namespace nplc::faces {

/// The motor registers for the analysis of causes, read one after the other.
struct Survey {
    base::Instant taken{};  ///< time of the last read, by the faces' clock
    registers::Model model = registers::Model::mac140;
    causes::Snapshot before{};
    causes::Snapshot now{};
};

/// The causes of a standstill, as found by `macreg why`, in the order of remedy.
using Findings = std::vector<causes::Finding>;

/// Analyses the axis for all faces, once per survey and state of the gateway. For any thread.
class WhyKeeper {
  public:
    /// Validity of a survey.
    static constexpr base::Milliseconds kGood{30'000};

    /// Null: not known (yet). Never empty.
    std::shared_ptr<const Findings> look(const AxisImage& image, base::Instant now,
                                         const std::shared_ptr<const Survey>& survey);

  private:
    struct Key {
        const Survey* survey = nullptr;
        std::uint32_t status = 0;
        std::uint32_t reason = 0;
        bool moves = false;
        bool stands = false;
        std::optional<std::int32_t> velocity{};
        std::optional<causes::MidiState> midi{};
        bool operator==(const Key&) const = default;
    };

    std::mutex mutex_;
    Key key_;
    std::shared_ptr<const Survey> survey_;  ///< the one of key_
    std::shared_ptr<const Findings> findings_;
};

}  // namespace nplc::faces
