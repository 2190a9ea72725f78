#pragma once

#include "compiler/model.h"
#include "table/orders.h"

namespace nplc::seqc {

using table::MotionEffect;
using table::OrderKind;

/// As it stands in the table.
sequencer::MotorOrder order_of(const Send& send);

/// A set-point of V_SOLL counts as something else than 0.
OrderKind kind_of(const Send& send);
MotionEffect motion_effect_of(const Send& send);

/// The first order of a rule that moves the motor; nullptr: there is none.
const Send* motion_of(const Rule& rule);

}  // namespace nplc::seqc
