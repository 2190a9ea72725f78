#pragma once

namespace nplc::host {

/// From now on the user's request to end the program (Ctrl-C, SIGTERM, a closed console window) is noted
/// instead of carried out; a second one ends it at once. A pipe that nobody reads any more is an error of
/// writing.
void note_interruptions();

/// The same, and further ones do not end it either, until the program has ended: for who must stop a machine
/// first. A terminal that hangs up counts as well.
void hold_interruptions();

/// The other way round, for as long as a program waits and has nothing to put in order: the first one ends
/// it.
void end_at_interruptions();

/// Whether one came.
bool was_interrupted();

}  // namespace nplc::host
