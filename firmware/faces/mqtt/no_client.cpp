// Replacement without libmosquitto, as for statically linked programs of other architectures.
#include "mqtt/client.h"

namespace nplc::mqtt {

class Client::Loop {};

Client::Client() = default;
Client::~Client() = default;

Client::Opened Client::open(const Options&, const faces::Axes&) {
    return {nullptr, "this program was built without libmosquitto"};
}

}  // namespace nplc::mqtt
