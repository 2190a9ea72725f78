#include "motor/jvl_driver.h"

namespace nplc::motor::jvl {
namespace {

/// Sample period of the outer loop, rounded up (001 §1.2, 004).
constexpr base::Microseconds kSampleMac50To141{1'920};
constexpr base::Microseconds kSampleMac800{1'299};

}  // namespace

JvlMotor::Settings settings_of(const DriverSettings& settings) {
    using protocol::fastmac::RegisterCode;
    JvlMotor::Settings result;
    result.link.baud = settings.baud;
    result.link.silence = settings.silence;
    // An adapter that delays status bytes delays an echo by the same time.
    result.link.proof_time = settings.silence;
    result.safe_communication = settings.safe_communication;
    result.register_code =
        settings.old_register_codes ? RegisterCode::older_example : RegisterCode::format_list;
    result.registers_are_32_bit = settings.is_mac800;
    result.sample_period = settings.is_mac800 ? kSampleMac800 : kSampleMac50To141;
    return result;
}

}  // namespace nplc::motor::jvl
