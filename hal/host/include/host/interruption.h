#pragma once

namespace nplc::host {

/// From now on a request to end the program (Ctrl-C, SIGTERM, a closed console window) is only recorded; a
/// second one ends it at once. A pipe without a reader is a write error.
void note_interruptions();

/// The same, but further requests do not end it either: for programs that must stop a machine first. A
/// terminal hang-up counts as a request too.
void hold_interruptions();

/// Reverses this while a program only waits and has nothing to clean up: the first request ends it.
void end_at_interruptions();

/// Whether a request has been recorded.
bool was_interrupted();

}  // namespace nplc::host
