#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "macreg/motor.h"
#include "macreg/recording.h"
#include "registers/mac.h"

namespace nplc::macreg {

struct Relation {
    std::string_view sign;
    bool (*holds)(std::int64_t value, std::int64_t raw);
    std::string_view told{};  ///< the usual sign, if `sign` is another
};

/// A register compared with a value: `V_IST>100 rpm`, `P_IST <= -4096`, `ERR_STAT & IN_POS`.
struct Comparison {
    const registers::Register* reg = nullptr;
    const Relation* relation = nullptr;
    std::int64_t raw = 0;

    bool holds(std::int64_t value) const { return relation->holds(value, raw); }
};

struct ConditionReading {
    Comparison condition{};
    std::string error{};  ///< one line; empty if it was understood
};

/// Values as `typed_value` accepts them; `&` requires names of bits or a number.
ConditionReading read_condition(std::string_view text, registers::Model model);

/// "V_IST > 100 rpm"
std::string condition_words(const Comparison& condition, registers::Model model);

/// Registers that cannot be recorded in this way, or a unit that does not record; one line with what to do.
class CannotRecord : public mactalk_client::Ended {
  public:
    explicit CannotRecord(const std::string& what, int exit_code = mactalk_client::kRefused)
        : Ended(exit_code, what) {}
};

/// The request is not possible, on any motor.
class NotRecordable : public CannotRecord {
  public:
    explicit NotRecordable(const std::string& what) : CannotRecord(what, mactalk_client::kUsageOrFile) {}
};

struct RecordProgress {
    enum class Phase : std::uint8_t { waiting, recording, reading } phase;
    std::size_t done;
    std::size_t of;  ///< 0: unknown
};

struct RecordOptions {
    std::vector<const registers::Register*> registers{};
    std::string model_name{};   ///< for the recording; empty: the family's
    bool fast = false;          ///< current loop's rate instead of the position loop's
    std::size_t samples = 895;  ///< 1 to kMostSamples; polling takes any number, 0 is no end
    std::optional<Comparison> when{};
    base::Microseconds within{};  ///< for `when`; 0: no limit
    base::Microseconds lasts{};   ///< polling; 0: no limit
    /// Called as soon as the motor records: starts the motion to be recorded.
    std::function<void()> then{};
    /// Called between requests; throws to end the recording.
    std::function<void(const RecordProgress&)> progress = [](const RecordProgress&) {};
};

/// Of the motor's buffer (001 §3.2.116: REC_CNT is 0 to 895).
inline constexpr std::size_t kMostSamples = 895;

/// Records in the motor's sample buffer (001 §3.2.36, §3.2.112-116) and reads it by 53h. A sample whose
/// answer was lost is read again after a rewind. On every path SAMPLE1..4 and RECINNERBIT are restored and
/// recording is stopped. Throws CannotRecord (NotRecordable before any request), LineError, and what
/// `progress` throws; `broken` then holds the samples read so far, each with its time.
Recording record_buffer(Motor& motor, const RecordOptions& options, Recording* broken = nullptr);

/// Reads the buffer as it is, whoever recorded it, including TESTU_MODE and TESTA_MODE (001 §4.4.9, §4.4.10):
/// REC_CNT samples, or `samples` if not 0, of the registers in SAMPLE1..4, at the rate of RECINNERBIT.
/// Nothing is recorded and no parameter changes. Throws as record_buffer does.
Recording fetch_buffer(Motor& motor, const RecordOptions& options, Recording* broken = nullptr);

/// Polls the registers as fast as the line permits; each row has the time in the middle of its requests.
/// `into` holds the rows read so far even if it throws.
void record_polling(Motor& motor, const RecordOptions& options, Recording& into);

}  // namespace nplc::macreg
