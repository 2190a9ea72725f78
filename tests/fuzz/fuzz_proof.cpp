// Any text is properties, or is refused with its line; any text is a certificate that comes back from what is
// written of it, or is refused.
#include <algorithm>
#include <cstdint>
#include <string_view>

#include "fuzz.h"
#include "proof/certificate.h"
#include "verify/property.h"

namespace {

using namespace nplc;

void properties(std::string_view text) {
    verify::Names names;
    names.steps[1] = "Idle";
    names.steps[2] = "Go";
    names.inputs[0] = "Start";
    names.outputs[0] = "Clamp";
    const verify::PropertyReading read = verify::read_properties(text, names);
    const auto lines = static_cast<std::size_t>(1 + std::count(text.begin(), text.end(), '\n'));
    if (!read.error.empty()) {
        require(read.line >= 1 && read.line <= lines);
        return;
    }
    for (const verify::Property& property : read.properties) {
        require(!property.name.empty() && !property.text.empty());
        require(verify::read_properties("PROPERTY " + property.name + ": " + property.text + ";", names)
                    .properties.size() == 1);
    }
}

void certificate(std::string_view text) {
    const proof::CertificateReading read = proof::read_certificate(text);
    if (!read.error.empty()) return;
    const std::string written = proof::to_text(read.certificate);
    const proof::CertificateReading again = proof::read_certificate(written);
    require(again.error.empty() && proof::to_text(again.certificate) == written);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    properties(text);
    certificate(text);
    return 0;
}
