// Where there is no libmosquitto, as for boards of other architectures whose programs are linked statically.
#include "mqtt/client.h"

namespace nplc::mqtt {

class Client::Loop {};

Client::Client() = default;
Client::~Client() = default;

Client::Opened Client::open(const Options&, const faces::Axes&) {
    return {nullptr, "this program was built without libmosquitto"};
}

}  // namespace nplc::mqtt
