// Where there is no libmosquitto, as for boards of other architectures whose programs are linked statically.
#include "broker/session.h"

namespace nplc::broker {

const bool kIsBuiltIn = false;

}  // namespace nplc::broker
