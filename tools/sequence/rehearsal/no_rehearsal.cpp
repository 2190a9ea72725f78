#include "rehearsal/rehearsal.h"

namespace nplc::rehearsal {

Rehearsal::Opened Rehearsal::open(const seqc::Compilation&, const Options&) {
    return {nullptr, "there is no simulator on this system: rehearse on Linux, or attach to a gateway"};
}

}  // namespace nplc::rehearsal
