#pragma once

// The library's macros collide with ordinary names; NCURSES_NOMACROS makes them functions.
#define NCURSES_NOMACROS 1
#define NCURSES_WIDECHAR 1
#include <curses.h>

namespace nplc::macreg {

inline constexpr short kPairBad = 1;
inline constexpr short kPairCurve = 2;
inline constexpr short kPairTitle = 3;

}  // namespace nplc::macreg
