// A small picture of a mesh, for pages.
#pragma once

#include "io/bytes/bytes.h"
#include "pipeline/session.h"

namespace voxtet {

/// A PNG of 320 x 240: the posterior half of Session::mesh(), seen from the front and a little from above,
/// the patient's left to the right. Coloured by activation where the stage eikonal has run, red first, else
/// by label. The session has a mesh.
Bytes picture_of(const Session& session);

}  // namespace voxtet
