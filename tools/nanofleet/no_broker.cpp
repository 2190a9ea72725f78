// The substitute where there is no libmosquitto.
#include "command_line/program.h"
#include "nanofleet/broker.h"

namespace nplc::nanofleet {

class Broker::Session {};

Broker::Broker(const broker::Options& /*options*/, Take /*take*/) {
    throw command_line::UserError("this program was built without libmosquitto, which a broker needs");
}
Broker::~Broker() = default;
void Broker::subscribe(const std::vector<std::string>& /*topics*/) {}
void Broker::publish(const std::string& /*topic*/, const std::string& /*payload*/) {}
void Broker::serve(int /*milliseconds*/) {}
std::size_t Broker::unconfirmed() const {
    return 0;
}
bool Broker::is_connected() const {
    return false;
}
bool Broker::is_denied() const {
    return false;
}

}  // namespace nplc::nanofleet
