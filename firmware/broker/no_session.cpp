// Replacement without libmosquitto, as for statically linked programs of other architectures.
#include "broker/session.h"

namespace nplc::broker {

const bool kIsBuiltIn = false;

}  // namespace nplc::broker
