#pragma once

#include "report/graph/graph_model.h"
#include "report/graph/graph_picture.h"

namespace nplc::seqc {

/// The model laid out for an A4 page, portrait or landscape, whichever is more readable.
Picture picture_of(const GraphModel& model);

}  // namespace nplc::seqc
