#include "protocol/fastmac.h"
