#include "motor/midi_motor.h"

namespace nplc::motor {

std::string_view text_of(MidiFault fault) {
    switch (fault) {
        case MidiFault::none:
            return "no error";
        case MidiFault::link_lost:
            return "the MIDI drive does not answer: check its supply, the cable, its address and the baud or "
                   "bit rate";
        case MidiFault::restarted:
            return "the MIDI drive started anew by itself: check its supply and its security input";
        case MidiFault::tripped:
            return "the MIDI drive has tripped: see its status word, and send \"reset error\" (01h) once the "
                   "cause is gone";
        case MidiFault::end_stop:
            return "an end-stop ended the MIDI drive's motion: acknowledge with 01h and move the other way";
        case MidiFault::not_arrived:
            return "the MIDI drive stands and is not where it was sent: look for another master, or for "
                   "commands "
                   "that it has ended the motion by";
        case MidiFault::refused:
            return "the MIDI drive refused a command that it should take: check its model and its software "
                   "release";
        case MidiFault::unclear:
            return "it is not known whether the MIDI drive took a command: it was told to stop; check the "
                   "line, and "
                   "the position";
        case MidiFault::jumped:
            return "the MIDI drive's position jumped in mid-motion: look for a load that drags the shaft, "
                   "and "
                   "for another master that has set its origin (0Bh); let the sequence find the origin again";
        case MidiFault::bad_value:
            return "an order is not for a MIDI drive";
        case MidiFault::unreadable:
            return "each answer of the MIDI drive came damaged: look for noise on the line, for another baud "
                   "rate, and for a second drive at its address; leave one connected, give it an address of "
                   "its own, then send \"reset error\" (01h)";
        case MidiFault::several:
            return "more than one MIDI drive answers to this address, and what moves one moves both: they "
                   "were "
                   "told to stop; switch off all but one, give that one another address (`macreg midi "
                   "address "
                   "set`), then send \"reset error\" (01h)";
    }
    return {};
}

}  // namespace nplc::motor
