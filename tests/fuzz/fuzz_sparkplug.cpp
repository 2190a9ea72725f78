// Any bytes are a Sparkplug payload, or are refused; what is read comes back from what is written of it.
#include <cstdint>
#include <string_view>

#include "fuzz.h"
#include "sparkplug.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace nplc::mqtt;
    const auto read = decode({reinterpret_cast<const char*>(data), size});
    if (!read) return 0;
    const std::string written = encode(*read);
    const auto again = decode(written);
    require(again && again->seq == read->seq && again->timestamp == read->timestamp);
    require(again->metrics.size() == read->metrics.size());
    for (std::size_t i = 0; i < read->metrics.size(); ++i) {
        const Metric& was = read->metrics[i];
        const Metric& is = again->metrics[i];
        require(is.name == was.name && is.alias == was.alias && is.timestamp == was.timestamp);
    }
    // A value whose kind is not its type's may come back as that of the type, once.
    const auto third = decode(encode(*again));
    require(third && encode(*third) == encode(*again));
    return 0;
}
