#pragma once

namespace nplc::host {

/// From now on a person's wish to end the program (Ctrl-C, SIGTERM, a closed console window) is noted instead
/// of carried out; a second one ends it at once. A pipe that nobody reads any more is an error of writing.
void note_interruptions();

/// Whether one came.
bool was_interrupted();

}  // namespace nplc::host
