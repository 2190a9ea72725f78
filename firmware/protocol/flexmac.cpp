#include "protocol/flexmac.h"
