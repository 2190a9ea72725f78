#include "registers/mac.h"
