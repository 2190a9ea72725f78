// Any text is properties, or is refused with its line; any text is a certificate that comes back from what is
// written of it, or is refused.
#include <cstdint>
#include <string>
#include <string_view>

#include "fuzz.h"
#include "proof/certificate.h"
#include "seqc/properties.h"

namespace {

using namespace nplc;

void properties(std::string_view text) {
    seqc::Symbols names;
    names.steps[1] = "Idle";
    names.steps[2] = "Go";
    names.inputs[0] = "Start";
    names.outputs[0] = "Clamp";
    const seqc::PropertyReading read = seqc::read_properties(text, names);
    for (const seqc::Diagnostic& mistake : read.diagnostics) require(mistake.span.offset <= text.size());
    for (const verify::Property& property : read.properties) {
        require(!property.name.empty() && !property.text.empty());
        const std::string again = "PROPERTY " + property.name + ": " + property.text + ";";
        require(seqc::read_properties(again, names).properties.size() == 1);
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
